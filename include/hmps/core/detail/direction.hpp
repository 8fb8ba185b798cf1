// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// A vector in the direction of `given` whose length can be computed: `given` itself, unless the squares of its
/// components overflow or vanish. Also `given` if that is zero or not finite.
template <class S, int D>
[[nodiscard]] Vector<S, D> measurable(const Vector<S, D>& given) {
  const S largest = given.cwiseAbs().maxCoeff();
  constexpr S bound = S(0x1p32f);  // the square of its inverse is not rounded to zero in float
  if (largest > 1 / bound && largest < bound) return given;
  if (!all_finite(given) || largest == S(0)) return given;
  Vector<S, D> scaled;
  for (int c = 0; c < D; ++c) scaled[c] = std::ldexp(given[c], -std::ilogb(largest));
  return scaled;
}

}  // namespace hmps::inline HMPS_ABI::detail
