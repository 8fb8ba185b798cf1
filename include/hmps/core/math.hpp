// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

// Operations on small tensors for laws and sweeps. `T` may be an arithmetic type or a pack of lanes. The code uses only
// + - * / and functions found by argument-dependent lookup, and never branches on a value. Everything is inlined, so
// that packs stay in registers.

/// `x` to the power -1/3; NaN for `x <= 0`. Packs of lanes have an overload of their own.
template <class T>
requires std::is_floating_point_v<T>
[[nodiscard]] T inverse_cube_root(T x) { return x > T(0) ? T(1) / std::cbrt(x) : std::numeric_limits<T>::quiet_NaN(); }

/// `yes` where `mask` holds, `no` elsewhere: replaces a branch in code that also runs on packs of lanes.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] constexpr T select(bool mask, T yes, T no) { return mask ? yes : no; }

/// The trace of `M`.
template <class T, int D>
[[nodiscard]] HMPS_INLINE T trace(const Matrix<T, D>& M) {
  static_assert(D == 2 || D == 3, "hmps: tensors are 2 x 2 or 3 x 3");
  if constexpr (D == 2) {
    return M(0, 0) + M(1, 1);
  } else {
    return M(0, 0) + M(1, 1) + M(2, 2);
  }
}

/// The double contraction A : B, the sum of the products of equal components.
template <class T, int D>
[[nodiscard]] HMPS_INLINE T contract(const Matrix<T, D>& A, const Matrix<T, D>& B) {
  T sum = A(0, 0) * B(0, 0);
  for (int k = 1; k < D * D; ++k) sum = sum + A(k % D, k / D) * B(k % D, k / D);
  return sum;
}

/// The determinant of `M`.
template <class T, int D>
[[nodiscard]] HMPS_INLINE T determinant(const Matrix<T, D>& M) {
  static_assert(D == 2 || D == 3, "hmps: tensors are 2 x 2 or 3 x 3");
  if constexpr (D == 2) {
    return M(0, 0) * M(1, 1) - M(0, 1) * M(1, 0);
  } else {
    return M(0, 0) * (M(1, 1) * M(2, 2) - M(1, 2) * M(2, 1)) + M(0, 1) * (M(1, 2) * M(2, 0) - M(1, 0) * M(2, 2)) +
           M(0, 2) * (M(1, 0) * M(2, 1) - M(1, 1) * M(2, 0));
  }
}

/// The matrix with `skew(a) b = a x b`.
template <class T>
[[nodiscard]] Matrix<T, 3> skew(const Vector<T, 3>& a) {
  Matrix<T, 3> m;
  m << T(0), -a[2], a[1], a[2], T(0), -a[0], -a[1], a[0], T(0);
  return m;
}

/// The cofactor matrix of `M`, det(M) M^-T: the derivative of the determinant. Finite for every `M`.
template <class T, int D>
[[nodiscard]] HMPS_INLINE Matrix<T, D> cofactor(const Matrix<T, D>& M) {
  static_assert(D == 2 || D == 3, "hmps: tensors are 2 x 2 or 3 x 3");
  Matrix<T, D> K;
  if constexpr (D == 2) {
    K(0, 0) = M(1, 1);
    K(0, 1) = -M(1, 0);
    K(1, 0) = -M(0, 1);
    K(1, 1) = M(0, 0);
  } else {
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        K(r, c) = M(r1, c1) * M(r2, c2) - M(r1, c2) * M(r2, c1);
      }
    }
  }
  return K;
}

