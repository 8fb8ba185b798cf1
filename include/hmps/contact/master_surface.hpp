// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/contact/metaball.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/detail/quad.hpp"

namespace hmps::inline HMPS_ABI {

/// The wall in front of a slave, accumulated over its master particles j in two passes: `reach` for each master (sum
/// and normal, \paper{28, 30}), then `mean` for each with c > 0 (velocity and strain, \paper{31, 33}). After that, call
/// the functions below these two.
///
/// Lengths in m; `r` = r_ij = x_j - x_i. The kernel depends only on |F_j^-1 r_ij|^2 = r_ij . A_j r_ij with A_j = F_j^-T
/// F_j^-1, so that one product gives both sum and gradient. A rotation of the master changes nothing; rigid masters may
/// use the identity.
template <class S, int D, Metaball Kernel>
class MasterSurface {
  using Quad = detail::Quad<S>;

 public:
  /// Adds one master to \paper{28, 30} and returns its c, zero beyond its reach.
  /// `over_radius_squared` is 1 / r_e^2 in 1/m2.
  S reach(const Matrix<S, D>& A, const Vector<S, D>& r, S over_radius_squared) {
    Quad columns[std::size_t{D}], place;
    for (int c = 0; c < D; ++c) detail::set_quad<S>(A.col(c), columns[c]);
    detail::set_quad<S>(r, place);
    return reach(columns, place, over_radius_squared);
  }
  /// The same from the columns of A_j and r_ij, padded with zeros.
  HMPS_INLINE S reach(const Quad* A, const Quad& r, S over_radius_squared) {
    Quad y = A[0] * r[0];
    for (int c = 1; c < D; ++c) y += A[c] * r[static_cast<std::size_t>(c)];
    const Quad product = r * y;
    const S s = (D == 3 ? product[0] + product[1] + product[2] : product[0] + product[1]) * over_radius_squared;
    const S at = detail::cut_at_one<S>(s, y), c = S(Kernel::value(at));
    y = y * S(Kernel::slope(at));
    y[3] = c;
    sum_ += y;
    return c;
  }

  /// Adds one master with metaball value `c`, B = F_j^-1 and its velocity to the means of \paper{31, 33}.
  void mean(S c, const Matrix<S, D>& B, const Vector<S, D>& v) {
    Quad columns[std::size_t{D}], velocity;
    for (int q = 0; q < D; ++q) detail::set_quad<S>(B.col(q), columns[q]);
    detail::set_quad<S>(v, velocity);
    mean(c, columns, velocity);
  }
  HMPS_INLINE void mean(S c, const Quad* B, const Quad& v) {
    velocity_ += v * c;
    for (int q = 0; q < D; ++q) inverse_[q] += B[q] * c;
  }

  /// C_im, \paper{28}.
  [[nodiscard]] S density() const { return sum_[3]; }

  /// Gradient of C_im with respect to x_i in 1/m: grad c = -(2 / r_e^2) (dc/ds) A_j r_ij.
  [[nodiscard]] Vector<S, D> gradient(S over_radius_squared) const {
    return S(-2) * over_radius_squared * detail::first<D, S>(sum_);
  }

  /// n_m, \paper{30}: the unit normal from the wall to the slave; the minus of \paper{30} turns the gradient outwards.
  /// Deep inside a wall the gradient vanishes (0/0): if the sum of (dc/ds) A_j r_ij is at most 1e-3 C_im r_e, returns
  /// false and sets `n` to zero. `radius` is r_e in m.
  [[nodiscard]] bool normal(S radius, Vector<S, D>& n) const {
    n = detail::first<D, S>(sum_);
    const S length = n.norm();
    if (!(length > S(1e-3) * density() * radius)) {
      n.setZero();
      return false;
    }
    n /= length;
    return true;
  }

  /// v_im, \paper{31}: velocity of the wall relative to a slave of velocity `slave`, m/s.
  [[nodiscard]] Vector<S, D> relative_velocity(const Vector<S, D>& slave) const {
    return detail::first<D, S>(velocity_) / density() - slave;
  }

  /// Mean stretch of the masters along the normal, \paper{32, 33}; the paper calls it strain.
  [[nodiscard]] S stretch(const Vector<S, D>& n) const { return density() / unturned(n).norm(); }

  /// sum c F_j^-1 n: the direction of the normal in the masters' unrotated configuration.
  [[nodiscard]] Vector<S, D> unturned(const Vector<S, D>& n) const {
    Vector<S, D> sum = Vector<S, D>::Zero();
    for (int q = 0; q < D; ++q) sum += n[q] * detail::first<D, S>(inverse_[q]);
    return sum;
  }

 private:
  Quad sum_{};                         // of (dc/ds) A_j r_ij and, as its last number, of c
  Quad velocity_{};                    // of c v_j
  Quad inverse_[std::size_t{D}] = {};  // of c F_j^-1
};

/// r_im in m, \paper{34, 35, 36}: distance of the slave's centre from the master surface, which lies half a particle
/// outside the outermost masters. `stretch` is that of `MasterSurface::stretch`, and `centres` is R_im.
template <class S>
[[nodiscard]] S surface_distance(S stretch, S centres, S spacing) {
  return stretch * (centres - S(0.5) * spacing);
}

}  // namespace hmps::inline HMPS_ABI
