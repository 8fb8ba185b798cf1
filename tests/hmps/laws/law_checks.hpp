// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "hmps/lanes/lane_math.hpp"
#include "hmps/laws/law.hpp"

/// What every law must satisfy, whatever its formula.
namespace law_checks {

using hmps::Matrix;

/// A scalar type and a dimension of typed tests.
template <class T, int N>
struct Kind {
  using Scalar = T;
  static constexpr int D = N;
};
using Kinds = testing::Types<Kind<double, 2>, Kind<double, 3>, Kind<float, 2>, Kind<float, 3>>;

template <class T>
constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());

/// Deformation gradients with det F in (0.3, 3): compressed, stretched, sheared and turned.
template <int D>
std::vector<Matrix<double, D>> deformations() {
  std::mt19937 generator(20240607);
  std::uniform_real_distribution<double> within(-0.6, 0.6);
  std::vector<Matrix<double, D>> result;
  while (result.size() < 40) {
    Matrix<double, D> F = Matrix<double, D>::Identity();
    for (int k = 0; k < D * D; ++k) F(k % D, k / D) += within(generator);
    const double J = hmps::determinant(F);
    if (J > 0.3 && J < 3) result.push_back(F);
  }
  return result;
}

/// Proper rotations.
template <int D>
std::vector<Matrix<double, D>> rotations() {
  std::vector<Matrix<double, D>> result;
  for (Matrix<double, D> R : deformations<D>()) {
    for (int c = 0; c < D; ++c) {
      for (int earlier = 0; earlier < c; ++earlier) R.col(c) -= R.col(earlier).dot(R.col(c)) * R.col(earlier);
      R.col(c) /= R.col(c).norm();
    }
    result.push_back(R);  // keeps the sign of det F, so it is proper
  }
  return result;
}

template <class Law>
double stiffness(const Law& law) {
  return static_cast<double>(law.bulk_modulus()) + static_cast<double>(law.shear_modulus());
}

/// dW/dF against the central difference of W, in double precision. The difference of step h is exact to
/// h^2 / 6 of the third derivative (below 1e3 moduli here) and to eps W / h of rounding.
template <int D, class Law>
void stress_is_derivative_of_energy(const Law& law, const std::vector<Matrix<double, D>>& states) {
  const double h = 1e-5;
  double worst = 0;
  for (const Matrix<double, D>& F : states) {
    const Matrix<double, D> P = hmps::first_piola_kirchhoff(law, F);
    for (int k = 0; k < D * D; ++k) {
      Matrix<double, D> more = F, less = F;
      more(k % D, k / D) += h;
      less(k % D, k / D) -= h;
      const double slope = (hmps::energy_density(law, more) - hmps::energy_density(law, less)) / (2 * h);
      worst = std::max(worst, std::abs(P(k % D, k / D) - slope));
    }
  }
  EXPECT_LT(worst, 1e-7 * stiffness(law));
}

/// P(R F) = R P(F) and W(R F) = W(F).
template <class T, int D, class Law>
void is_objective(const Law& law) {
  const auto F = deformations<D>();
  const auto R = rotations<D>();
  for (std::size_t i = 0; i < F.size(); ++i) {
    const Matrix<T, D> turned = (R[i] * F[i]).template cast<T>();
    const Matrix<double, D> P = hmps::first_piola_kirchhoff(law, turned).template cast<double>();
    const Matrix<double, D> expected = R[i] * hmps::first_piola_kirchhoff(law, F[i]);
    // F is known to eps, the tangent is of the order of the moduli times powers of the stretch.
    EXPECT_LT((P - expected).norm(), 100 * epsilon<T> * stiffness(law) * F[i].squaredNorm());
    EXPECT_NEAR(static_cast<double>(hmps::energy_density(law, turned)), hmps::energy_density(law, F[i]),
                100 * epsilon<T> * stiffness(law) * F[i].squaredNorm());
  }
}

/// Problem 2: a rigid rotation neither stresses nor stores energy.
template <class T, int D, class Law>
void is_free_in_rotation(const Law& law) {
  for (const Matrix<double, D>& R : rotations<D>()) {
    const Matrix<T, D> F = R.template cast<T>();
    EXPECT_LT(static_cast<double>(hmps::first_piola_kirchhoff(law, F).norm()), 20 * epsilon<T> * stiffness(law));
    const auto W = static_cast<double>(hmps::energy_density(law, F));
    EXPECT_GE(W, 0.0);
    // Quadratic in the rounding of F, not linear.
    EXPECT_LT(W, 1e3 * epsilon<T> * epsilon<T> * stiffness(law));
  }
}

