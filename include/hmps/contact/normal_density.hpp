// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "hmps/contact/metaball.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/spacing.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI {

/// The normal density function Z(y), \paper{27}, and its inverse, \paper{29}: the distance of a slave from the
/// outermost layer of a wall, given the sum of metaballs at the slave.
///
/// The standard wall is a simple cubic (2D: square) lattice that fills the half space y <= 0, with its outermost
/// particles at y = 0. Z is averaged over the position of the slave along the wall. (The paper does not specify where
/// its column of slaves stands; directly above a particle the values differ by up to 5 %.) With the average, the sum
/// over a layer becomes an integral over its plane.
///
/// The inverse is a table with smooth interpolation (relative error below 1e-6 l0). Z falls monotonically only near the
/// surface: below `deepest()`, where its slope has dropped to a quarter of the steepest, it saturates and no longer
/// determines the depth. The inverse then stays at `deepest()` and flags the slave as deep.
template <class S, int D, Metaball Kernel>
class NormalDensity {
 public:
  /// `spacing` is l0 in m. Throws `InputError` unless it is positive and finite, for a kernel that forms no wall, and
  /// for one whose slope is not the derivative of its value: forces would not point out of the wall.
  explicit NormalDensity(S spacing) : spacing_(spacing) {
    detail::require_spacing(static_cast<double>(spacing), "a metaball wall");
    require_slope();
    find_deepest();
    const double top = in_spacings(deepest_);
    detail::require(detail::is_finite(top) && top > 0 && least_slope_ > 0,
                    "hmps: the metaball kernel forms no wall: its sum is ", top, " at ", deepest_,
                    " spacings; its value must be finite and fall from above 0 to 0");
    table_.resize(nodes + 1);
    std::vector<double> distance(nodes + 1);
    distance[0] = Kernel::radius;
    distance[nodes] = deepest_;
    for (std::size_t k = nodes - 1; k > 0; --k) {
      const double u = static_cast<double>(k) / static_cast<double>(nodes);
      distance[k] = solve(top * u * u * u * u, distance[k + 1]);
    }
    for (std::size_t k = 0; k <= nodes; ++k) {
      // dy/du of Z(y) = top u^4; at u = 0 both sides vanish.
      const double u = static_cast<double>(k) / static_cast<double>(nodes);
      const double rise =
          k == 0 ? distance[1] - distance[0] : 4 * top * u * u * u / slope(distance[k]) / static_cast<double>(nodes);
      table_[k] = {static_cast<S>(distance[k]), static_cast<S>(rise)};
    }
    top_ = static_cast<S>(top);
    scale_ = static_cast<S>(1 / top);
  }

  /// Z(y), \paper{27}; `y` in m, positive outside the wall.
  [[nodiscard]] S operator()(S y) const { return static_cast<S>(in_spacings(static_cast<double>(y / spacing_))); }

  struct Distance {
    S value = 0;           ///< R_im in m; meaningless unless `reached`.
    bool reached = false;  ///< The sum is positive: the wall is within reach.
    bool deep = false;     ///< Z has saturated: the true distance is `deepest()` or less.
  };

  /// R_im = Z^-1(C_im), \paper{29}, for the sum `density` of metaballs. Never NaN: a sum of zero, a negative sum or NaN
  /// is out of reach.
  [[nodiscard]] Distance inverse(S density) const {
    if (!(density > 0)) return {spacing_ * static_cast<S>(Kernel::radius), false, false};
    if (density >= top_) return {spacing_ * static_cast<S>(deepest_), true, true};
    const S u = std::sqrt(std::sqrt(density * scale_)) * static_cast<S>(nodes);
    const std::size_t k = std::min(static_cast<std::size_t>(u), nodes - 1);
    const S t = u - static_cast<S>(k), r = S(1) - t;
    const auto& [ya, da] = table_[k];
    const auto& [yb, db] = table_[k + 1];
    const S y = r * r * ((S(1) + S(2) * t) * ya + t * da) + t * t * ((S(1) + S(2) * r) * yb - r * db);
    return {spacing_ * y, true, false};
  }

