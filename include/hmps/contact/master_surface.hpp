// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/core/types.hpp"

namespace hmps {

/// The wall that a slave sees, gathered over its master particles j in two passes: `reach` for each
/// (sum and normal, \paper{28, 30}), then `mean` for each with c > 0 (velocity and strain,
/// \paper{31, 33}); then the functions below them.
///
/// Lengths in m; `r` = r_ij = x_j - x_i. The kernel depends on |F_j^-1 r_ij|^2 = r_ij . A_j r_ij alone,
/// with A_j = F_j^-T F_j^-1, so one product serves sum and gradient; a rotation of the master changes
/// nothing, and rigid masters pass the identity.
template <class S, int D, Metaball Ball = PaperMetaball>
struct MasterSurface {
  S density = 0;                                     ///< C_im, \paper{28}.
  Vector<S, D> gradient = Vector<S, D>::Zero();      ///< Sum of (dc/ds) A_j r_ij (see `normal`).
  Vector<S, D> velocity_sum = Vector<S, D>::Zero();  ///< Sum of c v_j.
  Matrix<S, D> inverse_sum = Matrix<S, D>::Zero();   ///< Sum of c F_j^-1.

  /// Adds one master to \paper{28, 30} and returns its c, zero beyond its reach.
  /// `over_radius_squared` is 1 / r_e^2 in 1/m2.
  S reach(const Matrix<S, D>& A, const Vector<S, D>& r, S over_radius_squared) {
    const Vector<S, D> y = A.lazyProduct(r);
    const S s = r.dot(y) * over_radius_squared;
    if (!(s < S(1))) return 0;
    const S c = Ball::value(s);
    density += c;
    gradient += Ball::slope(s) * y;
    return c;
  }

  /// Adds one master with metaball value `c`, B = F_j^-1 and its velocity to the means of \paper{31, 33}.
  void mean(S c, const Matrix<S, D>& B, const Vector<S, D>& velocity) {
    velocity_sum += c * velocity;
    inverse_sum += c * B;
  }

  /// n_m, \paper{30}: the unit normal from the wall to the slave. The gradient is taken with respect
  /// to x_i, grad c = -(2 / r_e^2) (dc/ds) A_j r_ij, so the minus of \paper{30} turns it outwards.
  /// Deep inside a wall the sum vanishes (0/0): returns false, and leaves `n` zero, where it is
  /// below a thousandth of what its terms could add up to.
  [[nodiscard]] bool normal(S radius, Vector<S, D>& n) const {
    const S length = gradient.norm();
    if (!(length > S(1e-3) * density * radius)) {
      n.setZero();
      return false;
    }
    n = gradient / length;
    return true;
  }

  /// v_im, \paper{31}: velocity of the wall relative to a slave of velocity `slave`, m/s.
  [[nodiscard]] Vector<S, D> relative_velocity(const Vector<S, D>& slave) const {
    return velocity_sum / density - slave;
  }

  /// Mean stretch of the masters along the normal, \paper{32, 33}; the paper calls it strain.
  [[nodiscard]] S stretch(const Vector<S, D>& n) const { return density / (inverse_sum * n).norm(); }
};

/// r_im in m, \paper{34, 35, 36}: distance of the slave's centre from the master surface, which lies
/// half a particle outside the outermost masters. `stretch` as of `MasterSurface::stretch`,
/// `centres` is R_im.
template <class S>
[[nodiscard]] S surface_distance(S stretch, S centres, S spacing) {
  return stretch * (centres - S(0.5) * spacing);
}

}  // namespace hmps
