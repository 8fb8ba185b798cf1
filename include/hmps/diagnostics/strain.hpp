// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/core/view_checks.hpp"
#include "hmps/diagnostics/detail/recorded.hpp"
#include "hmps/force/detail/force_stress.hpp"

/// Strain for output, from deformation gradients: for one particle, and in the plural for all particles.
/// References: Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. 2008, chapter 4;
/// Holzapfel, Nonlinear Solid Mechanics, 2000, chapter 2.
namespace hmps::inline HMPS_ABI {

/// The Green-Lagrange strain E = (F^T F - 1) / 2, symmetric; zero for rigid motion. Computed from H = F - 1 as
/// (H + H^T + H^T H) / 2, which loses no digits where strain and rotation are small.
template <class T, int D>
[[nodiscard]] Matrix<T, D> green_lagrange_strain(const Matrix<T, D>& F) {
  const Matrix<T, D> H = F - Matrix<T, D>::Identity();
  return (H + H.transpose() + H.transpose() * H) / T(2);
}

/// The principal stretches, the largest first: the square roots of the eigenvalues of F^T F, which are the factors by
/// which fibres along its principal axes are longer than in the reference configuration. Their product is |det F|.
/// Rounding is relative to the largest: if that is 1, a stretch of 1e-6 has an error of up to 1e-9 in double.
template <class T, int D>
[[nodiscard]] Vector<T, D> principal_stretches(const Matrix<T, D>& F) {
  using Strain = Eigen::Matrix<T, D, D>;
  // Not computeDirect, which loses half of the digits if two stretches are equal.
  const Eigen::SelfAdjointEigenSolver<Strain> solver(Strain(green_lagrange_strain(F)), Eigen::EigenvaluesOnly);
  Vector<T, D> stretches;
  for (int c = 0; c < D; ++c) stretches[c] = std::sqrt(std::max(T(1) + T(2) * solver.eigenvalues()[D - 1 - c], T(0)));
  return stretches;
}

/// Writes the Green-Lagrange strain of every particle, column-major, computed in double precision. Throws `InputError`
/// for views of different sizes, and, naming the particle, for a deformation gradient that is not finite or that
/// nothing has written; and `StateError`, naming the particle, if a strain is not finite.
template <class T, int D, class R, Executor E = Serial>
void green_lagrange_strains(const MatrixView<T, D>& F, const MatrixView<R, D>& strain, const E& execute = {}) {
  require_finite(F, "the deformation gradient");
  detail::require_recorded(F);
  require_size(strain, F.size(), "strains");
  require_apart(strain, "strains", F, "deformation gradients");
  detail::guarded(execute)(F.size(), [&](std::size_t i) {
    const Matrix<double, D> gradient = F[i].template cast<double>();
    strain.set(i, green_lagrange_strain(gradient));
  });
  detail::require_finite_result<D>(strain, F, "Green-Lagrange strain");
}

/// Writes the principal stretches of every particle, the largest first, computed in double precision. Throws as
/// `green_lagrange_strains` does.
template <class T, int D, class R, Executor E = Serial>
void principal_stretches(const MatrixView<T, D>& F, const VectorView<R, D>& stretches, const E& execute = {}) {
  require_finite(F, "the deformation gradient");
  detail::require_recorded(F);
  require_size(stretches, F.size(), "stretches");
  require_apart(stretches, "stretches", F, "deformation gradients");
  detail::guarded(execute)(F.size(), [&](std::size_t i) {
    const Matrix<double, D> gradient = F[i].template cast<double>();
    stretches.set(i, principal_stretches(gradient));
  });
  detail::require_finite_result<D>(stretches, F, "vector of principal stretches");
}

}  // namespace hmps::inline HMPS_ABI