/// The cofactor matrix of a symmetric `M`, which is symmetric too: det(M) M^-1 from six cofactors instead of nine.
template <class T, int D>
[[nodiscard]] HMPS_INLINE Matrix<T, D> symmetric_cofactor(const Matrix<T, D>& M) {
  if constexpr (D == 2) {
    return cofactor(M);
  } else {
    Matrix<T, D> K;
    K(0, 0) = M(1, 1) * M(2, 2) - M(1, 2) * M(1, 2);
    K(1, 1) = M(0, 0) * M(2, 2) - M(0, 2) * M(0, 2);
    K(2, 2) = M(0, 0) * M(1, 1) - M(0, 1) * M(0, 1);
    K(0, 1) = K(1, 0) = M(0, 2) * M(1, 2) - M(0, 1) * M(2, 2);
    K(0, 2) = K(2, 0) = M(0, 1) * M(1, 2) - M(0, 2) * M(1, 1);
    K(1, 2) = K(2, 1) = M(0, 1) * M(0, 2) - M(0, 0) * M(1, 2);
    return K;
  }
}

/// The inverse of `M`. A singular `M` gives infinities or NaN: check `determinant` first.
template <class T, int D>
[[nodiscard]] HMPS_INLINE Matrix<T, D> inverse(const Matrix<T, D>& M) {
  const Matrix<T, D> K = cofactor(M);
  T det = M(0, 0) * K(0, 0);
  for (int c = 1; c < D; ++c) det = det + M(0, c) * K(0, c);
  const T scale = T(1) / det;
  Matrix<T, D> result;
  for (int c = 0; c < D; ++c)
    for (int r = 0; r < D; ++r) result(r, c) = K(c, r) * scale;
  return result;
}

/// The matrix product A B, without Eigen's expression templates.
template <class T, int D>
[[nodiscard]] HMPS_INLINE Matrix<T, D> product(const Matrix<T, D>& A, const Matrix<T, D>& B) {
  Matrix<T, D> result;
  for (int c = 0; c < D; ++c) {
    for (int r = 0; r < D; ++r) {
      T sum = A(r, 0) * B(0, c);
      for (int k = 1; k < D; ++k) sum = sum + A(r, k) * B(k, c);
      result(r, c) = sum;
    }
  }
  return result;
}

/// The right Cauchy-Green tensor C = F^T F; symmetric to the last bit.
template <class T, int D>
[[nodiscard]] HMPS_INLINE Matrix<T, D> right_cauchy_green(const Matrix<T, D>& F) {
  Matrix<T, D> C;
  for (int c = 0; c < D; ++c) {
    for (int r = 0; r <= c; ++r) {
      T sum = F(0, r) * F(0, c);
      for (int k = 1; k < D; ++k) sum = sum + F(k, r) * F(k, c);
      C(r, c) = sum;
      if (r != c) C(c, r) = sum;
    }
  }
  return C;
}

/// An upper bound of the largest singular value of the deformation gradient `F`, the largest stretch of a line in the
/// particle: the square root of the mean plus sqrt(D - 1) standard deviations of the eigenvalues of F^T F (Wolkowicz
/// and Styan 1980). Exact in 2D and for equal stretches; in 3D up to 16 % above. It needs no eigenvalues, unlike
/// `principal_stretches`.
template <class T, int D>
[[nodiscard]] HMPS_INLINE T stretch_bound(const Matrix<T, D>& F) {
  using std::sqrt;
  Matrix<T, D> C = right_cauchy_green<T, D>(F);
  const T mean = trace<T, D>(C) * T(1. / D);
  for (int c = 0; c < D; ++c) C(c, c) = C(c, c) - mean;
  return sqrt(mean + sqrt(contract<T, D>(C, C) * T((D - 1.) / D)));
}

/// An axial vector in `D` dimensions: a vector in 3D, its out-of-plane component in 2D.
template <int D>
using Axial = Vector<double, D == 3 ? 3 : 1>;

/// a x b: a vector in 3D, its out-of-plane component in 2D.
template <int D>
[[nodiscard]] Axial<D> cross(const Vector<double, D>& a, const Vector<double, D>& b) {
  if constexpr (D == 3) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  } else {
    return Axial<D>::Constant(a[0] * b[1] - a[1] * b[0]);
  }
}

}  // namespace hmps::inline HMPS_ABI
