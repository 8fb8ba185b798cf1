// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"

/// The vector registers of the target, where the compiler has vector types: `Register` and `HMPS_EACH_REGISTER`.
namespace hmps::inline HMPS_ABI::detail {

/// Bytes of all lanes: the size of the largest vector registers in use today.
inline constexpr std::size_t lanes_bytes = 64;
/// The integer type with the size of `T`, used for masks.
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
/// The lanes in one register of the target's instruction set. Never pass a register to another function: the calling
/// convention depends on compiler flags.
template <class T, std::size_t bytes = HMPS_REGISTER_BYTES>
struct Register {
  typedef T Vector __attribute__((vector_size(bytes)));
  typedef BitsOf<T> Mask __attribute__((vector_size(bytes)));
  static constexpr int width = static_cast<int>(bytes / sizeof(T));
};
/// `HMPS_EACH_REGISTER { ... }` visits the lanes of `T` one register at a time; `l` is its first lane. GCC spills
/// vectors larger than a register to memory after every operation, which costs a factor of eight.
#define HMPS_EACH_REGISTER                                                                       \
  _Pragma("GCC unroll 4") for (int l = 0; l < static_cast<int>(detail::lanes_bytes / sizeof(T)); \
                               l += detail::Register<T>::width)

// The square root of a register. `std::sqrt` sets errno, so that compilers evaluate it lane by lane.
#if defined(__clang__)
#if __has_builtin(__builtin_elementwise_sqrt)
#define HMPS_ROOT_OF_FLOATS(x) __builtin_elementwise_sqrt(x)
#define HMPS_ROOT_OF_DOUBLES(x) __builtin_elementwise_sqrt(x)
#endif
#elif defined(__AVX512F__)  // 4: rounds as the current mode says
#define HMPS_ROOT_OF_FLOATS(x) __builtin_ia32_sqrtps512_mask(x, x, static_cast<short>(-1), 4)
#define HMPS_ROOT_OF_DOUBLES(x) __builtin_ia32_sqrtpd512_mask(x, x, static_cast<char>(-1), 4)
#elif defined(__AVX2__)
#define HMPS_ROOT_OF_FLOATS(x) __builtin_ia32_sqrtps256(x)
#define HMPS_ROOT_OF_DOUBLES(x) __builtin_ia32_sqrtpd256(x)
#elif defined(__SSE2__)
#define HMPS_ROOT_OF_FLOATS(x) __builtin_ia32_sqrtps(x)
#define HMPS_ROOT_OF_DOUBLES(x) __builtin_ia32_sqrtpd(x)
#endif
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

/// Prefetches the cache line of `address`; never faults.
HMPS_INLINE void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#endif
}

}  // namespace hmps::inline HMPS_ABI::detail