/// Two dimensions are three with F33 = 1.
template <class T, class Law>
void is_plane_strain(const Law& law) {
  for (const Matrix<double, 2>& F : deformations<2>()) {
    const Matrix<T, 2> plane = F.template cast<T>();
    Matrix<T, 3> space = Matrix<T, 3>::Identity();
    space.template topLeftCorner<2, 2>() = plane;
    const Matrix<T, 2> P = hmps::first_piola_kirchhoff(law, plane);
    const Matrix<T, 3> Q = hmps::first_piola_kirchhoff(law, space);
    const double tolerance = 50 * epsilon<T> * stiffness(law) * F.squaredNorm();
    EXPECT_LT(static_cast<double>((P - Q.template topLeftCorner<2, 2>()).norm()), tolerance);
    EXPECT_NEAR(static_cast<double>(hmps::energy_density(law, plane)),
                static_cast<double>(hmps::energy_density(law, space)), tolerance);
  }
}

/// At small strain the law is linear elasticity with its own bulk and shear modulus.
template <int D, class Law>
void has_its_moduli(const Law& law) {
  const double h = 1e-6, K = law.bulk_modulus(), G = law.shear_modulus();
  Matrix<double, D> F = Matrix<double, D>::Identity();
  F(0, 0) += h;
  const Matrix<double, D> stretched = hmps::first_piola_kirchhoff(law, F) / h;
  EXPECT_NEAR(stretched(0, 0), K + 4 * G / 3, 1e-4 * (K + G));
  EXPECT_NEAR(stretched(1, 1), K - 2 * G / 3, 1e-4 * (K + G));
  F.setIdentity();
  F(0, 1) += h;
  F(1, 0) += h;
  const Matrix<double, D> sheared = hmps::first_piola_kirchhoff(law, F) / h;
  EXPECT_NEAR(sheared(0, 1), 2 * G, 1e-4 * (K + G));
  EXPECT_NEAR(sheared(0, 0), 0, 1e-4 * (K + G));
}

/// A particle per lane gives the same results as each particle alone.
template <class T, int D, class Law>
void runs_on_lanes(const Law& law, const std::vector<Matrix<double, D>>& states) {
  using Pack = hmps::Lanes<T>;
  Matrix<Pack, D> F;
  for (int k = 0; k < D * D; ++k)
    for (int l = 0; l < Pack::width; ++l)
      F(k % D, k / D).lane[l] = static_cast<T>(states[static_cast<std::size_t>(l) % states.size()](k % D, k / D));
  const Matrix<Pack, D> P = hmps::first_piola_kirchhoff(law, F);
  const Pack W = hmps::energy_density(law, F);
  double worst = 0;
  for (int l = 0; l < Pack::width; ++l) {
    const Matrix<T, D> own = states[static_cast<std::size_t>(l) % states.size()].template cast<T>();
    const Matrix<T, D> expected = hmps::first_piola_kirchhoff(law, own);
    const double scale = stiffness(law) + static_cast<double>(expected.norm());
    for (int k = 0; k < D * D; ++k)
      worst = std::max(worst, std::abs(static_cast<double>(P(k % D, k / D).lane[l] - expected(k % D, k / D))) / scale);
    worst = std::max(worst, std::abs(static_cast<double>(W.lane[l] - hmps::energy_density(law, own))) / scale);
  }
  EXPECT_LT(worst, 50 * epsilon<T>);
}

/// All of the above that hold for a hyperelastic law.
template <class T, int D, class Law>
void hyperelastic(const Law& law) {
  is_objective<T, D>(law);
  is_free_in_rotation<T, D>(law);
  runs_on_lanes<T, D>(law, deformations<D>());
  if constexpr (D == 2) is_plane_strain<T>(law);
  if constexpr (std::is_same_v<T, double>) {
    stress_is_derivative_of_energy<D>(law, deformations<D>());
    has_its_moduli<D>(law);
  }
}

}  // namespace law_checks
