// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

/// Estimates the spacing (m) of a cloud of particles: the median distance of 64 particles, spread over `points` (m), to
/// their nearest neighbours, ignoring coincident particles. Returns 0 if there is no such distance. For error messages
/// and for checks of a given spacing.
template <class T, int D>
[[nodiscard]] double nearest_spacing(const VectorView<T, D>& points) {
  const std::size_t n = points.size(), samples = std::min<std::size_t>(n, 64);
  std::vector<double> nearest;
  for (std::size_t k = 0; k < samples; ++k) {
    const Vector<double, D> here = points[k * n / samples].template cast<double>();
    double least = std::numeric_limits<double>::max();
    for (std::size_t j = 0; j < n; ++j) {
      const double squared = (points[j].template cast<double>() - here).squaredNorm();
      if (squared > 0) least = std::min(least, squared);
    }
    if (least < std::numeric_limits<double>::max()) nearest.push_back(std::sqrt(least));
  }
  if (nearest.empty()) return 0;
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

namespace detail {

/// The question whether the spacing is the one that was `found` in the particles (m) instead of the `given` one.
[[nodiscard]] inline std::string ask_for_spacing(double found, double given) {
  return message(found, " m, ", found / given, " times the spacing of ", given, " m that was given: is the spacing ",
                 found, " m?");
}

/// A hint to append to an error that a wrong `spacing` (m) may have caused; empty if `points` agree with it to within
/// `tolerance`, as a share of it. In clouds that are not a lattice, the distances of nearest neighbours scatter by a
/// tenth.
template <class T, int D>
[[nodiscard]] HMPS_COLD std::string spacing_hint(const VectorView<T, D>& points, double spacing,
                                                 double tolerance = 0.01) {
  const double found = nearest_spacing(points);
  if (found == 0 || std::abs(found / spacing - 1) < tolerance) return "";
  return "; the distance between nearest neighbours is " + ask_for_spacing(found, spacing);
}

/// Throws `InputError` if `spacing` (m), which was given to `what`, is not that of the particles at `points` (m) to
/// within a factor of `most`.
template <class T, int D>
void require_spacing_of(const VectorView<T, D>& points, double spacing, const char* what, double most = 4) {
  const double found = nearest_spacing(points);
  require(found == 0 || (spacing < most * found && found < most * spacing), "hmps: the spacing of ", what, " is ",
          spacing, " m, but the nearest particles lie ", found,
          " m apart; give the particle spacing l0, in the unit of the positions");
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
