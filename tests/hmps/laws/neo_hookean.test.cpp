// SPDX-License-Identifier: MIT
#include "hmps/laws/neo_hookean.hpp"

#include <gtest/gtest.h>

#include "hmps/laws/mooney_rivlin.hpp"
#include "law_checks.hpp"

namespace neo_hookean_test {

using namespace hmps;

template <class K>
struct NeoHookeanOf : testing::Test {};
TYPED_TEST_SUITE(NeoHookeanOf, law_checks::Kinds);

TYPED_TEST(NeoHookeanOf, IsAHyperelasticLaw) {
  using T = typename TypeParam::Scalar;
  law_checks::hyperelastic<T, TypeParam::D>(NeoHookean<T>::from_young_poisson(T(17e6), T(0.45)));
}

TYPED_TEST(NeoHookeanOf, IsMooneyRivlinWithoutItsSecondTerm) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const NeoHookean<T> law{T(3000), T(40000)};
  const MooneyRivlin<T> same{T(1500), T(0), T(20000)};
  for (const Matrix<double, D>& state : law_checks::deformations<D>()) {
    const Matrix<T, D> F = state.template cast<T>();
    const Matrix<T, D> difference = first_piola_kirchhoff(law, F) - first_piola_kirchhoff(same, F);
    EXPECT_LT(static_cast<double>(difference.norm()), 1e2 * law_checks::epsilon<T> * 43000);
    EXPECT_NEAR(energy_density(law, F), energy_density(same, F), 1e2 * law_checks::epsilon<T> * 43000);
  }
}

TEST(NeoHookean, ModuliFollowFromYoungAndPoisson) {
  const auto law = NeoHookean<double>::from_young_poisson(17e6, 0.45);
  const double K = law.bulk_modulus(), G = law.shear_modulus();
  EXPECT_NEAR(9 * K * G / (3 * K + G), 17e6, 1e-2);
  EXPECT_NEAR((3 * K - 2 * G) / (2 * (3 * K + G)), 0.45, 1e-12);
}

TEST(NeoHookean, ModuliThatAreNotPositiveAreRefused) {
  EXPECT_NO_THROW((NeoHookean<double>{1, 1}.validate()));
  EXPECT_THROW((NeoHookean<double>{0, 1}.validate()), InputError);
  EXPECT_THROW((NeoHookean<double>{1, -1}.validate()), InputError);
  EXPECT_THROW((NeoHookean<double>::from_young_poisson(1e4, 0.5).validate()), InputError);
  EXPECT_THROW((NeoHookean<double>::from_young_poisson(-1e4, 0.3).validate()), InputError);
}

}  // namespace neo_hookean_test
