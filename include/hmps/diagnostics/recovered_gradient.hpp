// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <type_traits>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/core/view_checks.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// Fits the displacements of the neighbours of one particle by A r + sum_k q_k(r) h_k, with weights, where r is the
/// reference position of the neighbour relative to the particle, and q are the products r_a r_b with a <= b.
template <int D>
class QuadraticFit {
 public:
  /// Adds a neighbour at `r`, displaced by `u` relative to the particle, with the weight `w`.
  void add(const Vector<double, D>& r, const Vector<double, D>& u, double w) {
    Eigen::Matrix<double, products, 1> q;
    for (int a = 0, k = 0; a < D; ++a)
      for (int b = a; b < D; ++b, ++k) q[k] = r[a] * r[b];
    rr_ += w * r * r.transpose();
    ru_ += w * r * u.transpose();
    rq_ += w * r * q.transpose();
    qq_ += w * q * q.transpose();
    qu_ += w * q * u.transpose();
  }
  /// A^T; zero without neighbours.
  [[nodiscard]] Eigen::Matrix<double, D, D> gradient() const {
    if (rr_.trace() == 0) return Eigen::Matrix<double, D, D>::Zero();
    const auto own = rr_.ldlt();
    const Eigen::Matrix<double, D, products> explained = own.solve(rq_);
    Eigen::Matrix<double, products, products> left = qq_ - rq_.transpose() * explained;
    left.diagonal().array() += indistinct * qq_.trace() / products;
    const Eigen::Matrix<double, products, D> h = left.ldlt().solve(qu_ - explained.transpose() * ru_);
    return own.solve(ru_) - explained * h;
  }

 private:
  static constexpr int products = D * (D + 1) / 2;
  /// The part of the mean square of the products that counts as none where a linear function explains the rest, as that
  /// of z z in a wall of two layers: h is then close to zero. With a tenth of it, the gradients of irregular clouds
  /// amplify noise by up to 6.8 instead of 2.8 in the mean square; with ten times it, the strain of bent walls of two
  /// layers is 10 % too small instead of 1.3 %.
  static constexpr double indistinct = 1e-2;

  Eigen::Matrix<double, D, D> rr_ = Eigen::Matrix<double, D, D>::Zero(), ru_ = rr_;
  Eigen::Matrix<double, D, products> rq_ = Eigen::Matrix<double, D, products>::Zero();
  Eigen::Matrix<double, products, products> qq_ = Eigen::Matrix<double, products, products>::Zero();
  Eigen::Matrix<double, products, D> qu_ = Eigen::Matrix<double, products, D>::Zero();
};

}  // namespace detail

/// WRITES the deformation gradient of every particle at positions `x` (m) to `F`, for the stress of thin walls and the
/// strain along their faces.
///
/// The F of \paper{11} is a mean over the neighbours. Where strain varies and a particle has neighbours on one side
/// only, as at the faces of a bent wall, it is that of a place further inside: in the outer layers of walls of two,
/// three and four layers the strain of bending is 35, 17 and 12 % too small. This function fits the displacements of
/// the neighbours by a quadratic function, weighted as the bonds, and returns its gradient at the particle itself.
/// Derivatives along a face become those at the particle, within 1.3 % when walls bend.
///
/// Derivatives across a face hardly change: on a lattice, where the neighbours of an outer particle lie in two layers,
/// the square of their depth is proportional to their depth, and what neighbours cannot tell apart counts as linear.
/// The same holds along edges and in corners. So det F is no better than that of \paper{11}, nor is a pressure computed
/// from it: in thin walls, `impose_plane_stress` corrects both. Noise of the positions is up to 2.8 times as large in
/// the mean square over a body. It is not the F from which forces derive. docs/fitted.md compares stresses.
///
/// Throws `InputError` for views of the wrong size. A particle without bonds has F = 1.
template <Bonds B, class X, class T, int D = B::dimension, Executor E = Serial>
void recovered_gradients(const B& bonds, const VectorView<X, D>& x, const MatrixView<T, D>& F, const E& execute = {}) {
  static_assert(!std::is_const_v<T>, "hmps: the deformation gradients are written; give a writable view of them");
  require_size(x, bonds.size(), "positions");
  require_size(F, bonds.size(), "deformation gradients");
  require_apart(F, "deformation gradients", x, "positions");
  const auto displacement = [&](std::size_t i) {
    return Vector<double, D>(x[i].template cast<double>() - bonds.reference(i));
  };
  detail::guarded(execute)(bonds.size(), [&](std::size_t i) {
    const Vector<double, D> own = displacement(i);
    detail::QuadraticFit<D> fit;
    bonds.for_each_bond(i, [&](std::size_t j, const auto& r0, auto w) {
      fit.add(r0.template cast<double>(), displacement(j) - own, static_cast<double>(w));
    });
    const Eigen::Matrix<double, D, D> slopes = fit.gradient();
    for (int k = 0; k < D * D; ++k) F(i, k) = static_cast<T>(slopes(k / D, k % D) + (k % D == k / D ? 1 : 0));
  });
}

}  // namespace hmps::inline HMPS_ABI
