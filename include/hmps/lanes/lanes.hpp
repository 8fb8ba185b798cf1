// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/lanes/detail/registers.hpp"

namespace hmps::inline HMPS_ABI {

/// A pack of `width` numbers, one particle per lane: the scalar type in which the sweeps evaluate laws and terms.
/// Generic code uses it like a number: `+ - * /`, comparisons (which return a `LaneMask`), `select`, and the functions
/// of `lane_math.hpp`, all found by argument-dependent lookup. It may be the scalar of an Eigen matrix.
///
/// The size is 64 bytes for every `T` and every instruction set, so that no layout depends on compiler flags; each
/// operation uses as many registers as it needs. The numbers are stored as a plain array for the same reason: passing
/// it never uses a vector register.
template <class T>
struct alignas(detail::lanes_bytes) Lanes {
  static_assert(std::same_as<T, float> || std::same_as<T, double>,
                "hmps: lanes hold float or double: give one of them as the scalar of bonds, such as "
                "hmps::LatticeBonds<double, 3>");
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

/// The result of comparing `Lanes<T>`: each lane has either all bits set or none.
template <class T>
struct alignas(detail::lanes_bytes) LaneMask {
  typename Lanes<T>::Bits lane[static_cast<std::size_t>(Lanes<T>::width)];

  /// Fails to compile, and says what to use in place of an `if` on values.
  template <std::same_as<bool> B>
  explicit operator B() const {
    static_assert(!std::same_as<B, bool>,
                  "hmps: a comparison of lanes has a result for each of many particles, so that there can be no `if`, "
                  "`? :`, `&&`, `||` or `!` on it: use hmps::select(condition, this, that)");
    return false;
  }
};

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

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI

/// Tells Eigen that lanes are numbers, and by `Literal` that it may turn a plain number beside a matrix of them into
/// lanes: `mu * S` and `S / mu` with `double mu`.
template <class T>
struct Eigen::NumTraits<hmps::Lanes<T>> : Eigen::GenericNumTraits<hmps::Lanes<T>> {
  using Real = hmps::Lanes<T>;
  using NonInteger = hmps::Lanes<T>;
  using Nested = hmps::Lanes<T>;
  using Literal = hmps::Lanes<T>;
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

/// Arrays of lanes have the alignment of lanes. Eigen need not request an alignment, and must not request a lower one.
template <class T, int Size>
struct Eigen::internal::compute_default_alignment<hmps::Lanes<T>, Size> {
  enum { value = 0 };
};
