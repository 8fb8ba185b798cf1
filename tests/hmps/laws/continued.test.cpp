// SPDX-License-Identifier: MIT
#include "hmps/laws/continued.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/laws/saint_venant_kirchhoff.hpp"
#include "law_checks.hpp"

namespace continued_test {

using namespace hmps;

static_assert(ContinuableLaw<MooneyRivlin<>> && ContinuableLaw<NeoHookean<float>>);
static_assert(!ContinuableLaw<SaintVenantKirchhoff<>>);

template <class T>
Continued<MooneyRivlin<T>, T> continued(double j_min) {
  return {MooneyRivlin<T>{T(2000), T(500), T(30000)}, T(j_min)};
}

/// The deformations of all laws, with one direction squeezed through zero to `s`.
template <int D>
std::vector<Matrix<double, D>> squeezed(double s) {
  auto states = law_checks::deformations<D>();
  for (auto& F : states) F.col(0) *= s;
  return states;
}

template <class K>
struct ContinuedOf : testing::Test {};
TYPED_TEST_SUITE(ContinuedOf, law_checks::Kinds);

TYPED_TEST(ContinuedOf, IsTheLawItselfAboveTheBound) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const auto law = continued<T>(0.29);
  static_assert(DeformationGradientLaw<Continued<MooneyRivlin<T>, T>, T, D>);
  for (const auto& state : law_checks::deformations<D>()) {
    const Matrix<T, D> F = state.template cast<T>();
    EXPECT_EQ(first_piola_kirchhoff(law, F), first_piola_kirchhoff(law.law, F));
    EXPECT_EQ(energy_density(law, F), energy_density(law.law, F));
  }
}

TYPED_TEST(ContinuedOf, StressIsTheDerivativeOfTheEnergyBelowItToo) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  for (const double s : {0.3, 0.01, 0.0, -0.3, -1.0}) {
    const auto states = squeezed<D>(s);
    if constexpr (std::is_same_v<T, double>) law_checks::stress_is_derivative_of_energy<D>(continued<T>(0.4), states);
    law_checks::runs_on_lanes<T, D>(continued<T>(0.4), states);
  }
  if constexpr (D == 2) law_checks::is_plane_strain<T>(continued<T>(0.9));
}

TYPED_TEST(ContinuedOf, StressAndEnergyAreContinuousAtTheBound) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  for (const auto& state : law_checks::deformations<D>()) {
    const Matrix<T, D> F = state.template cast<T>();
    const T J = determinant(F);
    const T step = 64 * std::numeric_limits<T>::epsilon();
    const auto own = continued<T>(0.1), just_below = continued<T>(static_cast<double>(J * (1 + step)));
    const double scale = law_checks::stiffness(own) + static_cast<double>(first_piola_kirchhoff(own, F).norm());
    const Matrix<T, D> jump = first_piola_kirchhoff(just_below, F) - first_piola_kirchhoff(own, F);
    EXPECT_LT(static_cast<double>(jump.norm()), 2e3 * law_checks::epsilon<T> * scale);
    EXPECT_NEAR(energy_density(just_below, F), energy_density(own, F), 2e3 * law_checks::epsilon<T> * scale);
  }
}

TYPED_TEST(ContinuedOf, PushesBackFromEveryDepth) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const auto law = continued<T>(0.2);
  Matrix<T, D> F = Matrix<T, D>::Identity();
  T above = std::numeric_limits<T>::infinity();
  // From far inside out to the bound: the energy falls all the way, its slope is negative.
  for (int k = -300; k <= 19; ++k) {
    F(0, 0) = T(0.01) * static_cast<T>(k);
    const T W = energy_density(law, F);
    EXPECT_LT(W, above) << "at a stretch of " << F(0, 0);
    EXPECT_LT(first_piola_kirchhoff(law, F)(0, 0), T(0)) << "at a stretch of " << F(0, 0);
    above = W;
  }
  F.setZero();
  EXPECT_TRUE(std::isfinite(energy_density(law, F)));
  EXPECT_TRUE(first_piola_kirchhoff(law, F).allFinite());
}

TEST(Continued, BoundsOutsideZeroToOneAreRefused) {
  EXPECT_NO_THROW(continued<double>(0.2).validate());
  for (const double bad : {0.0, -0.1, 1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(continued<double>(bad).validate(), InputError);
  EXPECT_THROW((Continued{MooneyRivlin<double>{-1, 0, 1}}.validate()), InputError);
  EXPECT_EQ((Continued{NeoHookean<double>{1000, 3000}}.bulk_modulus()), 3000);
}

}  // namespace continued_test
