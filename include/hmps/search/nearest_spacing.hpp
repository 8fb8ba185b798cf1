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
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

/// The spacing in m that a cloud of particles seems to have: the median distance of 64 of them, spread over `points`
/// (m), to the nearest other particle that does not lie at the same place. 0 where there is none. For messages and
/// checks of a spacing that was given; takes 64 distances per particle.
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

/// What to say beside an error that a wrong `spacing` (m) may have caused: empty if it is that of `points`.
template <class T, int D>
[[nodiscard]] std::string spacing_hint(const VectorView<T, D>& points, double spacing) {
  const double found = nearest_spacing(points);
  if (found == 0 || std::abs(found / spacing - 1) < 0.01) return "";
  return message("; the nearest neighbours lie ", found, " m apart, ", found / spacing, " of the spacing of ", spacing,
                 " m that was given: is the spacing ", found, " m?");
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
