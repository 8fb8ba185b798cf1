// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The share of a spacing that positions must resolve. If they do not, small motions are rounded away.
inline constexpr double resolved_share = 0.01;

/// Throws `InputError` if the scalar `S` is too coarse to resolve a `share` of the `spacing` (m) at a `coordinate` (m).
/// `where` begins the message, such as "particle 3 lies".
template <class S, class... Where>
void require_resolution(double coordinate, double spacing, double share, const Where&... where) {
  const double rounding = static_cast<double>(std::numeric_limits<S>::epsilon()) * std::abs(coordinate);
  require(rounding <= share * spacing, "hmps: ", where..., " at ", coordinate, " m, where numbers of ", 8 * sizeof(S),
          " bits are rounded to about ", rounding, " m and do not resolve ", share, " of the spacing of ", spacing,
          " m; take positions in double, or an origin near the body");
}

/// Throws `InputError` if the scalar type of `points` (m) is too coarse to resolve a `share` of the `spacing` (m) at
/// their distance from the origin.
template <class T, int D>
void require_resolved(const VectorView<T, D>& points, double spacing, double share = resolved_share) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < D; ++c)
      require_resolution<typename VectorView<T, D>::Scalar>(static_cast<double>(points(i, c)), spacing, share,
                                                            "particle ", i, " lies");
}

/// A bound in m, with a margin, for the error of the distance of two `points` whose coordinates were rounded to their
/// scalar type: a comparison with a distance that lattices contain exactly, such as two spacings, has to allow for it.
template <class T, int D>
[[nodiscard]] double rounding_of_distances(const VectorView<T, D>& points) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < D; ++c) largest = std::max(largest, std::abs(static_cast<double>(points(i, c))));
  return 4 * static_cast<double>(std::numeric_limits<typename VectorView<T, D>::Scalar>::epsilon()) * largest;
}

/// `radius` (m), and the little by which rounding may make the distance of two `points` longer than it: of lengths and
/// of positions anywhere.
template <class T, int D>
[[nodiscard]] typename VectorView<T, D>::Scalar reach_of(const VectorView<T, D>& points, double radius) {
  using S = typename VectorView<T, D>::Scalar;
  return static_cast<S>(radius * (1 + 16 * static_cast<double>(std::numeric_limits<S>::epsilon())) +
                        rounding_of_distances(points));
}

}  // namespace hmps::inline HMPS_ABI::detail
