// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/scene.hpp"

/// How far the channel of the pharynx is closed, measured by gaps between the outermost particles of organs, taken as
/// balls with the spacing as diameter. Gaps are infinite if there are no such particles.
namespace swallowing {

/// Heights in m at which the width of the pharynx is observed: in front of the superior, the middle and the inferior
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

}  // namespace swallowing
