// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// Bytes of all lanes: the size of the largest vector registers in use today.
inline constexpr std::size_t lanes_bytes = 64;
/// The integer type of the size of `T`, used for masks.
template <class T>
using BitsOf = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

#if defined(__GNUC__) || defined(__clang__)
#if defined(__AVX512F__)
#define HMPS_REGISTER_BYTES 64
#elif defined(__AVX2__)
#define HMPS_REGISTER_BYTES 32
#else
#define HMPS_REGISTER_BYTES 16
#endif
/// The lanes in one register of the target's instruction set. Never pass a register to another function: its calling
/// convention depends on compiler flags.
template <class T, std::size_t bytes = HMPS_REGISTER_BYTES>
struct Register {
  typedef T Vector __attribute__((vector_size(bytes)));
  typedef BitsOf<T> Mask __attribute__((vector_size(bytes)));
  static constexpr int width = static_cast<int>(bytes / sizeof(T));
};
/// Visits the lanes one register at a time, starting at lane `l`. GCC spills vectors larger than a register to memory
/// after every operation, which costs a factor of eight.
#define HMPS_EACH_REGISTER                                                                       \
  _Pragma("GCC unroll 4") for (int l = 0; l < static_cast<int>(detail::lanes_bytes / sizeof(T)); \
                               l += detail::Register<T>::width)
#endif

/// Copies lanes through registers of the width that the next operation reads. A load that spans several narrower stores
/// would have to wait for the cache.
template <class T>
HMPS_INLINE void copy_lanes(T* target, const T* source) {
#if defined(HMPS_EACH_REGISTER)
  HMPS_EACH_REGISTER {
    typename Register<T>::Vector x;
    __builtin_memcpy(&x, source + l, sizeof(x));
    __builtin_memcpy(target + l, &x, sizeof(x));
  }
#else
  for (std::size_t l = 0; l < lanes_bytes / sizeof(T); ++l) target[l] = source[l];
#endif
}

}  // namespace detail

/// A pack of `width` numbers, one particle per lane: the scalar type in which the sweeps evaluate laws and terms.
/// Generic code uses it like a number: `+ - * /`, comparisons (which return a `LaneMask`), `select`, and `sqrt`, `log`,
/// `exp`, `pow`, `abs`, `min`, `max` found by argument-dependent lookup. It may be the scalar of an Eigen matrix.
///
/// The size is 64 bytes for every `T` and every instruction set, so that no layout depends on compiler flags; each
/// operation uses as many registers as it needs. The numbers are stored as a plain array for the same reason: passing
/// it never uses a vector register.
template <class T>
struct alignas(detail::lanes_bytes) Lanes {
  static_assert(std::floating_point<T>, "hmps: lanes hold float or double");
  using Scalar = T;
  static constexpr int width = static_cast<int>(detail::lanes_bytes / sizeof(T));
  using Bits = detail::BitsOf<T>;

  T lane[static_cast<std::size_t>(width)];

  HMPS_INLINE Lanes() = default;
  HMPS_INLINE Lanes(const Lanes& other) { detail::copy_lanes(lane, other.lane); }
  HMPS_INLINE Lanes& operator=(const Lanes& other) {
    detail::copy_lanes(lane, other.lane);
    return *this;
  }
  /// Sets every lane to the same number.
  template <class U>
  requires std::is_arithmetic_v<U> HMPS_INLINE Lanes(U value) {
    const T x = static_cast<T>(value);
#if defined(HMPS_EACH_REGISTER)
    HMPS_EACH_REGISTER {
      const typename detail::Register<T>::Vector all = x - typename detail::Register<T>::Vector{};
      __builtin_memcpy(lane + l, &all, sizeof(all));
    }
#else
    for (int l = 0; l < width; ++l) lane[l] = x;
#endif
  }
};

/// The result of comparing `Lanes<T>`: in each lane all bits are set, or none.
template <class T>
struct alignas(detail::lanes_bytes) LaneMask {
  typename Lanes<T>::Bits lane[static_cast<std::size_t>(Lanes<T>::width)];
};

namespace detail {

/// Prefetches the cache line of `address`; never faults.
HMPS_INLINE void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#endif
}

#if defined(HMPS_EACH_REGISTER)
#define HMPS_LANES_BINARY(result_type, result_raw, op)         \
  result_type result;                                          \
  HMPS_EACH_REGISTER {                                         \
    typename detail::Register<T>::Vector x, y;                 \
    __builtin_memcpy(&x, a.lane + l, sizeof(x));               \
    __builtin_memcpy(&y, b.lane + l, sizeof(y));               \
    const typename detail::Register<T>::result_raw z = x op y; \
    __builtin_memcpy(result.lane + l, &z, sizeof(z));          \
  }                                                            \
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
#if defined(HMPS_EACH_REGISTER)
  HMPS_EACH_REGISTER {
    typename detail::Register<T>::Mask m, x, y;
    __builtin_memcpy(&m, mask.lane + l, sizeof(m));
    __builtin_memcpy(&x, a.lane + l, sizeof(x));
    __builtin_memcpy(&y, b.lane + l, sizeof(y));
    const typename detail::Register<T>::Mask z = (m & x) | (~m & y);
    __builtin_memcpy(result.lane + l, &z, sizeof(z));
  }
#else
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = mask.lane[l] != 0 ? a.lane[l] : b.lane[l];
#endif
  return result;
}

namespace detail {

/// Loads the lanes from `source`, which need not be aligned.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> load(const T* source) {
  Lanes<T> result;
  copy_lanes(result.lane, source);
  return result;
}

/// Stores the lanes at `target`, which need not be aligned.
template <class T>
HMPS_INLINE void store(T* target, const Lanes<T>& a) {
  copy_lanes(target, a.lane);
}

/// `value` in every lane whose bit is set in `lanes`, zero in the others.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> spread(std::uint32_t lanes, T value) {
  Lanes<T> result;
#if defined(HMPS_EACH_REGISTER)
  using Bits = typename Lanes<T>::Bits;
  using Mask = typename Register<T>::Mask;
  using Vector = typename Register<T>::Vector;
  HMPS_EACH_REGISTER {
    Mask bit{}, x;
    for (int k = 0; k < Register<T>::width; ++k) bit[k] = Bits{1} << (l + k);
    const Mask all = static_cast<Bits>(lanes) - Mask{};
    const Vector v = value - Vector{};
    __builtin_memcpy(&x, &v, sizeof(x));
    const Mask z = ((all & bit) != 0) & x;
    __builtin_memcpy(result.lane + l, &z, sizeof(z));
  }
#else
  for (int l = 0; l < Lanes<T>::width; ++l) result.lane[l] = (lanes >> l & 1u) != 0 ? value : T(0);
#endif
  return result;
}

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
  return detail::each(a, [](T x) { return std::sqrt(x); });
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

/// x^(-1/3), the only root that the reduced invariants need (\paper{16, 17}): NaN for x <= 0.
/// A guess from the bits of the number, then Newton's iteration, correct to about two units in the
/// last place; the lanes never leave the vector registers.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> inverse_cube_root(const Lanes<T>& x) {
  Lanes<T> y;
#if defined(HMPS_EACH_REGISTER)
  // The exponent of y is minus a third of that of x; working on the bits as on a number does that
  // and interpolates the mantissa: within 10 % for every normal number.
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

#undef HMPS_EACH_REGISTER
#undef HMPS_REGISTER_BYTES

}  // namespace hmps::inline HMPS_ABI

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
