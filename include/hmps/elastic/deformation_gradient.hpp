// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/force/terms.hpp"

namespace hmps {

namespace detail {

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
/// finite.
template <class K, int D, class T>
[[nodiscard]] Vector<double, D> common_displacement(const Blocks<K, D>& blocks, const VectorView<T, D>& x) {
  Vector<double, D> common = Vector<double, D>::Zero();
  if (blocks.size() == 0) return common;
  const Index i = blocks.particle(blocks.size() / 2);
  for (int c = 0; c < D; ++c) {
    const double u = static_cast<double>(x(i, c)) - blocks.reference(i, c);
    if (std::isfinite(u)) common[c] = u;
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

/// The deformation gradient F of the particles of one block by \paper{11}, the minimiser of the
/// error functional of \paper{9} as \paper{10} asks. Written in displacements u = x - x0, in which it
/// reads F = 1 + [sum (u_j - u_i) (x) r0 w] A^-1.
template <Bonds B, class K = typename B::Scalar, int D = B::dimension>
[[nodiscard]] HMPS_INLINE Matrix<Lanes<K>, D> deformation_gradient_lanes(
    const B& bonds, std::size_t block, const typename B::template Slots<std::size_t{D}>& displacement,
    const Matrix<Lanes<K>, D>& shape_inverse) {
  using T = Lanes<K>;
  const std::size_t slot = block * B::width;
  Vector<T, D> u;
  Matrix<T, D> sum;
  for (int d = 0; d < D; ++d) u[d] = displacement.lanes(static_cast<std::size_t>(d), slot);
  for (int k = 0; k < D * D; ++k) sum(k % D, k / D) = T(0);
  bonds.for_each_row(block, [&](const auto& bond) HMPS_INLINE_LAMBDA {
    const T w = bond.weight();
    const auto neighbour = bond.gather(displacement);
    Vector<T, D> relative;
    for (int row = 0; row < D; ++row) relative[row] = w * (neighbour[static_cast<std::size_t>(row)] - u[row]);
    for (int col = 0; col < D; ++col)
      if (bond.along(col))
        for (int row = 0; row < D; ++row) sum(row, col) += relative[row] * bond.offset(col);
  });
  Matrix<T, D> F = product(sum, shape_inverse);
  for (int d = 0; d < D; ++d) F(d, d) += T(1);
  return F;
}

}  // namespace detail

/// A term of `internal_force` that adds no force but writes the deformation gradient of every
/// particle into the user's array as the first sweep passes, for contact and diagnostics.
template <class T, int D>
struct Record {
  MatrixView<T, D> target;

  template <class K>
  HMPS_INLINE void couple(const BlockOfParticles<K, D>& particles, Coupling<K, D>&) const {
    const auto& F = particles.deformation_gradient;
    detail::deliver(particles.blocks(), particles.block(), target, [&](int k) { return F(k % D, k / D); });
  }
};

/// Records deformation gradients into `target`, one per particle of the bonds.
template <class T, int D>
[[nodiscard]] Record<T, D> record(const MatrixView<T, D>& target) {
  return {target};
}

/// The estimator alone: writes F (\paper{11}) of every particle at positions `x` (m) into `F`. Throws
/// `InputError` for views of the wrong size.
template <Bonds B, class X, class T, int D = B::dimension, Executor E = Serial>
void deformation_gradient(const B& bonds, const VectorView<X, D>& x, const MatrixView<T, D>& F, const E& execute = {}) {
  require_size(x, bonds.size(), "positions");
  require_size(F, bonds.size(), "deformation gradients");
  using K = typename B::Scalar;
  typename B::template Slots<std::size_t{D}> displacement(bonds.slot_count());
  const Vector<double, D> common = detail::common_displacement(bonds, x);
  execute(bonds.block_count(),
          [&](std::size_t block) { detail::stage_displacement(bonds, block, x, common, displacement); });
  execute(bonds.block_count(), [&](std::size_t block) {
    const auto inverse = bonds.shape_inverse_lanes(block);
    const auto gradient = detail::deformation_gradient_lanes(bonds, block, displacement, inverse);
    Coupling<K, D> unused;
    Record<T, D>{F}.couple(BlockOfParticles<K, D>(bonds, block, gradient, inverse), unused);
  });
}

}  // namespace hmps
