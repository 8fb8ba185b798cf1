// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/lanes/detail/registers.hpp"
#include "hmps/lanes/lanes.hpp"
#if defined(__FMA__) || defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace hmps::inline HMPS_ABI::detail {

/// a b + c. With AVX2 and FMA, or AVX-512, it is one instruction, so that the bits do not depend on the code around it:
/// in a sum of two products, a compiler fuses one or the other, from case to case. On other targets it still may.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> multiply_add(const Lanes<T>& a, const Lanes<T>& b, const Lanes<T>& c) {
#if defined(HMPS_EACH_REGISTER)
  Lanes<T> result;
  HMPS_EACH_REGISTER {
    typename Register<T>::Vector x, y, z;
    __builtin_memcpy(&x, a.lane + l, sizeof(x));
    __builtin_memcpy(&y, b.lane + l, sizeof(y));
    __builtin_memcpy(&z, c.lane + l, sizeof(z));
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 4)
      z = _mm512_fmadd_ps(x, y, z);
    else
      z = _mm512_fmadd_pd(x, y, z);
#elif defined(__AVX2__) && defined(__FMA__)
    if constexpr (sizeof(T) == 4)
      z = _mm256_fmadd_ps(x, y, z);
    else
      z = _mm256_fmadd_pd(x, y, z);
#else
    z = x * y + z;
#endif
    __builtin_memcpy(result.lane + l, &z, sizeof(z));
  }
  return result;
#else
  return a * b + c;
#endif
}

}  // namespace hmps::inline HMPS_ABI::detail
