// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "hmps/bonds/detail/lattice_cells.hpp"
#include "hmps/bonds/shape_tensor.hpp"
#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/particles/support.hpp"
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI {

/// Allows every site: the default predicate of `thicken`.
struct AllowEverywhere {
  template <class V>
  constexpr bool operator()(const V&) const {
    return true;
  }
};

namespace detail {

/// The occupied sites of a growing lattice, in integer steps from the first point.
template <int D>
class SiteMap {
 public:
  using Site = LatticeCell<D>;

  SiteMap(const Vector<double, D>& origin, const SupportSettings& settings)
      : origin_(origin),
        spacing_(settings.spacing),
        radius_(settings.radius_ratio),
        offsets_(cells_within<D>(radius_)) {}

  [[nodiscard]] static Vector<double, D> steps(const Site& site) {
    Vector<double, D> result;
    for (int c = 0; c < D; ++c) result[c] = static_cast<double>(site[static_cast<std::size_t>(c)]);
    return result;
  }
  [[nodiscard]] Vector<double, D> position(const Site& site) const { return origin_ + spacing_ * steps(site); }

  void add(std::size_t i, const Vector<double, D>& x) {
    Site site;
    for (int c = 0; c < D; ++c) {
      const double step = (x[c] - origin_[c]) / spacing_;
      const double whole = std::round(step);
      require(std::abs(step - whole) < 0.01 && std::abs(whole) < (1 << 20), "hmps: particle ", i, " at (", x,
              ") is not on a lattice of spacing ", spacing_,
              " m with the first particle; only lattices can be thickened");
      site[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(whole);
    }
    require(add(site), "hmps: particle ", i, " at (", x,
            ") shares its lattice site with another particle; remove one of them");
  }
  bool add(const Site& site) {
    if (!index_.emplace(key(site), sites_.size()).second) return false;
    sites_.push_back(site);
    return true;
  }

  [[nodiscard]] const std::vector<Site>& sites() const { return sites_; }
  [[nodiscard]] bool has(const Site& site) const { return index_.contains(key(site)); }
  [[nodiscard]] static Site moved(Site site, const Site& by) {
    for (std::size_t c = 0; c < D; ++c) site[c] += by[c];
    return site;
  }

  /// The shape tensor at `site`, in squared spacings.
  [[nodiscard]] ShapeTensor<D> shape(const Site& site) const {
    ShapeTensor<D> result;
    for (const Site& offset : offsets_) {
      if (!has(moved(site, offset))) continue;
      const Vector<double, D> r0 = steps(offset);
      result.add(r0, PaperWeight{}(std::min(r0.norm(), radius_), radius_));
    }
    return result;
  }

 private:
  [[nodiscard]] static std::uint64_t key(const Site& site) {
    std::uint64_t result = 0;
    for (const std::int32_t k : site) result = (result << 21) | (static_cast<std::uint64_t>(k + (1 << 20)) & 0x1fffff);
    return result;
  }

  Vector<double, D> origin_;
  double spacing_;
  double radius_;
  std::vector<Site> offsets_;
  std::vector<Site> sites_;
  std::unordered_map<std::uint64_t, std::size_t> index_;
};

}  // namespace detail

/// Finds lattice sites to add to `points` (m, on one lattice of `settings.spacing`) to support weakly supported
/// particles. It is the alternative to `supported_particles` for thin organs cut out of a lattice, and thickens them by
/// up to a spacing where they are weak. In each of up to `passes` passes, every weak particle, in order, gets the free
/// neighbouring site along an axis that strengthens its weakest direction most; of equal sites, the one with more
/// neighbours.
///
/// Sites where `allowed(x)` does not hold stay free, for example in a gap to another organ. Returns the new positions;
/// use `find_weak` to see which particles are still weak. Throws `InputError` for settings out of range, a threshold
/// that even a full lattice does not reach, and points that are not on one lattice of the spacing.
template <class T, int D, class Allowed = AllowEverywhere>
[[nodiscard]] std::vector<Vector<typename VectorView<T, D>::Scalar, D>> thicken(const VectorView<T, D>& points,
                                                                                const SupportSettings& settings,
                                                                                const Allowed& allowed = {},
                                                                                int passes = 4) {
  using S = typename VectorView<T, D>::Scalar;
  using Map = detail::SiteMap<D>;
  detail::validate(settings);
  detail::require(settings.radius_ratio < 16, "hmps: the effective radius is ", settings.radius_ratio,
                  " spacings; on a lattice it must be below 16");
  detail::require(passes >= 0, "hmps: the number of passes of thicken is ", passes,
                  "; it must not be negative (4 is the default)");
  require_finite(points, "the position");
  const double full = detail::full_support<D>(settings.radius_ratio);
  detail::require(settings.threshold < full, "hmps: the support threshold is ", settings.threshold,
                  ", but even a particle inside a full lattice has only ", full, " at an effective radius of ",
                  settings.radius_ratio, " spacings, so that thicken would never end; give a lower threshold, such as ",
                  0.2 * full);
  detail::require_spacing_of(points, settings.spacing, "thicken", 1.9);
  std::vector<Vector<S, D>> added;
  if (points.size() == 0) return added;
  Map map(points[0].template cast<double>(), settings);
  for (std::size_t i = 0; i < points.size(); ++i) map.add(i, points[i].template cast<double>());

  const std::size_t given = map.sites().size();
  // Support only grows, so later passes need to look only at particles that were weak and at those that were added.
  std::vector<std::size_t> suspects(given);
  for (std::size_t i = 0; i < given; ++i) suspects[i] = i;
  for (int pass = 0; pass < passes && !suspects.empty(); ++pass) {
    const std::size_t before = map.sites().size();
    std::vector<std::size_t> weak;
    for (const std::size_t i : suspects) {
      const auto site = map.sites()[i];
      const Matrix<double, D> A = map.shape(site).A;
      Eigen::SelfAdjointEigenSolver<Matrix<double, D>> solver;
      solver.computeDirect(A);
      if (!(solver.eigenvalues()[0] < settings.threshold)) continue;
      weak.push_back(i);
      const Vector<double, D> weakest = solver.eigenvectors().col(0);
      double best = 0;
      typename Map::Site chosen{};
      for (std::size_t c = 0; c < D; ++c) {
        for (const std::int32_t step : {-1, 1}) {
          typename Map::Site offset{};
          offset[c] = step;
          const auto candidate = Map::moved(site, offset);
          if (map.has(candidate) || !allowed(Vector<S, D>(map.position(candidate).template cast<S>()))) continue;
          const double along = weakest[static_cast<Eigen::Index>(c)];
          // The number of neighbours decides only between sites with equal effect.
          const double gain = std::round(1e3 * along * along) + 1e-3 * map.shape(candidate).neighbours;
          if (gain > best) best = gain, chosen = candidate;
        }
      }
      if (best > 0) map.add(chosen);
    }
    suspects.swap(weak);
    for (std::size_t k = before; k < map.sites().size(); ++k) suspects.push_back(k);
  }
  for (std::size_t k = given; k < map.sites().size(); ++k)
    added.push_back(map.position(map.sites()[k]).template cast<S>());
  return added;
}

}  // namespace hmps::inline HMPS_ABI
