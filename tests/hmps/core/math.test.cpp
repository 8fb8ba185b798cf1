// SPDX-License-Identifier: MIT
#include "hmps/core/math.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include <cmath>
#include <limits>
#include <random>

namespace math_test {

using namespace hmps;

template <class T, int N>
struct Kind {
  using Scalar = T;
  static constexpr int D = N;
};
using Kinds = testing::Types<Kind<double, 2>, Kind<double, 3>, Kind<float, 2>, Kind<float, 3>>;

template <class K>
struct MathOf : testing::Test {
  using S = typename K::Scalar;
  static constexpr double epsilon = static_cast<double>(std::numeric_limits<S>::epsilon());
  std::mt19937 generator{7};
  Matrix<S, K::D> random() {
    std::uniform_real_distribution<S> within(-1, 1);
    Matrix<S, K::D> M;
    for (int k = 0; k < K::D * K::D; ++k) M(k % K::D, k / K::D) = within(generator);
    return M;
  }
};
TYPED_TEST_SUITE(MathOf, Kinds);

TYPED_TEST(MathOf, CofactorsMakeTheDeterminantAndTheInverse) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const Matrix<T, D> I = Matrix<T, D>::Identity();
  for (int i = 0; i < 50; ++i) {
    const Matrix<T, D> M = this->random();
    const T det = determinant(M);
    // M cof(M)^T = det(M) I, with sums of D products of D - 1 products of numbers below 1.
    EXPECT_LT((product(M, Matrix<T, D>(cofactor(M).transpose())) - det * I).norm(), 20 * this->epsilon);
    EXPECT_LT((product(M, inverse(M)) - I).norm(), 100 * this->epsilon * inverse(M).norm());
    EXPECT_NEAR(determinant(product(M, M)), det * det, 20 * this->epsilon);
  }
}

TYPED_TEST(MathOf, KnownDeterminants) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  Matrix<T, D> M = Matrix<T, D>::Identity();
  M(0, 0) = T(3);
  EXPECT_EQ(determinant(M), T(3));
  M.row(0).swap(M.row(1));
  EXPECT_EQ(determinant(M), T(-3));
  M.col(0) = M.col(1);
  EXPECT_EQ(determinant(M), T(0));
}

TYPED_TEST(MathOf, RightCauchyGreenIsSymmetricAndIgnoresRotation) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  for (int i = 0; i < 50; ++i) {
    const Matrix<T, D> F = this->random(), C = right_cauchy_green(F);
    EXPECT_EQ(C, C.transpose());
    EXPECT_LT((C - product(Matrix<T, D>(F.transpose()), F)).norm(), 10 * this->epsilon);
    EXPECT_NEAR(trace(C), contract(F, F), 10 * this->epsilon);
    EXPECT_LT((symmetric_cofactor(C) - cofactor(C)).norm(), 10 * this->epsilon);
    EXPECT_NEAR(determinant(C), determinant(F) * determinant(F), 20 * this->epsilon);
    Matrix<T, D> turned = F;  // by a right angle
    turned.row(0) = -F.row(1);
    turned.row(1) = F.row(0);
    EXPECT_LT((right_cauchy_green(turned) - C).norm(), 10 * this->epsilon);
  }
}

TYPED_TEST(MathOf, StretchBoundIsAboveTheLargestStretchAndSharpWhereItCounts) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  for (int i = 0; i < 50; ++i) {
    const Matrix<T, D> F = this->random();
    const T largest = F.jacobiSvd().singularValues()[0], bound = stretch_bound<T, D>(F);
    EXPECT_GE(bound, largest - 10 * this->epsilon);
    EXPECT_LE(bound, std::sqrt(T(4) / T(3)) * largest + 10 * this->epsilon);  // two equal stretches and none
    if (D == 2) {
      EXPECT_NEAR(bound, largest, 10 * this->epsilon);
    }
  }
  EXPECT_EQ((stretch_bound<T, D>(T(2) * Matrix<T, D>::Identity())), T(2));
  Matrix<T, D> one = Matrix<T, D>::Zero();
  one(0, 1) = T(3);
  EXPECT_NEAR((stretch_bound<T, D>(one)), T(3), 10 * this->epsilon);  // D = 3 too: mean 3, deviation sqrt(18)
}

TYPED_TEST(MathOf, ScalarHelpers) {
  using T = typename TypeParam::Scalar;
  EXPECT_EQ(select(true, T(1), T(2)), T(1));
  EXPECT_EQ(select(false, T(1), T(2)), T(2));
  for (const T x : {T(1e-3), T(0.5), T(1), T(8), T(1000)}) {
    const T r = inverse_cube_root(x);
    EXPECT_NEAR(r * r * r * x, T(1), 5 * this->epsilon);
  }
  // As in packs of lanes: a law has no value at J <= 0.
  for (const T x : {T(0), T(-1), T(-8), std::numeric_limits<T>::quiet_NaN()})
    EXPECT_TRUE(std::isnan(inverse_cube_root(x))) << x;
}

TEST(Math, CrossProductsInSpaceAndInThePlane) {
  EXPECT_EQ(cross<3>({1, 0, 0}, {0, 1, 0}), (Vector<double, 3>(0, 0, 1)));
  EXPECT_EQ(cross<3>({1, 2, 3}, {4, 5, 6}), (Vector<double, 3>(-3, 6, -3)));
  EXPECT_EQ(cross<2>({1, 0}, {0, 2})[0], 2.0);
  EXPECT_EQ(cross<2>({0, 2}, {1, 0})[0], -2.0);
}

}  // namespace math_test
