// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <new>

#include "hmps/core/abi.hpp"
#include "hmps/lanes/detail/registers.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// An allocator whose memory is aligned as `Lanes` are, so that a block of lanes lies in one cache line.
template <class T>
struct AlignedAllocator {
  using value_type = T;

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{lanes_bytes}));
  }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{lanes_bytes}); }

  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

}  // namespace hmps::inline HMPS_ABI::detail
