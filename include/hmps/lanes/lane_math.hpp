// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/lanes/detail/registers.hpp"
#include "hmps/lanes/lanes.hpp"

/// The functions of packs of lanes that laws and terms call, lane by lane.
namespace hmps::inline HMPS_ABI {

namespace detail {

/// Applies `f` to each lane, for functions without a vector form.
template <class T, class F>
[[nodiscard]] HMPS_INLINE Lanes<T> each(const Lanes<T>& a, F&& f) {
  Lanes<T> result;
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = f(a.lane[l]);
  return result;
}

}  // namespace detail

template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> abs(const Lanes<T>& a) {
  return select(a < T(0), -a, a);
}
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> min(const Lanes<T>& a, const Lanes<T>& b) {
  return select(b < a, b, a);
}
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> max(const Lanes<T>& a, const Lanes<T>& b) {
  return select(a < b, b, a);
}
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> sqrt(const Lanes<T>& a) {
#if defined(HMPS_ROOT_OF_FLOATS)
  Lanes<T> result;
  HMPS_EACH_REGISTER {
    typename detail::Register<T>::Vector x;
    __builtin_memcpy(&x, a.lane + l, sizeof(x));
    if constexpr (sizeof(T) == sizeof(float))
      x = HMPS_ROOT_OF_FLOATS(x);
    else
      x = HMPS_ROOT_OF_DOUBLES(x);
    __builtin_memcpy(result.lane + l, &x, sizeof(x));
  }
  return result;
#else
  return detail::each(a, [](T x) { return std::sqrt(x); });
#endif
}
template <class T>
[[nodiscard]] inline Lanes<T> log(const Lanes<T>& a) {
  return detail::each(a, [](T x) { return std::log(x); });
}
template <class T>
[[nodiscard]] inline Lanes<T> exp(const Lanes<T>& a) {
  return detail::each(a, [](T x) { return std::exp(x); });
}
template <class T>
[[nodiscard]] inline Lanes<T> pow(const Lanes<T>& a, const Lanes<T>& exponent) {
  Lanes<T> result;
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = std::pow(a.lane[l], exponent.lane[l]);
  return result;
}
template <class T, class U>
requires std::is_arithmetic_v<U>
[[nodiscard]] inline Lanes<T> pow(const Lanes<T>& a, U exponent) { return pow(a, Lanes<T>(exponent)); }

/// x^(-1/3), the only root that the reduced invariants need (\paper{16, 17}); NaN for x <= 0. A guess from the bits of
/// the number, then Newton's iteration, correct to about two units in the last place, all in vector registers.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> inverse_cube_root(const Lanes<T>& x) {
  Lanes<T> y;
#if defined(HMPS_EACH_REGISTER)
  // The exponent of y is minus a third of that of x. Treating the bits as a number computes that and interpolates the
  // mantissa, within 10 % for every normal number.
  using Bits = typename Lanes<T>::Bits;
  using Mask = typename detail::Register<T>::Mask;
  using Vector = typename detail::Register<T>::Vector;
  static_assert(sizeof(Bits) == sizeof(T));
  constexpr T one = sizeof(T) == 4 ? T(0x3f800000) : T(0x3ff0000000000000);
  constexpr T offset = one * T(4.0 / 3.0) * (sizeof(T) == 4 ? T(0.99965) : T(0.99996));
  HMPS_EACH_REGISTER {
    Mask bits;
    __builtin_memcpy(&bits, x.lane + l, sizeof(bits));
    const Vector guess = offset - __builtin_convertvector(bits, Vector) * T(1.0 / 3.0);
    bits = __builtin_convertvector(guess, Mask);
    __builtin_memcpy(y.lane + l, &bits, sizeof(bits));
  }
  constexpr int iterations = sizeof(T) == 4 ? 3 : 5;
  for (int i = 0; i < iterations; ++i) y = y + y * (T(1) - x * y * y * y) * T(1.0 / 3.0);
  return select(x > T(0), y, Lanes<T>(std::numeric_limits<T>::quiet_NaN()));
#else
  return detail::each(
      x, [](T value) { return value > T(0) ? T(1) / std::cbrt(value) : std::numeric_limits<T>::quiet_NaN(); });
#endif
}

}  // namespace hmps::inline HMPS_ABI
