// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hmps/core/types.hpp"
#include "hmps/lanes/lanes.hpp"
#include "hmps/lanes/records.hpp"

namespace hmps {

/// `N` numbers per slot in the scalar type of the kernels, an array for each component: for bonds whose neighbours
/// follow each other, which are read a run of lanes at a time. A run may hang over either end of an array by as many
/// slots as there are lanes, so that it needs no test.
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
  /// A component of the block of slots from `slot` on.
  [[nodiscard]] HMPS_INLINE Lanes<K> lanes(std::size_t component, std::size_t slot) const {
    return load(&(*this)(component, slot));
  }
  HMPS_INLINE void keep(std::size_t component, std::size_t slot, const Lanes<K>& numbers) {
    store(&(*this)(component, slot), numbers);
  }

  /// The lanes of the slots from `first` on, which may be one of the margin; `run[component]` reads one component.
  struct Run {
    const SlotArrays& arrays;
    std::ptrdiff_t first;
    [[nodiscard]] HMPS_INLINE Lanes<K> operator[](std::size_t component) const {
      return load(&arrays(component, 0) + first);
    }
  };
  [[nodiscard]] HMPS_INLINE Run run(std::ptrdiff_t first) const { return {*this, first}; }

  /// Asks for all components of the lanes from `slot` on, which are going to be read soon; nothing happens beyond the
  /// last slot.
  HMPS_INLINE void prefetch(std::size_t slot) const {
    if (slot + 2 * margin >= pitch_) return;
    for (std::size_t k = margin + slot; k < values_.size(); k += pitch_) detail::prefetch(values_.data() + k);
  }
  [[nodiscard]] std::size_t bytes() const { return values_.size() * sizeof(K); }

 private:
  static constexpr std::size_t margin = static_cast<std::size_t>(Lanes<K>::width);
  /// An odd number of cache lines, so that equal slots of several components do not compete for the
  /// same set of a cache.
  static constexpr std::size_t pitch(std::size_t slots) {
    const std::size_t lines = (slots + 2 * margin + margin - 1) / margin;
    return (lines | 1) * margin;
  }
  std::size_t pitch_ = 0;
  std::vector<K> values_;
};

/// `N` numbers per slot in the scalar type of the kernels, those of a slot side by side: for bonds whose neighbours lie
/// anywhere, of which each is fetched as a whole and sorted into lanes.
template <class K, std::size_t N>
class SlotRecords {
 public:
  SlotRecords() = default;
  explicit SlotRecords(std::size_t slots) : values_(slots * pitch, K(0)) {}

  [[nodiscard]] HMPS_INLINE K& operator()(std::size_t component, std::size_t slot) {
    return values_[slot * pitch + component];
  }
  [[nodiscard]] HMPS_INLINE const K& operator()(std::size_t component, std::size_t slot) const {
    return values_[slot * pitch + component];
  }
  /// A component of the block of slots from `slot` on.
  [[nodiscard]] HMPS_INLINE Lanes<K> lanes(std::size_t component, std::size_t slot) const {
    return lanes_of<K>([&](int l)
                           HMPS_INLINE_LAMBDA { return (*this)(component, slot + static_cast<std::size_t>(l)); });
  }
  HMPS_INLINE void keep(std::size_t component, std::size_t slot, const Lanes<K>& numbers) {
    for (int l = 0; l < Lanes<K>::width; ++l) (*this)(component, slot + static_cast<std::size_t>(l)) = numbers.lane[l];
  }

  /// All components of the slots `slot[0]`, `slot[1]` and so on, one for each lane.
  [[nodiscard]] HMPS_INLINE std::array<Lanes<K>, N> gather(const Index* slot) const {
    return gather_records<N>(values_.data(), slot);
  }

  /// Asks for the block of slots from `slot` on, which is going to be read soon; nothing happens beyond the last.
  HMPS_INLINE void prefetch(std::size_t slot) const {
    const std::size_t end = (slot + static_cast<std::size_t>(Lanes<K>::width)) * pitch;
    if (end > values_.size()) return;
    for (std::size_t k = slot * pitch; k < end; k += detail::lanes_bytes / sizeof(K))
      detail::prefetch(values_.data() + k);
  }
  [[nodiscard]] std::size_t bytes() const { return values_.size() * sizeof(K); }

 private:
  static constexpr std::size_t pitch = record_pitch<K>(N);
  std::vector<K> values_;
};

}  // namespace hmps
