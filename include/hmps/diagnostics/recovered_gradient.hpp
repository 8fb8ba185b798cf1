// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/deformation_gradient.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// Fits the displacements of the neighbours of one particle by A r + sum_k q_k(r) h_k, with weights, where r is the
/// reference position of the neighbour relative to the particle, and q are the products r_a r_b with a <= b.
template <int D>
class QuadraticFit {
 public:
  /// Adds a neighbour at `r` (dimensionless), displaced by `u` relative to the particle, with the weight `w`.
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
  [[nodiscard]] bool empty() const { return rr_.trace() == 0; }
  /// A^T.
  [[nodiscard]] Eigen::Matrix<double, D, D> gradient() const {
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
  /// amplify noise of the displacements by up to 6.8 instead of 2.8; with ten times it, the strain of bent walls of two
  /// layers is 10 % too small instead of 1.3 %.
  static constexpr double indistinct = 1e-2;

  Eigen::Matrix<double, D, D> rr_ = Eigen::Matrix<double, D, D>::Zero(), ru_ = rr_;
  Eigen::Matrix<double, D, products> rq_ = Eigen::Matrix<double, D, products>::Zero();
  Eigen::Matrix<double, products, products> qq_ = Eigen::Matrix<double, products, products>::Zero();
  Eigen::Matrix<double, products, D> qu_ = Eigen::Matrix<double, products, D>::Zero();
};

}  // namespace detail

/// WRITES the deformation gradient of every particle at positions `x` (m) to `F`, for the output of strain and stress.
///
/// The F of \paper{11} is a mean over the neighbours. Where strain varies and a particle has neighbours on one side
/// only, as at the faces of a bent wall, it is that of a place further inside: in the outer layers of walls of two,
/// three and four layers the strain of bending is 34, 18 and 12 % too small. This function fits the displacements of
/// the neighbours by a quadratic function, weighted as the bonds, and returns its gradient at the particle itself. What
/// neighbours cannot tell apart counts as linear: across a wall of two layers, strain is their mean. The outermost
/// particles lie half a layer inside the surface. docs/fitted.md compares stresses.
///
/// It is not the F from which forces derive. Noise of positions is up to 2.8 times as large in it as in the other.
/// Throws `InputError` for views of the wrong size.
template <Bonds B, class X, class T, int D = B::dimension, Executor E = Serial>
void recovered_gradients(const B& bonds, const VectorView<X, D>& x, const MatrixView<T, D>& F, const E& execute = {}) {
  static_assert(!std::is_const_v<T>, "hmps: the deformation gradients are written; give a writable view of them");
  deformation_gradient(bonds, x, F, execute);
  const double length = std::sqrt(static_cast<double>(bonds.standard_lambda()));
  const auto displacement = [&](std::size_t i) {
    return Vector<double, D>(x[i].template cast<double>() - bonds.reference(i));
  };
  execute(bonds.size(), [&](std::size_t i) {
    const Vector<double, D> own = displacement(i);
    detail::QuadraticFit<D> fit;
    bonds.for_each_bond(i, [&](std::size_t j, const auto& r0, auto w) {
      const Vector<double, D> r = r0.template cast<double>() / length, u = (displacement(j) - own) / length;
      fit.add(r, u, static_cast<double>(w));
    });
    if (fit.empty()) return;
    const Eigen::Matrix<double, D, D> slopes = fit.gradient();
    for (int k = 0; k < D * D; ++k) F(i, k) = static_cast<T>(slopes(k / D, k % D) + (k % D == k / D ? 1 : 0));
  });
}

}  // namespace hmps::inline HMPS_ABI
