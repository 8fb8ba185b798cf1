// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// The first invariant I1 of the right Cauchy-Green tensor `C`. In two dimensions (plane strain) it includes C33 = 1,
/// which `trace(C)` omits.
template <class T, int D>
[[nodiscard]] HMPS_INLINE T first_invariant(const Matrix<T, D>& C) {
  if constexpr (D == 2) {
    return trace(C) + T(1);
  } else {
    return trace(C);
  }
}

/// The second invariant I2 of `C` from its cofactor matrix `K`, which is `symmetric_cofactor(C)`. In two dimensions
/// (plane strain), the cofactor of C33 = 1 is the determinant of the in-plane part, and the other two are C22 and C11.
template <class T, int D>
[[nodiscard]] HMPS_INLINE T second_invariant(const Matrix<T, D>& C, const Matrix<T, D>& K) {
  if constexpr (D == 2) {
    return determinant(C) + trace(C);
  } else {
    return trace(K);
  }
}

namespace detail {

/// The symmetric tensor `unit` I - `linear` C + `cofactors` K, the form of S in every law of the invariants.
template <class T, int D>
[[nodiscard]] HMPS_INLINE Matrix<T, D> combine(const Matrix<T, D>& C, const Matrix<T, D>& K, const T& unit,
                                               const T& linear, const T& cofactors) {
  Matrix<T, D> S;
  for (int c = 0; c < D; ++c) {
    S(c, c) = unit + (cofactors * K(c, c) - linear * C(c, c));
    for (int r = 0; r < c; ++r) S(r, c) = S(c, r) = cofactors * K(r, c) - linear * C(r, c);
  }
  return S;
}

/// tr(M) / det(M)^(1/3) - 3 for a symmetric positive M given with `root` = det(M)^(-1/3), without cancellation near the
/// unit tensor: with the deviator d of M,
/// tr^3 - 27 det = 9 tr (d : d) / 2 - 27 det d, and y^3 - 27 = (y - 3) (y^2 + 3 y + 9).
template <class T>
[[nodiscard]] T isochoric_excess(const Matrix<T, 3>& M, const T& root) {
  const T tr = trace(M), mean = tr * T(1.0 / 3.0);
  Matrix<T, 3> d = M;
  // Differences of the diagonal, so that a common part cancels before rounding.
  d(0, 0) = ((M(0, 0) - M(1, 1)) + (M(0, 0) - M(2, 2))) * T(1.0 / 3.0);
  d(1, 1) = ((M(1, 1) - M(0, 0)) + (M(1, 1) - M(2, 2))) * T(1.0 / 3.0);
  d(2, 2) = ((M(2, 2) - M(0, 0)) + (M(2, 2) - M(1, 1))) * T(1.0 / 3.0);
  const T y = tr * root;
  const T cubic = T(27) * (mean * contract(d, d) * T(0.5) - determinant(d));
  return cubic * (root * root * root) / (y * y + T(3) * y + T(9));
}

/// `M` as a three-dimensional tensor with the out-of-plane component `out_of_plane`.
template <class T, int D>
[[nodiscard]] Matrix<T, 3> in_space(const Matrix<T, D>& M, const T& out_of_plane) {
  if constexpr (D == 3) {
    return M;
  } else {
    Matrix<T, 3> full;
    full(0, 0) = M(0, 0);
    full(0, 1) = full(1, 0) = M(0, 1);
    full(1, 1) = M(1, 1);
    full(0, 2) = full(2, 0) = full(1, 2) = full(2, 1) = T(0);
    full(2, 2) = out_of_plane;
    return full;
  }
}

/// J^(-2/3) I1 - 3, never negative.
template <class T, int D>
[[nodiscard]] T first_isochoric_excess(const Matrix<T, D>& C, const T& J) {
  const T root = inverse_cube_root(J);
  return isochoric_excess<T>(in_space(C, T(1)), root * root);
}

/// J^(-4/3) I2 - 3, never negative: the excess of the cofactor matrix, whose trace is I2 and whose
/// determinant is J^4.
template <class T, int D>
[[nodiscard]] T second_isochoric_excess(const Matrix<T, D>& C, const T& J) {
  const T root = inverse_cube_root(J);
  const T a = root * root;
  return isochoric_excess<T>(symmetric_cofactor(in_space(C, T(1))), a * a);
}

/// The factors of a law of the form W = g1(J) I1 + g2(J) I2 + h(J) and their first derivatives at one J, and the second
/// derivative of h.
template <class T>
struct InvariantFactors {
  T first;                 ///< g1
  T second;                ///< g2
  T volumetric;            ///< h
  T first_slope;           ///< dg1/dJ
  T second_slope;          ///< dg2/dJ
  T volumetric_slope;      ///< dh/dJ
  T volumetric_curvature;  ///< d2h/dJ2
};

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