  /// A quarter of the steepest -dZ/dy, in 1/m. Where the sum falls less steeply across a wall, a slave is deep inside,
  /// even if the wall is too thin for Z to saturate.
  [[nodiscard]] S least_slope() const { return static_cast<S>(least_slope_) / spacing_; }
  /// l0 in m.
  [[nodiscard]] S spacing() const { return spacing_; }
  /// The smallest distance in m that the inverse can return; negative, inside the wall.
  [[nodiscard]] S deepest() const { return spacing_ * static_cast<S>(deepest_); }

 private:
  static constexpr std::size_t nodes = 1024;

  /// Compares the slope of the kernel with differences of its value.
  static void require_slope() {
    constexpr double h = 1e-4, share = 0.1;  // of the steepest slope: more than rounding, and less than a wrong factor
    double steepest = 0;
    for (double s = 0.07; s < 0.95; s += 0.0931)
      steepest = std::max(steepest, std::abs(static_cast<double>(Kernel::slope(s))));
    for (double s = 0.07; s < 0.95; s += 0.0931) {
      const auto given = static_cast<double>(Kernel::slope(s));
      const auto found = static_cast<double>(Kernel::value(s + h) - Kernel::value(s - h)) / (2 * h);
      detail::require(!detail::is_finite(given + found) || std::abs(given - found) <= share * steepest,
                      "hmps: the metaball kernel has the slope ", given, " at s = ", s, ", but its value has ", found,
                      " there; `slope` must return dc/ds, with s the square of r / r_e");
    }
  }

  /// The sum of metaballs of one layer at the distance of `h` spacings, integrated over the layer.
  [[nodiscard]] static double layer(double h) {
    constexpr double radius = Kernel::radius;
    if (std::abs(h) >= radius) return 0;
    constexpr std::array<double, 4> x{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    constexpr std::array<double, 4> w{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    // Two panels of eight-point Gauss quadrature: exact for polynomials up to degree 7 in (r / r_e)^2.
    constexpr int panels = 2;
    const double reach = std::sqrt(radius * radius - h * h);
    double sum = 0;
    for (int p = 0; p < panels; ++p)
      for (std::size_t q = 0; q < 8; ++q) {
        const double node = q < 4 ? -x[3 - q] : x[q - 4], weight = q < 4 ? w[3 - q] : w[q - 4];
        const double a = reach * (p + 0.5 + 0.5 * node) / panels;
        const double measure = D == 3 ? 2 * std::numbers::pi * a : 2;
        sum += weight * 0.5 * reach / panels * measure * Kernel::value((h * h + a * a) / (radius * radius));
      }
    return sum;
  }

  /// Z at `y` spacings.
  [[nodiscard]] static double in_spacings(double y) {
    double sum = 0;
    for (double h = std::max(y, y + std::ceil(-Kernel::radius - y)); h < Kernel::radius; h += 1) sum += layer(h);
    return sum;
  }

  [[nodiscard]] static double slope(double y) { return (in_spacings(y + 1e-4) - in_spacings(y - 1e-4)) / 2e-4; }

  void find_deepest() {
    constexpr double step = 1. / 128;
    double steepest = 0, y = Kernel::radius;
    for (; y > -Kernel::radius; y -= step) {
      const double s = slope(y);
      steepest = std::min(steepest, s);
      if (s > 0.25 * steepest && y < 0) break;
    }
    deepest_ = y;
    least_slope_ = -0.25 * steepest;
  }

  /// Finds y between `low` and the reach with Z(y) = `density`, by false position with a bisection in every third step.
  [[nodiscard]] static double solve(double density, double low) {
    double high = Kernel::radius, at_low = in_spacings(low) - density, at_high = -density, y = low;
    for (int i = 0; i < 60 && high - low > 1e-13; ++i) {
      y = i % 3 == 2 ? 0.5 * (low + high) : low - at_low * (high - low) / (at_high - at_low);
      const double value = in_spacings(y) - density;
      if (std::abs(value) < 1e-14 * density) break;
      (value > 0 ? low : high) = y;
      (value > 0 ? at_low : at_high) = value;
    }
    return y;
  }

  struct Node {
    S value, slope;
  };
  S spacing_, top_ = 0, scale_ = 0;
  double deepest_ = 0, least_slope_ = 0;
  std::vector<Node> table_;
};

}  // namespace hmps::inline HMPS_ABI
