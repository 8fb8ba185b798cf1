// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// r_i in m: how far the deformed slave reaches towards a wall of unit normal `normal`, \paper{37}.
/// The ellipsoid |F^-1 x| = r_0 has its point with normal -n at x = -r_0 F F^T n / |F^T n|, whose
/// component along -n is r_i = r_0 |F^T n|: no root finding, no inverse.
/// `F` is the slave's deformation gradient, `radius` r_0 in m; see `Organ::radius`.
template <class S, int D>
[[nodiscard]] S slave_support(const Matrix<S, D>& F, const Vector<S, D>& normal, S radius) {
  return radius * (F.transpose() * normal).norm();
}

/// Penetration p in m, \paper{38}: `support` is r_i, and `distance` is r_im, that of the slave's centre from the master
/// surface. Zero if they do not touch.
template <class S>
[[nodiscard]] S penetration(S support, S distance) {
  return support > distance ? support - distance : S(0);
}

}  // namespace hmps::inline HMPS_ABI
