// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

/// Checks of NaN and infinity that hold whatever the floating-point flags of the compiler. With -ffast-math, -Ofast or
/// -ffinite-math-only it takes every number for finite, so that `std::isfinite(x)` is `true` and `!(x > 0)` is not to
/// be relied upon for NaN: these look at the bits. Ask them first and compare afterwards: `is_finite(x) && x > 0`.
namespace hmps::inline HMPS_ABI::detail {

/// The bits of the exponent of `x`, all set in NaN and infinity, and those of the fraction, zero in infinity.
template <class T>
struct FloatBits {
  static_assert(std::numeric_limits<T>::is_iec559 && (sizeof(T) == 4 || sizeof(T) == 8));
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  static constexpr Bits exponent = sizeof(T) == 4 ? Bits{0x7f800000u} : static_cast<Bits>(0x7ff0000000000000u);
  static constexpr Bits magnitude = static_cast<Bits>(~Bits{0}) >> 1;

  [[nodiscard]] static constexpr Bits of(const T& x) {
    Bits bits = std::bit_cast<Bits>(x);
#if defined(__GNUC__) || defined(__clang__)
    // Hides where the bits come from: some compilers see through them and answer by the flags again.
    if (!std::is_constant_evaluated()) asm("" : "+r"(bits));
#endif
    return bits & magnitude;
  }
};
template <class T>
concept HasFloatBits = std::is_same_v<T, float> || std::is_same_v<T, double>;

/// Whether `x` is neither NaN nor infinite; holds for every integer.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] constexpr bool is_finite(const T& x) {
  if constexpr (HasFloatBits<T>)
    return FloatBits<T>::of(x) < FloatBits<T>::exponent;
  else if constexpr (std::is_floating_point_v<T>)
    return std::isfinite(x);
  else
    return true;
}

/// Whether `x` is NaN.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] constexpr bool is_nan(const T& x) {
  if constexpr (HasFloatBits<T>)
    return FloatBits<T>::of(x) > FloatBits<T>::exponent;
  else if constexpr (std::is_floating_point_v<T>)
    return std::isnan(x);
  else
    return false;
}

/// Whether every component of the vector or tensor `m` is finite.
template <class Derived>
[[nodiscard]] bool all_finite(const Eigen::DenseBase<Derived>& m) {
  for (Eigen::Index c = 0; c < m.cols(); ++c)
    for (Eigen::Index r = 0; r < m.rows(); ++r) {
      const typename Derived::Scalar x = m.derived().coeff(r, c);
      if (!is_finite(x)) return false;
    }
  return true;
}

}  // namespace hmps::inline HMPS_ABI::detail
