// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#if defined(__GNUC__) || defined(__clang__)
#define HMPS_INLINE [[gnu::always_inline]] inline
#define HMPS_INLINE_LAMBDA __attribute__((always_inline))
#else
#define HMPS_INLINE inline
#define HMPS_INLINE_LAMBDA
#endif

namespace hmps {

/// `width` numbers that are worked on together: the scalar type in which the sweeps over particles
/// evaluate laws and terms, one particle in each lane. Behaves as a number in generic code
/// (`+ - * /`, comparisons that give a `LaneMask`, `select`, and `sqrt`, `log`, `exp`, `pow`, `abs`,
/// `min`, `max` found by argument-dependent lookup), also inside an Eigen matrix.
///
/// The width follows from `T` alone, 64 bytes, so that the layout of nothing depends on the
/// instruction set a translation unit is compiled for; the compiler splits it as it must. It is
/// kept as a plain array for the same reason: passing it never uses a vector register.
template <class T>
struct alignas(64) Lanes {
  static_assert(std::floating_point<T>, "hmps: lanes hold float or double");
  using Scalar = T;
  static constexpr int width = static_cast<int>(64 / sizeof(T));
  /// The integers of the size of `T`, as which masks are kept.
  using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

  T lane[static_cast<std::size_t>(width)];

  HMPS_INLINE Lanes() = default;
  /// The same number in every lane.
  template <class U>
  requires std::is_arithmetic_v<U> HMPS_INLINE Lanes(U value) {
    const T x = static_cast<T>(value);
    for (int l = 0; l < width; ++l) lane[l] = x;
  }
};

/// The outcome of comparing `Lanes<T>`: all bits of a lane set, or none.
template <class T>
struct alignas(64) LaneMask {
  typename Lanes<T>::Bits lane[static_cast<std::size_t>(Lanes<T>::width)];
};

namespace detail {

/// Asks for the cache line of `address`; never fails.
HMPS_INLINE void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#endif
}

#if defined(__GNUC__) || defined(__clang__)
template <class T>
struct Raw {
  typedef T Vector __attribute__((vector_size(64)));
  typedef typename Lanes<T>::Bits Mask __attribute__((vector_size(64)));
};
// GCC and Clang lower a 64-byte vector to whatever registers there are. The vectors live inside
// one function each: handing one to another function would depend on compiler flags.
#define HMPS_LANES_BINARY(result_type, result_raw, op)  \
  result_type result;                                   \
  typename detail::Raw<T>::Vector x, y;                 \
  __builtin_memcpy(&x, a.lane, sizeof(x));              \
  __builtin_memcpy(&y, b.lane, sizeof(y));              \
  const typename detail::Raw<T>::result_raw z = x op y; \
  __builtin_memcpy(result.lane, &z, sizeof(z));         \
  return result;
#define HMPS_LANES_COMPARE(op) HMPS_LANES_BINARY(LaneMask<T>, Mask, op)
#else
#define HMPS_LANES_BINARY(result_type, result_raw, op)                               \
  result_type result;                                                                \
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = a.lane[l] op b.lane[l]; \
  return result;
#define HMPS_LANES_COMPARE(op)                                                                \
  LaneMask<T> result;                                                                         \
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = a.lane[l] op b.lane[l] ? -1 : 0; \
  return result;
#endif

}  // namespace detail

#define HMPS_LANES_OPERATOR(op)                                                                       \
  template <class T>                                                                                  \
  [[nodiscard]] HMPS_INLINE Lanes<T> operator op(const Lanes<T>& a, const Lanes<T>& b) {              \
    HMPS_LANES_BINARY(Lanes<T>, Vector, op)                                                           \
  }                                                                                                   \
  template <class T, class U>                                                                         \
  requires std::is_arithmetic_v<U>                                                                    \
  [[nodiscard]] HMPS_INLINE Lanes<T> operator op(const Lanes<T>& a, U b) { return a op Lanes<T>(b); } \
  template <class T, class U>                                                                         \
  requires std::is_arithmetic_v<U>                                                                    \
  [[nodiscard]] HMPS_INLINE Lanes<T> operator op(U a, const Lanes<T>& b) { return Lanes<T>(a) op b; } \
  template <class T, class U>                                                                         \
  HMPS_INLINE Lanes<T>& operator op##=(Lanes<T>& a, const U& b) {                                     \
    a = a op b;                                                                                       \
    return a;                                                                                         \
  }
HMPS_LANES_OPERATOR(+)
HMPS_LANES_OPERATOR(-)
HMPS_LANES_OPERATOR(*)
HMPS_LANES_OPERATOR(/)
#undef HMPS_LANES_OPERATOR

#define HMPS_LANES_COMPARISON(op)                                                                        \
  template <class T>                                                                                     \
  [[nodiscard]] HMPS_INLINE LaneMask<T> operator op(const Lanes<T>& a, const Lanes<T>& b) {              \
    HMPS_LANES_COMPARE(op)                                                                               \
  }                                                                                                      \
  template <class T, class U>                                                                            \
  requires std::is_arithmetic_v<U>                                                                       \
  [[nodiscard]] HMPS_INLINE LaneMask<T> operator op(const Lanes<T>& a, U b) { return a op Lanes<T>(b); } \
  template <class T, class U>                                                                            \
  requires std::is_arithmetic_v<U>                                                                       \
  [[nodiscard]] HMPS_INLINE LaneMask<T> operator op(U a, const Lanes<T>& b) { return Lanes<T>(a) op b; }
