// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Brings `view` of the particles of `block` into `slots`, in the scalar type of the kernels.
/// `value(number, slot, component)` is what is kept of each number.
template <class K, int D, class T, class Slots, class Value>
HMPS_INLINE void stage(const Blocks<K, D>& blocks, std::size_t block, const VectorView<T, D>& view, Slots& slots,
                       Value&& value) {
  constexpr std::size_t width = Blocks<K, D>::width;
  const std::size_t first = block * width;
  const bool consecutive = blocks.consecutive(block);
  for (int c = 0; c < D; ++c) {
    const auto component = static_cast<std::size_t>(c);
    if (consecutive) {
      Lanes<K> staged;  // apart from the slots: the compiler sees that no source is overwritten, and works in registers
      const std::size_t i = blocks.particle(first);
      if (view.stride() == static_cast<std::ptrdiff_t>(sizeof(T))) {
        const T* source = view.base(c) + i;
        for (std::size_t l = 0; l < width; ++l) staged.lane[l] = value(source[l], first + l, c);
      } else {
        for (std::size_t l = 0; l < width; ++l) staged.lane[l] = value(view(i + l, c), first + l, c);
      }
      slots.keep(component, first, staged);
    } else {
      for (std::size_t l = 0; l < width; ++l) {
        const Index i = blocks.particle(first + l);
        if (i != Blocks<K, D>::none) slots(component, first + l) = value(view(i, c), first + l, c);
      }
    }
  }
}
template <class K, int D, class T, class Slots>
HMPS_INLINE void stage(const Blocks<K, D>& blocks, std::size_t block, const VectorView<T, D>& view, Slots& slots) {
  stage(blocks, block, view, slots, [](T number, std::size_t, int) { return static_cast<K>(number); });
}

/// The displacement (m) of a particle in the middle of the order of the sweeps, zero where it is not
/// finite; or what `Blocks::subtract_displacement` was given.
template <class K, int D, class T>
[[nodiscard]] Vector<double, D> common_displacement(const Blocks<K, D>& blocks, const VectorView<T, D>& x) {
  if (blocks.subtracted_displacement()) return *blocks.subtracted_displacement();
  Vector<double, D> common = Vector<double, D>::Zero();
  if (blocks.size() == 0) return common;
  const Index i = blocks.particle(blocks.size() / 2);
  for (int c = 0; c < D; ++c) {
    const double u = static_cast<double>(x(i, c)) - blocks.reference(i, c);
    if (detail::is_finite(u)) common[c] = u;
  }
  return common;
}

/// Displacements from the reference configuration less those that all particles have in `common`,
/// taken in double precision before they are rounded to that of the kernels: what a bond needs of a
/// position is lost in the position's leading digits, and how far the body has travelled is nothing
/// to a bond.
template <class K, int D, class T, class Slots>
HMPS_INLINE void stage_displacement(const Blocks<K, D>& blocks, std::size_t block, const VectorView<T, D>& x,
                                    const Vector<double, D>& common, Slots& slots) {
  stage(blocks, block, x, slots, [&](T number, std::size_t slot, int c) {
    return static_cast<K>((static_cast<double>(number) - blocks.reference_slots(c)[slot]) - common[c]);
  });
}

/// Hands `N` numbers of each particle of `block` out to the user's `view`; `lanes(component)` are those
/// of the particles in their lanes, and `put(entry, number, particle)` is what becomes of one.
template <class K, int D, class T, int N, class Component, class Put>
HMPS_INLINE void deliver(const Blocks<K, D>& blocks, std::size_t block, const View<T, N>& view, Component&& lanes,
                         Put&& put) {
  constexpr std::size_t width = Blocks<K, D>::width;
  const std::size_t first = block * width;
  const bool consecutive = blocks.consecutive(block) && view.stride() == static_cast<std::ptrdiff_t>(sizeof(T));
  for (int c = 0; c < N; ++c) {
    const Lanes<K> numbers = lanes(c);
    if (consecutive) {
      const std::size_t i = blocks.particle(first);
      T* target = view.base(c) + i;
      T entries[width];  // a copy, for the same reason as in `stage`
      std::copy_n(target, width, entries);
      for (std::size_t l = 0; l < width; ++l) put(entries[l], numbers.lane[l], i + l);
      std::copy_n(entries, width, target);
    } else {
      for (std::size_t l = 0; l < width; ++l) {
        const Index i = blocks.particle(first + l);
        if (i != Blocks<K, D>::none) put(view(i, c), numbers.lane[l], i);
      }
    }
  }
}
template <class K, int D, class T, int N, class Component>
HMPS_INLINE void deliver(const Blocks<K, D>& blocks, std::size_t block, const View<T, N>& view, Component&& lanes) {
  deliver(blocks, block, view, lanes, [](T& entry, K number, std::size_t) { entry = static_cast<T>(number); });
}

}  // namespace hmps::inline HMPS_ABI::detail
