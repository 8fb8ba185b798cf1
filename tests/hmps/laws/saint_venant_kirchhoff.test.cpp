// SPDX-License-Identifier: MIT
#include "hmps/laws/saint_venant_kirchhoff.hpp"

#include <gtest/gtest.h>

#include "law_checks.hpp"

namespace saint_venant_kirchhoff_test {

using namespace hmps;

template <class K>
struct SaintVenantKirchhoffOf : testing::Test {};
TYPED_TEST_SUITE(SaintVenantKirchhoffOf, law_checks::Kinds);

TYPED_TEST(SaintVenantKirchhoffOf, IsAHyperelasticLaw) {
  using T = typename TypeParam::Scalar;
  law_checks::hyperelastic<T, TypeParam::D>(SaintVenantKirchhoff<T>::from_young_poisson(T(1.4e6), T(0.4)));
}

TYPED_TEST(SaintVenantKirchhoffOf, UniaxialStrainHasItsCubic) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const SaintVenantKirchhoff<T> law{T(3000), T(1000)};
  for (const double stretch : {0.3, 0.58, 0.9, 1.5, -0.5}) {
    Matrix<T, D> F = Matrix<T, D>::Identity();
    F(0, 0) = static_cast<T>(stretch);
    // P11 = (lambda + 2 mu) (s^3 - s) / 2 and P22 = lambda (s^2 - 1) / 2.
    const Matrix<T, D> P = first_piola_kirchhoff(law, F);
    EXPECT_NEAR(P(0, 0), 5000 * (stretch * stretch * stretch - stretch) / 2, 1e4 * law_checks::epsilon<T>);
    EXPECT_NEAR(P(1, 1), 3000 * (stretch * stretch - 1) / 2, 1e4 * law_checks::epsilon<T>);
  }
}

TEST(SaintVenantKirchhoff, ModuliThatAreNotPositiveAreRefused) {
  const auto law = SaintVenantKirchhoff<double>::from_young_poisson(1.4e6, 0.4);
  EXPECT_NEAR(law.shear_modulus(), 0.5e6, 1e-6);
  EXPECT_NEAR(law.lambda, 2e6, 1e-5);
  EXPECT_NO_THROW(law.validate());
  EXPECT_NO_THROW((SaintVenantKirchhoff<double>{-100, 1000}.validate()));
  EXPECT_THROW((SaintVenantKirchhoff<double>{-700, 1000}.validate()), InputError);
  EXPECT_THROW((SaintVenantKirchhoff<double>{1000, 0}.validate()), InputError);
  EXPECT_THROW((SaintVenantKirchhoff<double>::from_young_poisson(1e4, 0.5).validate()), InputError);
}

}  // namespace saint_venant_kirchhoff_test
