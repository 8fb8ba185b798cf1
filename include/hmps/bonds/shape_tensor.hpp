// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// The sums of \paper{12} over the reference neighbourhood of one particle, in double; bonds are added one by one.
template <int D>
struct ShapeTensor {
  Matrix<double, D> A = Matrix<double, D>::Zero();          ///< sum w r0 (x) r0, in m2.
  Vector<double, D> asymmetry = Vector<double, D>::Zero();  ///< sum w r0, in m; zero away from surfaces.
  double weight = 0;                                        ///< sum w: the particle number density n.
  int neighbours = 0;                                       ///< Number of bonds.

  void add(const Vector<double, D>& r0, double w) {
    A.noalias() += w * r0 * r0.transpose();
    asymmetry += w * r0;
    weight += w;
    ++neighbours;
  }

  /// A^-1. Throws `InputError`, naming `particle`, if its bonds do not span space: it would have no deformation
  /// gradient (\paper{11}).
  [[nodiscard]] Matrix<double, D> inverse(std::size_t particle, bool unbonded = false) const {
    if (unbonded && neighbours == 0) return A;
    const double mean = A.trace() / D;
    double volume = 1;
    for (int d = 0; d < D; ++d) volume *= mean;
    // The determinant relative to that of a sphere with the same trace: 1 for a full neighbourhood, 0.5 for a flat
    // surface, 0 if all bonds lie in a plane or on a line.
    detail::require(
        neighbours >= D && detail::is_finite(mean) && mean > 0 && A.determinant() > 1e-4 * volume, "hmps: particle ",
        particle, " has ", neighbours, neighbours == 1 ? " neighbour that does" : " neighbours that do",
        " not span the ", D,
        "D space, so that it has no deformation gradient; remove weakly supported particles, fill the gap, enlarge the "
        "radius, or let `bonded` hold for more of its pairs, if you gave one");
    return A.inverse();
  }

  /// Least eigenvalue of A in m2. Divided by the squared spacing: 3.48 in a full cubic lattice with r_e = 1.75
  /// spacings, 1.74 at a flat surface; below 0.75 the stable step shrinks.
  [[nodiscard]] double support() const {
    Eigen::SelfAdjointEigenSolver<Matrix<double, D>> solver;
    solver.computeDirect(A, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()[0];
  }
};

}  // namespace hmps::inline HMPS_ABI
