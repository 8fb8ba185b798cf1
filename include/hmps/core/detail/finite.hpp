// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

/// Tests for NaN and infinity that work with any floating-point flags. With -ffast-math, -Ofast or -ffinite-math-only,
/// the compiler assumes that every number is finite: `std::isfinite(x)` becomes `true`, and `!(x > 0)` may be false for
/// NaN. These functions test the bits. Call them before any comparison: `is_finite(x) && x > 0`.
namespace hmps::inline HMPS_ABI::detail {

/// The exponent bits of `x`, all set in NaN and infinity, and the fraction bits, zero in infinity.
template <class T>
struct FloatBits {
  static_assert(std::numeric_limits<T>::is_iec559 && (sizeof(T) == 4 || sizeof(T) == 8));
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  static constexpr Bits exponent = sizeof(T) == 4 ? Bits{0x7f800000u} : static_cast<Bits>(0x7ff0000000000000u);
  static constexpr Bits magnitude = static_cast<Bits>(~Bits{0}) >> 1;

  [[nodiscard]] static constexpr Bits of(const T& x) {
    Bits bits = std::bit_cast<Bits>(x);
#if defined(__GNUC__) || defined(__clang__)
    // Hides the origin of the bits; otherwise some compilers recognise the test and apply the flags again.
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

/// Whether no component of `a` is larger than that of `b`; false for NaN.
template <class T, int D>
[[nodiscard]] bool none_above(const Vector<T, D>& a, const Vector<T, D>& b) {
  for (int c = 0; c < D; ++c)
    if (!(a[c] <= b[c])) return false;
  return true;
}

}  // namespace hmps::inline HMPS_ABI::detail
