// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/detail/aligned_allocator.hpp"
#include "hmps/lanes/detail/registers.hpp"
#include "hmps/lanes/detail/window.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI::detail {

#if defined(__GNUC__) || defined(__clang__)
/// The lanes of one register; the first half lies at `first`, the second half at `second`.
template <class T, int... k>
HMPS_INLINE void join_halves(T* target, const T* first, const T* second, std::integer_sequence<int, k...>) {
  typename Register<T, lanes_bytes / 2>::Vector a, b;
  __builtin_memcpy(&a, first, sizeof(a));
  __builtin_memcpy(&b, second, sizeof(b));
  const auto both = __builtin_shufflevector(a, b, k...);
  __builtin_memcpy(target, &both, sizeof(both));
}
#endif

/// Loads the first half of the lanes from `first` and the second half from `second`.
template <class T>
[[nodiscard]] HMPS_INLINE Lanes<T> load_halves(const T* first, const T* second) {
  constexpr int width = Lanes<T>::width;
  Lanes<T> result;
#if defined(__GNUC__) || defined(__clang__)
  using Vector = typename Register<T>::Vector;
  if constexpr (Register<T>::width == width) {  // put together in the register, not in memory
    join_halves(result.lane, first, second + width / 2, std::make_integer_sequence<int, width>{});
  } else {
#pragma GCC unroll 4
    for (int l = 0; l < width; l += Register<T>::width) {
      Vector x;
      __builtin_memcpy(&x, (l < width / 2 ? first : second) + l, sizeof(x));
      __builtin_memcpy(result.lane + l, &x, sizeof(x));
    }
  }
#else
  for (int l = 0; l < width; ++l) result.lane[l] = (l < width / 2 ? first : second)[l];
#endif
  return result;
}

/// `N` numbers per slot in the scalar type of the sweeps, stored as one array per component. Bonds read the numbers of
/// neighbours with consecutive slots as one run of lanes. Each array has a margin of one block at both ends, so that a
/// run that crosses an end needs no test, and is aligned as lanes are.
template <class K, std::size_t N>
class SlotArrays {
 public:
  SlotArrays() = default;
  explicit SlotArrays(std::size_t slots) : pitch_(pitch(slots)), values_(N * pitch_, K(0)) {}

  [[nodiscard]] HMPS_INLINE K& operator()(std::size_t component, std::size_t slot) {
    return values_[component * pitch_ + margin + slot];
  }
  [[nodiscard]] HMPS_INLINE const K& operator()(std::size_t component, std::size_t slot) const {
    return values_[component * pitch_ + margin + slot];
  }
  /// One component of the block that starts at `slot`.
  [[nodiscard]] HMPS_INLINE Lanes<K> lanes(std::size_t component, std::size_t slot) const {
    return load(&(*this)(component, slot));
  }
  HMPS_INLINE void store(std::size_t component, std::size_t slot, const Lanes<K>& numbers) {
    detail::store(&(*this)(component, slot), numbers);
  }

  /// A run: the lanes of consecutive slots from `first`, which may lie in the margin. `run[component]` loads one
  /// component.
  struct Run {
    const SlotArrays& arrays;
    std::ptrdiff_t first;
    [[nodiscard]] HMPS_INLINE Lanes<K> operator[](std::size_t component) const {
      return load(&arrays(component, 0) + first);
    }
  };
  [[nodiscard]] HMPS_INLINE Run run(std::ptrdiff_t first) const { return {*this, first}; }

  /// Two half runs: the first half of the lanes from `first`, the second half from `second`.
  struct SplitRun {
    const SlotArrays& arrays;
    std::ptrdiff_t first, second;
    [[nodiscard]] HMPS_INLINE Lanes<K> operator[](std::size_t component) const {
      const K* const values = &arrays(component, 0);
      return load_halves(values + first, values + second);
    }
  };
  [[nodiscard]] HMPS_INLINE SplitRun run(std::ptrdiff_t first, std::ptrdiff_t second) const {
    return {*this, first, second};
  }

  /// The lanes that `places` picks from the two blocks that start at slot `first`, a multiple of `width`.
  struct WindowRun {
    const SlotArrays& arrays;
    std::size_t first;
    WindowPlaces<K> places;
    [[nodiscard]] HMPS_INLINE Lanes<K> operator[](std::size_t component) const {
      return places.pick(&arrays(component, first));
    }
  };
  [[nodiscard]] HMPS_INLINE WindowRun window(std::size_t first, const WindowPlaces<K>& places) const {
    return {*this, first, places};
  }

  /// Prefetches all components of the lanes from `slot`. Does nothing beyond the last slot.
  HMPS_INLINE void prefetch(std::size_t slot) const {
    if (slot + 2 * margin >= pitch_) return;
    for (std::size_t k = margin + slot; k < values_.size(); k += pitch_) detail::prefetch(values_.data() + k);
  }
  [[nodiscard]] std::size_t bytes() const { return values_.size() * sizeof(K); }

 private:
  static constexpr std::size_t margin = static_cast<std::size_t>(Lanes<K>::width);
  /// The stride is an odd number of cache lines, so that the components of one slot map to different cache sets.
  static constexpr std::size_t pitch(std::size_t slots) {
    const std::size_t lines = (slots + 2 * margin + margin - 1) / margin;
    return (lines | 1) * margin;
  }
  std::size_t pitch_ = 0;
  std::vector<K, AlignedAllocator<K>> values_;
};

}  // namespace hmps::inline HMPS_ABI::detail
