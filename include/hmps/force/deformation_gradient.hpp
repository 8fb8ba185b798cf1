// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/detail/staging.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// The deformation gradient F (\paper{11}) of the particles of one block: the minimiser of the error functional of
/// \paper{9} by \paper{10}. In displacements u = x - x0 it is F = 1 + [sum (u_j - u_i) (x) r0 w] A^-1.
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
    static_assert(RequireRow<std::remove_cvref_t<decltype(bond)>, B>::value);
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

/// Writes the deformation gradient F (\paper{11}) of every particle at positions `x` (m) to `F`. Throws `InputError`
/// for views of the wrong size.
template <Bonds B, class X, class T, int D = B::dimension, Executor E = Serial>
void deformation_gradient(const B& bonds, const VectorView<X, D>& x, const MatrixView<T, D>& F, const E& execute = {}) {
  require_size(x, bonds.size(), "positions");
  require_size(F, bonds.size(), "deformation gradients");
  typename B::template Slots<std::size_t{D}> displacement(bonds.slot_count());
  const auto common = detail::common_displacement(bonds, x);
  detail::guarded(execute)(bonds.block_count(), [&](std::size_t block) {
    detail::stage_displacement(bonds, block, x, common, displacement);
  });
  detail::guarded(execute)(bonds.block_count(), [&](std::size_t block) {
    const auto gradient =
        detail::deformation_gradient_lanes(bonds, block, displacement, bonds.shape_inverse_lanes(block));
    detail::deliver(bonds, block, F, [&](int k) { return gradient(k % D, k / D); });
  });
}

/// Explains calls with arrays in place of views.
template <class... Arguments>
requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> deformation_gradient(
    const Arguments&...);

}  // namespace hmps::inline HMPS_ABI
