// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/math.hpp"
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

/// An upper bound of the largest singular value of F, exact in 2D and for equal stretches: the square root of the mean
/// plus sqrt(D - 1) standard deviations of the eigenvalues of F^T F (Wolkowicz and Styan 1980).
template <class T, int D>
[[nodiscard]] HMPS_INLINE T stretch_bound(const Matrix<T, D>& F) {
  using std::sqrt;
  Matrix<T, D> C = right_cauchy_green<T, D>(F);
  const T mean = trace<T, D>(C) * T(1. / D);
  for (int c = 0; c < D; ++c) C(c, c) = C(c, c) - mean;
  return sqrt(mean + sqrt(contract<T, D>(C, C) * T((D - 1.) / D)));
}

}  // namespace hmps::inline HMPS_ABI::detail
