// SPDX-License-Identifier: MIT
// The program's own operator new, which counts bytes. So the memory of any scene can be measured, whatever allocates
// it.
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tradeoff/meter.hpp"

namespace {

std::atomic<std::size_t> held{0}, most{0};

void* count(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t size = malloc_usable_size(memory), now = held.fetch_add(size) + size;
  std::size_t before = most;
  while (now > before && !most.compare_exchange_weak(before, now)) {
  }
  return memory;
}
void release(void* memory) noexcept {
  if (memory == nullptr) return;
  held -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

std::size_t tradeoff::allocated_bytes() { return held; }
std::size_t tradeoff::peak_bytes() { return most; }
void tradeoff::forget_peak() { most = held.load(); }

// The other forms of new and delete call these.
void* operator new(std::size_t size) { return count(std::malloc(size > 0 ? size : 1)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  return count(std::aligned_alloc(align, (size + align - 1) / align * align));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
