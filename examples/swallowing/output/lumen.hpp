// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/scene.hpp"

/// How far the channel of the pharynx and the inlet of the larynx are closed, measured between particles that are taken
/// as balls with the spacing as diameter. Gaps are infinite if there are no particles of the organs that they separate.
namespace swallowing {

/// Heights in m at which the pharynx is observed: in front of the superior, the middle and the inferior
/// constrictor.
inline constexpr std::array<double, 3> observed_heights{65e-3, 40e-3, 22e-3};

namespace detail {

/// Calls `visit(first, second)` with the outermost particles of the organs `first` and `second`, for each contact pair
/// of the two.
template <class Visit>
void for_each_skin(const Scene& scene, Organ first, Organ second, Visit&& visit) {
  for (const ContactPair& pair : scene.contacts)
    if (pair.first == first && pair.second == second) visit(pair.first_slaves, pair.second_slaves);
}

}  // namespace detail

/// Gap in m between the tongue and the posterior wall of the pharynx, within 5 mm of the midsagittal plane.
[[nodiscard]] inline double tongue_to_wall(const Scene& scene, const std::vector<Eigen::Vector3d>& x) {
  constexpr double from_midline = 5e-3;
  double least = std::numeric_limits<double>::infinity();
  detail::for_each_skin(scene, Organ::tongue, Organ::pharynx, [&](const auto& tongue, const auto& pharynx) {
    for (const hmps::Index i : tongue) {
      if (std::abs(x[i][1]) > from_midline) continue;
      for (const hmps::Index j : pharynx)
        if (std::abs(x[j][1]) < from_midline) least = std::min(least, (x[i] - x[j]).squaredNorm());
    }
  });
  return std::sqrt(least) - scene.spacing;
}

/// Width in m of the pharynx from one side wall to the other at a height, at the middle of its depth at rest.
[[nodiscard]] inline double channel_width(const Scene& scene, const std::vector<Eigen::Vector3d>& x, double height) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double reach = 1.25 * scene.spacing;
  double left = -infinite, right = infinite;
  detail::for_each_skin(scene, Organ::tongue, Organ::pharynx, [&](const auto&, const auto& pharynx) {
    for (const hmps::Index i : pharynx) {
      if (std::abs(x[i][2] - height) > reach || std::abs(x[i][0]) > reach) continue;
      (x[i][1] < 0 ? left : right) = x[i][1] < 0 ? std::max(left, x[i][1]) : std::min(right, x[i][1]);
    }
  });
  return right - left - scene.spacing;
}

/// The cells of a horizontal section through the pharynx, from the front to behind its posterior wall.
class Section {
 public:
  /// The section at `height` (m), with five cells per spacing.
  Section(const Scene& scene, const std::vector<Eigen::Vector3d>& x, double height)
      : step_(scene.spacing / 5),
        deep_(static_cast<std::size_t>(std::ceil((back - front) / step_))),
        wide_(static_cast<std::size_t>(std::ceil(2 * half_width / step_))),
        cells_(deep_ * wide_, open) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::abs(x[i][2] - height) < scene.spacing / 2) cover(x[i], scene.organ[i] == Organ::tongue);
  }
  /// Area in m2 of the space that has tissue in front, behind and on both sides. The interior of the tongue, of which
  /// the scene has only a shell, does not count.
  [[nodiscard]] double open_area() const {
    std::vector<Range> columns(deep_), rows(wide_), tongue(wide_);
    for (std::size_t a = 0; a < deep_; ++a)
      for (std::size_t b = 0; b < wide_; ++b) {
        if (cell(a, b) == open) continue;
        columns[a].add(b), rows[b].add(a);
        if (cell(a, b) & of_tongue) tongue[b].add(a);
      }
    const auto enclosed = [&](std::size_t a, std::size_t b) {
      return cell(a, b) == open && rows[b].around(a) && columns[a].around(b) && a >= tongue[b].end;
    };
    std::size_t count = 0;
    for (std::size_t a = 1; a + 1 < deep_; ++a)
      for (std::size_t b = 1; b + 1 < wide_; ++b) {
        const bool beside = enclosed(a - 1, b) || enclosed(a + 1, b) || enclosed(a, b - 1) || enclosed(a, b + 1);
        count += enclosed(a, b) || (!(cell(a, b) & covered) && beside);
      }
    return static_cast<double>(count) * step_ * step_;
  }

 private:
  static constexpr double front = -40e-3, back = 20e-3, half_width = 24e-3;  // m
  /// Bits of a cell: within half a spacing of a particle; within three quarters, so that no holes are left between
  /// neighbours; the latter of a particle of the tongue.
  enum : unsigned char { open = 0, covered = 1, rim = 2, of_tongue = 4 };
  struct Range {
    std::size_t first = std::numeric_limits<std::size_t>::max(), end = 0;
    void add(std::size_t k) { first = std::min(first, k), end = std::max(end, k + 1); }
    [[nodiscard]] bool around(std::size_t k) const { return first < k && k + 1 < end; }
  };

  void cover(const Eigen::Vector3d& at, bool tongue) {
    constexpr double within = 2.5, beyond = 3.75;  // cells
    const double a0 = (at[0] - front) / step_ - 0.5, b0 = (at[1] + half_width) / step_ - 0.5;
    const auto from = [](double middle) { return static_cast<std::size_t>(std::max(0., middle - beyond)); };
    for (std::size_t a = from(a0); a < deep_ && static_cast<double>(a) <= a0 + beyond; ++a)
      for (std::size_t b = from(b0); b < wide_ && static_cast<double>(b) <= b0 + beyond; ++b) {
        const double distance = std::hypot(static_cast<double>(a) - a0, static_cast<double>(b) - b0);
        unsigned char& here = cells_[a * wide_ + b];
        if (distance <= within) here |= covered;
        if (distance <= beyond) here |= tongue ? rim | of_tongue : rim;
      }
  }
  [[nodiscard]] unsigned char cell(std::size_t a, std::size_t b) const { return cells_[a * wide_ + b]; }

  double step_;
  std::size_t deep_, wide_;
  std::vector<unsigned char> cells_;
};

/// Area in m2 of the pharynx that is open at a height.
[[nodiscard]] inline double open_area(const Scene& scene, const std::vector<Eigen::Vector3d>& x, double height) {
  return Section(scene, x, height).open_area();
}

/// Gap in m between the upper half of the leaf and the larynx: between the surfaces of their outermost particles.
[[nodiscard]] inline double leaf_to_larynx(const Scene& scene, const std::vector<Eigen::Vector3d>& x,
                                           const Eigen::Vector3d& middle, const Eigen::Vector3d& tipward) {
  double least = std::numeric_limits<double>::infinity();
  detail::for_each_skin(scene, Organ::epiglottis, Organ::larynx, [&](const auto& leaf, const auto& larynx) {
    for (const hmps::Index i : leaf)
      if ((x[i] - middle).dot(tipward) > 0)
        for (const hmps::Index j : larynx) least = std::min(least, (x[i] - x[j]).squaredNorm());
  });
  return std::sqrt(least) - scene.spacing;
}

/// Gap in m between the arytenoids, regions D, from side to side.
[[nodiscard]] inline double glottis(const Scene& scene, const std::vector<Eigen::Vector3d>& x) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double left = -infinite, right = infinite;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (scene.region[i] < 0) continue;
    const std::string& region = scene.regions[static_cast<std::size_t>(scene.region[i])].name;
    if (region == "D left") left = std::max(left, x[i][1]);
    if (region == "D right") right = std::min(right, x[i][1]);
  }
  return right - left - scene.spacing;
}

}  // namespace swallowing
