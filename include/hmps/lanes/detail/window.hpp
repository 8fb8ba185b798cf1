// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/lanes/detail/registers.hpp"
#include "hmps/lanes/lanes.hpp"
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

namespace hmps::inline HMPS_ABI::detail {

/// Whether the target picks lanes from two registers with one instruction, so that reading a window takes less time
/// than reading several runs. Bonds that a program with AVX-512 makes work in one without, but slowly.
#if defined(__AVX512F__)
inline constexpr bool windows_are_fast = true;
#else
inline constexpr bool windows_are_fast = false;
#endif

/// A place in a window for each lane. A window is two consecutive blocks of numbers, so that the places are below
/// 2 `width`.
template <class T>
class WindowPlaces {
 public:
  static constexpr std::size_t width = static_cast<std::size_t>(Lanes<T>::width);
  using Stored = std::array<std::uint8_t, width>;  ///< the form in which bonds keep places

  HMPS_INLINE explicit WindowPlaces(const Stored& stored) {
    for (std::size_t l = 0; l < width; ++l) place_[l] = stored[l];
  }

  /// The numbers at these places of the window that begins at `window`, aligned as lanes are.
  [[nodiscard]] HMPS_INLINE Lanes<T> pick(const T* window) const {
    Lanes<T> picked;
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 4)
      _mm512_store_ps(picked.lane, _mm512_permutex2var_ps(_mm512_load_ps(window), _mm512_load_si512(place_),
                                                          _mm512_load_ps(window + width)));
    else
      _mm512_store_pd(picked.lane, _mm512_permutex2var_pd(_mm512_load_pd(window), _mm512_load_si512(place_),
                                                          _mm512_load_pd(window + width)));
#else
    for (std::size_t l = 0; l < width; ++l) picked.lane[l] = window[place_[l]];
#endif
    return picked;
  }

 private:
  alignas(lanes_bytes) BitsOf<T> place_[width];
};

}  // namespace hmps::inline HMPS_ABI::detail
