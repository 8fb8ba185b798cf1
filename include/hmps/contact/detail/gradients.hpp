// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/lane_math.hpp"

/// How the lists of contact read deformation gradients.
namespace hmps::inline HMPS_ABI::detail {

/// Deformation gradients of undeformed or rigid particles.
template <class S, int D>
struct Undeformed {
  [[nodiscard]] Matrix<S, D> operator[](std::size_t) const { return Matrix<S, D>::Identity(); }
};

/// The deformation gradients of the particles `particle(l)`, one in each lane.
template <class S, int D, class Gradients, class Particle>
[[nodiscard]] HMPS_INLINE Matrix<Lanes<S>, D> gather_gradients(const Gradients& F, Particle&& particle) {
  Matrix<Lanes<S>, D> lanes;
  for (int l = 0; l < Lanes<S>::width; ++l) {
    const Matrix<S, D> own = F[particle(static_cast<std::size_t>(l))].template cast<S>();
    for (int c = 0; c < D * D; ++c) lanes(c % D, c / D).lane[l] = own(c % D, c / D);
  }
  return lanes;
}

}  // namespace hmps::inline HMPS_ABI::detail
