// SPDX-License-Identifier: MIT
#include "hmps/laws/linear_elastic.hpp"

#include <gtest/gtest.h>

#include "law_checks.hpp"

namespace linear_elastic_test {

using namespace hmps;

template <class K>
struct LinearElasticOf : testing::Test {};
TYPED_TEST_SUITE(LinearElasticOf, law_checks::Kinds);

TYPED_TEST(LinearElasticOf, IsALawOfTheDeformationGradient) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const auto law = LinearElastic<T>::from_young_poisson(T(70e6), T(1.0 / 3.0));
  static_assert(DeformationGradientLaw<LinearElastic<T>, T, D> && !HyperelasticLaw<LinearElastic<T>, T, D>);
  law_checks::runs_on_lanes<T, D>(law, law_checks::deformations<D>());
  if constexpr (D == 2) law_checks::is_plane_strain<T>(law);
  if constexpr (std::is_same_v<T, double>) {
    law_checks::stress_is_derivative_of_energy<D>(law, law_checks::deformations<D>());
    law_checks::has_its_moduli<D>(law);
  }
}

TYPED_TEST(LinearElasticOf, IsLinearAndIgnoresInfinitesimalRotation) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const LinearElastic<T> law{T(3000), T(1000)};
  Matrix<T, D> F = Matrix<T, D>::Identity();
  F(0, 1) = T(0.25);
  F(1, 0) = T(-0.25);
  EXPECT_EQ(first_piola_kirchhoff(law, F).norm(), T(0));
  EXPECT_EQ(energy_density(law, F), T(0));
  F(0, 0) = T(1.5);
  const Matrix<T, D> P = first_piola_kirchhoff(law, F);
  EXPECT_EQ(P(0, 0), T(2500));
  EXPECT_EQ(P(1, 1), T(1500));
  F(0, 0) = T(2);
  EXPECT_EQ(first_piola_kirchhoff(law, F), P + P);
}

TEST(LinearElastic, ModuliThatAreNotPositiveAreRefused) {
  const auto law = LinearElastic<double>::from_young_poisson(1.4e6, 0.4);
  EXPECT_NEAR(law.lambda, 2e6, 1e-5);
  EXPECT_NO_THROW(law.validate());
  EXPECT_THROW((LinearElastic<double>{-700, 1000}.validate()), InputError);
  EXPECT_THROW((LinearElastic<double>{1000, -1}.validate()), InputError);
}

// As if soft tissue were given by from_moduli(G, K).
TEST(LinearElastic, RefusesModuliThatWereInterchanged) {
  EXPECT_NO_THROW(LinearElastic<double>::from_moduli(2e6, 15e3).validate());
  EXPECT_THROW(LinearElastic<double>::from_moduli(15e3, 2e6).validate(), InputError);
}

}  // namespace linear_elastic_test