HMPS_LANES_COMPARISON(<)
HMPS_LANES_COMPARISON(<=)
HMPS_LANES_COMPARISON(>)
HMPS_LANES_COMPARISON(>=)
HMPS_LANES_COMPARISON(==)
HMPS_LANES_COMPARISON(!=)
#undef HMPS_LANES_COMPARISON
#undef HMPS_LANES_BINARY
#undef HMPS_LANES_COMPARE

template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> operator-(const Lanes<T>& a) {
  return Lanes<T>(0) - a;
}
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> operator+(const Lanes<T>& a) {
  return a;
}

/// `a` where `mask` holds, `b` elsewhere.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> select(const LaneMask<T>& mask, const Lanes<T>& a, const Lanes<T>& b) {
  Lanes<T> result;
#if defined(__GNUC__) || defined(__clang__)
  typename detail::Raw<T>::Mask m, x, y;
  __builtin_memcpy(&m, mask.lane, sizeof(m));
  __builtin_memcpy(&x, a.lane, sizeof(x));
  __builtin_memcpy(&y, b.lane, sizeof(y));
  const typename detail::Raw<T>::Mask z = (m & x) | (~m & y);
  __builtin_memcpy(result.lane, &z, sizeof(z));
#else
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = mask.lane[l] != 0 ? a.lane[l] : b.lane[l];
#endif
  return result;
}

/// The sixteen (or eight) lanes that lie from `source` on, which need not be aligned.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> load(const T* source) {
  Lanes<T> result;
  __builtin_memcpy(result.lane, source, sizeof(result.lane));
  return result;
}

/// Writes the lanes to `target` on, which need not be aligned.
template <class T>
HMPS_INLINE void store(T* target, const Lanes<T>& a) {
  __builtin_memcpy(target, a.lane, sizeof(a.lane));
}

/// `value` in every lane whose bit is set in `lanes`, zero in the others.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> spread(std::uint32_t lanes, T value) {
  Lanes<T> result;
#if defined(__GNUC__) || defined(__clang__)
  using Bits = typename Lanes<T>::Bits;
  typename detail::Raw<T>::Mask bit;
  for (int l = 0; l < Lanes<T>::width; ++l) bit[l] = Bits{1} << l;
  const typename detail::Raw<T>::Mask all = static_cast<Bits>(lanes) - typename detail::Raw<T>::Mask{};
  typename detail::Raw<T>::Vector v = value - typename detail::Raw<T>::Vector{};
  typename detail::Raw<T>::Mask x;
  __builtin_memcpy(&x, &v, sizeof(x));
  const typename detail::Raw<T>::Mask z = ((all & bit) != 0) & x;
  __builtin_memcpy(result.lane, &z, sizeof(z));
#else
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = (lanes >> l & 1u) != 0 ? value : T(0);
#endif
  return result;
}

/// Applies `f` to each lane: the way in for functions that have no vector form.
template <class T, class F>
[[nodiscard]] HMPS_INLINE Lanes<T> each(const Lanes<T>& a, F&& f) {
  Lanes<T> result;
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = f(a.lane[l]);
  return result;
}

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
  return each(a, [](T x) { return std::sqrt(x); });
}
template <class T>
[[nodiscard]] inline Lanes<T> log(const Lanes<T>& a) {
  return each(a, [](T x) { return std::log(x); });
}
template <class T>
[[nodiscard]] inline Lanes<T> exp(const Lanes<T>& a) {
  return each(a, [](T x) { return std::exp(x); });
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

/// x^(-1/3), the only root that the reduced invariants need (\paper{16, 17}): NaN for x <= 0.
/// A guess from the bits of the number, then Newton's iteration, correct to about two units in the
/// last place; the lanes never leave the vector registers.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> inverse_cube_root(const Lanes<T>& x) {
  Lanes<T> y;
#if defined(__GNUC__) || defined(__clang__)
  // The exponent of y is minus a third of that of x; working on the bits as on a number does that
  // and interpolates the mantissa: within 10 % for every normal number.
  using Bits = typename Lanes<T>::Bits;
  typename detail::Raw<T>::Mask bits;
  __builtin_memcpy(&bits, x.lane, sizeof(bits));
  constexpr T one = sizeof(T) == 4 ? T(0x3f800000) : T(0x3ff0000000000000);
  constexpr T offset = one * T(4.0 / 3.0) * (sizeof(T) == 4 ? T(0.99965) : T(0.99996));
  const auto guess = offset - __builtin_convertvector(bits, typename detail::Raw<T>::Vector) * T(1.0 / 3.0);
  bits = __builtin_convertvector(guess, typename detail::Raw<T>::Mask);
  static_assert(sizeof(Bits) == sizeof(T));
  __builtin_memcpy(y.lane, &bits, sizeof(bits));
  constexpr int iterations = sizeof(T) == 4 ? 3 : 5;
  for (int i = 0; i < iterations; ++i) y = y + y * (T(1) - x * y * y * y) * T(1.0 / 3.0);
  return select(x > T(0), y, Lanes<T>(std::numeric_limits<T>::quiet_NaN()));
#else
  return each(x, [](T value) { return value > T(0) ? T(1) / std::cbrt(value) : std::numeric_limits<T>::quiet_NaN(); });
#endif
}

}  // namespace hmps

/// Lanes are numbers to Eigen.
template <class T>
struct Eigen::NumTraits<hmps::Lanes<T>> : Eigen::GenericNumTraits<hmps::Lanes<T>> {
  using Real = hmps::Lanes<T>;
  using NonInteger = hmps::Lanes<T>;
  using Nested = hmps::Lanes<T>;
  using Literal = T;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

/// Arrays of lanes are aligned as lanes are; Eigen need not, and must not, ask for less.
template <class T, int Size>
struct Eigen::internal::compute_default_alignment<hmps::Lanes<T>, Size> {
  enum { value = 0 };
};
