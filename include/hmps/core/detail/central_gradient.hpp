// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The gradient of `shape` at `x` by central differences over `reach` (m) to either side.
template <class F, int D>
[[nodiscard]] Vector<double, D> central_gradient(const F& shape, const Vector<double, D>& x, double reach) {
  Vector<double, D> g;
  for (int c = 0; c < D; ++c) {
    Vector<double, D> a = x, b = x;
    a[c] -= reach;
    b[c] += reach;
    g[c] = (static_cast<double>(shape(b)) - static_cast<double>(shape(a))) / (2 * reach);
  }
  return g;
}

}  // namespace hmps::inline HMPS_ABI::detail
