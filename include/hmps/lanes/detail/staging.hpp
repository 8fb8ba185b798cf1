// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/detail/registers.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Prefetches the entries of `view` for the particles of `block`; does nothing beyond the last block. The processor
/// does this itself only where particles are consecutive.
template <class K, int D, class T, int N>
HMPS_INLINE void prefetch_particles(const Blocks<K, D>& blocks, std::size_t block, const View<T, N>& view) {
  constexpr std::size_t width = Blocks<K, D>::width;
  if (block >= blocks.block_count()) return;
  for (std::size_t l = 0; l < width; ++l) {
    const Index i = blocks.particle(block * width + l);
    if (i != Blocks<K, D>::none)
      for (int c = 0; c < N; ++c) prefetch(&view(i, c));
  }
}

/// Copies the entries of `view` for the particles of `block` into `slots`, converted to the scalar type of the sweeps.
/// `value(number, slot, component)` transforms each number on the way.
template <class K, int D, class T, class Slots, class Value>
HMPS_INLINE void stage(const Blocks<K, D>& blocks, std::size_t block, const VectorView<T, D>& view, Slots& slots,
                       Value&& value) {
  constexpr std::size_t width = Blocks<K, D>::width;
  const std::size_t first = block * width;
  const bool consecutive = blocks.consecutive(block);
  // Copying one block takes less time than the memory needs, hence two blocks ahead.
  if (!consecutive) prefetch_particles(blocks, block + 2, view);
  for (int c = 0; c < D; ++c) {
    const auto component = static_cast<std::size_t>(c);
    if (consecutive) {
      Lanes<K> staged;  // a local copy, so that the compiler knows that no source is overwritten
      const std::size_t i = blocks.particle(first);
      if (view.stride() == static_cast<std::ptrdiff_t>(sizeof(T))) {
        const T* source = view.base(c) + i;
        for (std::size_t l = 0; l < width; ++l) staged.lane[l] = value(source[l], first + l, c);
      } else {
        for (std::size_t l = 0; l < width; ++l) staged.lane[l] = value(view(i + l, c), first + l, c);
      }
      slots.store(component, first, staged);
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

/// The displacements (m) that are subtracted from particles before they are rounded to the scalar type of the sweeps.
template <int D>
struct CommonDisplacement {
  Vector<double, D> of_all = Vector<double, D>::Zero();
  /// By piece of the body, in place of `of_all`; empty unless a piece has moved far from the others.
  std::vector<Vector<double, D>> of_piece{};
};

/// The argument of `Blocks::subtract_displacement` if there is one, otherwise the displacement of the particle in the
/// middle of the sweep order, and of each piece that has moved far from it, with components that are not finite set to
/// zero.
template <class K, int D, class T>
[[nodiscard]] CommonDisplacement<D> common_displacement(const Blocks<K, D>& blocks, const VectorView<T, D>& x) {
  if (blocks.subtracted_displacement()) return {*blocks.subtracted_displacement()};
  if (blocks.size() == 0) return {};
  const auto displacement = [&](Index i) {
    Vector<double, D> u = Vector<double, D>::Zero();
    for (int c = 0; c < D; ++c) {
      const double moved = static_cast<double>(x(i, c)) - blocks.reference(i, c);
      if (is_finite(moved)) u[c] = moved;
    }
    return u;
  };
  CommonDisplacement<D> common{displacement(blocks.particle(blocks.size() / 2))};
  const std::vector<Index>& middle = blocks.pieces().middle();
  for (std::size_t p = 0; p < middle.size(); ++p) {
    const Vector<double, D> own = displacement(middle[p]);
    if (!((own - common.of_all).norm() > blocks.far_apart())) continue;
    common.of_piece.resize(middle.size(), common.of_all);
    common.of_piece[p] = own;
  }
  return common;
}

/// As `stage_displacement`, with a displacement of its own for each piece.
template <class K, int D, class T, class Slots>
HMPS_COLD void stage_displacement_of_pieces(const Blocks<K, D>& blocks, std::size_t block, const VectorView<T, D>& x,
                                            const CommonDisplacement<D>& common, Slots& slots) {
  constexpr std::size_t width = Blocks<K, D>::width;
  for (std::size_t slot = block * width; slot < (block + 1) * width; ++slot)
    if (const Index i = blocks.particle(slot); i != Blocks<K, D>::none)
      for (int c = 0; c < D; ++c)
        slots(static_cast<std::size_t>(c), slot) =
            static_cast<K>((static_cast<double>(x(i, c)) - blocks.reference_slots(c)[slot]) -
                           common.of_piece[blocks.pieces().of(slot)][c]);
}

/// Stages displacements from the reference configuration minus `common`. The difference is taken in double before it is
/// rounded to the scalar type of the sweeps: rounding the positions themselves would lose the digits that a bond needs,
/// and a common displacement does not change any bond.
template <class K, int D, class T, class Slots>
HMPS_INLINE void stage_displacement(const Blocks<K, D>& blocks, std::size_t block, const VectorView<T, D>& x,
                                    const CommonDisplacement<D>& common, Slots& slots) {
  if (!common.of_piece.empty()) return stage_displacement_of_pieces(blocks, block, x, common, slots);
  stage(blocks, block, x, slots, [&](T number, std::size_t slot, int c) {
    return static_cast<K>((static_cast<double>(number) - blocks.reference_slots(c)[slot]) - common.of_all[c]);
  });
}

/// Writes `N` numbers per particle of `block` to the user's `view`. `lanes(component)` returns the numbers; `put(entry,
/// number, particle)` stores one of them in the view.
template <class K, int D, class T, int N, class Component, class Put>
HMPS_INLINE void deliver(const Blocks<K, D>& blocks, std::size_t block, const View<T, N>& view, Component&& lanes,
                         Put&& put) {
  constexpr std::size_t width = Blocks<K, D>::width;
  const std::size_t first = block * width;
  const bool consecutive = blocks.consecutive(block) && view.stride() == static_cast<std::ptrdiff_t>(sizeof(T));
  // Summing the next block takes longer than the memory needs, hence one block ahead.
  if (!blocks.consecutive(block)) prefetch_particles(blocks, block + 1, view);
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
