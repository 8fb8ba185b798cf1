// SPDX-License-Identifier: MIT
#include "hmps/laws/invariants.hpp"

#include <gtest/gtest.h>

#include "law_checks.hpp"

namespace invariants_test {

using namespace hmps;

template <class K>
struct InvariantsOf : testing::Test {};
TYPED_TEST_SUITE(InvariantsOf, law_checks::Kinds);

TYPED_TEST(InvariantsOf, AreTheSumsOfTheSquaredStretches) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const double a = 4, b = 0.25, c = D == 3 ? 2.25 : 1;  // squared principal stretches
  Matrix<T, D> C = Matrix<T, D>::Zero();
  C(0, 0) = T(a);
  C(1, 1) = T(b);
  if constexpr (D == 3) C(2, 2) = T(c);
  const double I1 = a + b + c, I2 = a * b + b * c + c * a, J = std::sqrt(a * b * c);
  EXPECT_EQ(hmps::first_invariant(C), T(I1));
  EXPECT_EQ(hmps::second_invariant(C, symmetric_cofactor(C)), T(I2));
  const double tolerance = 30 * law_checks::epsilon<T>;
  EXPECT_NEAR(detail::first_isochoric_excess(C, T(J)), I1 * std::pow(J, -2.0 / 3) - 3, tolerance * I1);
  EXPECT_NEAR(detail::second_isochoric_excess(C, T(J)), I2 * std::pow(J, -4.0 / 3) - 3, tolerance * I2);
}

TYPED_TEST(InvariantsOf, ExcessKeepsItsDigitsAtSmallStrain) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  // Squared stretches 1 + e, 1, 1: the excess is e^2 / 3 - 8 e^3 / 27 + ..., which a difference with 3 would lose.
  const T e = T(1) / T(2048);
  Matrix<T, D> C = Matrix<T, D>::Identity();
  C(0, 0) = T(1) + e;
  const double s = static_cast<double>(e), exact = s * s / 3 - 8 * s * s * s / 27;
  const T J = static_cast<T>(std::sqrt(1 + s));
  EXPECT_NEAR(detail::first_isochoric_excess(C, J), exact, (s * s + 30 * law_checks::epsilon<T>)*exact);
}

TYPED_TEST(InvariantsOf, CombineIsSymmetric) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  for (const auto& F : law_checks::deformations<D>()) {
    const Matrix<T, D> own = F.template cast<T>(), C = right_cauchy_green(own), K = symmetric_cofactor(C);
    const Matrix<T, D> S = detail::combine(C, K, T(2), T(3), T(5));
    EXPECT_EQ(S, S.transpose());
    const Matrix<T, D> expected = T(2) * Matrix<T, D>::Identity() - T(3) * C + T(5) * K;
    EXPECT_LT((S - expected).norm(), 10 * law_checks::epsilon<T> * expected.norm() + 50 * law_checks::epsilon<T>);
  }
}

}  // namespace invariants_test
