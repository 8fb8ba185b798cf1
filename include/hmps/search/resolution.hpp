// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Throws `InputError` if the scalar type of `points` (m) is too coarse to resolve a `share` of the `spacing` (m) at
/// their distance from the origin. If it resolves only more than a hundredth, small motions are rounded away.
template <class T, int D>
void require_resolved(const VectorView<T, D>& points, double spacing, double share = 0.01) {
  using S = typename VectorView<T, D>::Scalar;
  const double furthest = share * spacing / static_cast<double>(std::numeric_limits<S>::epsilon());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < D; ++c)
      require(std::abs(static_cast<double>(points(i, c))) <= furthest, "hmps: particle ", i, " lies at ", points(i, c),
              " m, where its scalar type does not resolve ", share, " of the spacing of ", spacing,
              " m; take positions in double, or an origin near the body");
}

}  // namespace hmps::inline HMPS_ABI::detail
