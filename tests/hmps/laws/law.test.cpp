// SPDX-License-Identifier: MIT
#include "hmps/laws/law.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "../../reference/message_of.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/laws/saint_venant_kirchhoff.hpp"
#include "law_checks.hpp"

namespace law_test {

using namespace hmps;

/// A user's law: W = mu / 2 (I1 - 3) - mu ln J + lambda / 2 ln^2 J.
struct UsersLaw {
  double mu, lambda;
  template <class T, int D>
  Matrix<T, D> second_piola_kirchhoff(const Matrix<T, D>& C, const T& J) const {
    using std::log;
    const Matrix<T, D> cofactors = symmetric_cofactor(C);
    const T scale = (T(lambda) * log(J) - T(mu)) / (J * J);
    Matrix<T, D> S;
    for (int k = 0; k < D * D; ++k) S(k % D, k / D) = scale * cofactors(k % D, k / D);
    for (int d = 0; d < D; ++d) S(d, d) = S(d, d) + T(mu);
    return S;
  }
  template <class T, int D>
  T energy(const Matrix<T, D>& C, const T& J) const {
    using std::log;
    const T l = log(J);
    return T(mu / 2) * (trace(C) - T(D)) - T(mu) * l + T(lambda / 2) * (l * l);
  }
  double bulk_modulus() const { return lambda + 2 * mu / 3; }
  double shear_modulus() const { return mu; }
};
/// The same in formulas of whole tensors with plain parameters.
struct TensorLaw : UsersLaw {
  template <class T, int D>
  Matrix<T, D> second_piola_kirchhoff(const Matrix<T, D>& C, const T& J) const {
    using std::log;
    const Matrix<T, D> back = inverse(C), unit = Matrix<T, D>::Identity();
    return mu * (unit - back) + lambda * log(J) * back * 2 / 2.0;
  }
};
/// A law that serves double in three dimensions only, and forces only.
struct PlainLaw {
  Matrix<double, 3> first_piola_kirchhoff(const Matrix<double, 3>& F) const { return F; }
};
struct NoLaw {
  double second_piola_kirchhoff() const { return 0; }
};

static_assert(HyperelasticLaw<UsersLaw, double, 3> && HyperelasticLaw<UsersLaw, float, 2>);
static_assert(HyperelasticLaw<UsersLaw, Lanes<float>, 3>);
static_assert(LawWithEnergy<UsersLaw>);
static_assert(DeformationGradientLaw<PlainLaw> && ConstitutiveLaw<PlainLaw>);
static_assert(!ConstitutiveLaw<PlainLaw, double, 2> && !LawWithEnergy<PlainLaw>);
static_assert(!ConstitutiveLaw<NoLaw>);

template <class K>
struct LawOf : testing::Test {};
TYPED_TEST_SUITE(LawOf, law_checks::Kinds);

TYPED_TEST(LawOf, TreatsUserLawsLikeThoseOfTheLibrary) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const UsersLaw law{1000, 3000};
  law_checks::is_objective<T, D>(law);
  law_checks::runs_on_lanes<T, D>(law, law_checks::deformations<D>());
  if constexpr (D == 2) law_checks::is_plane_strain<T>(law);
  if constexpr (std::is_same_v<T, double>) {
    law_checks::stress_is_derivative_of_energy<D>(law, law_checks::deformations<D>());
    law_checks::has_its_moduli<D>(law);
  }
}

// Earlier, numbers beside tensors of lanes did not compile: they had to be written as T(mu).
TYPED_TEST(LawOf, TakesPlainNumbersBesideTensors) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const TensorLaw law{{1000, 3000}};
  law_checks::runs_on_lanes<T, D>(law, law_checks::deformations<D>());
  for (const Matrix<double, D>& F : law_checks::deformations<D>()) {
    const Matrix<double, D> P = first_piola_kirchhoff(law, F), same = first_piola_kirchhoff(UsersLaw{1000, 3000}, F);
    EXPECT_LE((P - same).norm(), 1e-12 * (1000 + same.norm()) * F.inverse().squaredNorm());
  }
}

TEST(Law, FirstPiolaKirchhoffStressIsFTimesS) {
  struct Given {
    Matrix<double, 2> second_piola_kirchhoff(const Matrix<double, 2>& C, double J) const {
      Matrix<double, 2> expected;
      expected << 5, 11, 11, 25;
      EXPECT_EQ(C, expected);
      EXPECT_EQ(J, 2 * 3 - 4 * 1);
      Matrix<double, 2> S;
      S << 1, 2, 2, 3;
      return S;
    }
  };
  Matrix<double, 2> F, P;
  F << 2, 4, 1, 3;
  P << 2 * 1 + 4 * 2, 2 * 2 + 4 * 3, 1 * 1 + 3 * 2, 1 * 2 + 3 * 3;
  EXPECT_EQ(first_piola_kirchhoff(Given{}, F), P);
}

TEST(Law, SoundSpeedOfUniaxialStrain) {
  EXPECT_DOUBLE_EQ(sound_speed(UsersLaw{3000, 3000}, 1000.0), 3.0);
  EXPECT_THROW((void)sound_speed(UsersLaw{3000, 3000}, 0.0), InputError);
  EXPECT_THROW((void)sound_speed(UsersLaw{3000, 3000}, -1.0f), InputError);
}

// Some foams have a negative Poisson's ratio; of soft tissue, it means that the moduli were interchanged.
TEST(Law, AcceptsPoissonsRatiosFromMinusOneHalfOn) {
  const auto accepts = [](const auto& law) { return hmps_test::message_of([&] { law.validate(); }).empty(); };
  const auto all_accept = [&](double nu) {
    const bool first = accepts(NeoHookean<>::from_young_poisson(1e4, nu));
    EXPECT_EQ(accepts(SaintVenantKirchhoff<>::from_young_poisson(1e4, nu)), first) << nu;
    EXPECT_EQ(accepts(LinearElastic<>::from_young_poisson(1e4, nu)), first) << nu;
    return first;
  };
  for (const double nu : {-0.49, -0.3, 0.0, 0.49}) EXPECT_TRUE(all_accept(nu)) << nu;
  for (const double nu : {-0.51, -0.9}) EXPECT_FALSE(all_accept(nu)) << nu;
  EXPECT_FALSE(accepts(MooneyRivlin<>::from_young_poisson(1e4, -0.01)));
}

TEST(SoundSpeed, RejectsInvalidModuli) {
  EXPECT_THROW((void)sound_speed(UsersLaw{-3000, 100}, 1000.0), InputError);
  EXPECT_THROW((void)sound_speed(UsersLaw{std::numeric_limits<double>::quiet_NaN(), 100}, 1000.0), InputError);
}

}  // namespace law_test
