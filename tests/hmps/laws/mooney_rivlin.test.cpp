// SPDX-License-Identifier: MIT
#include "hmps/laws/mooney_rivlin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "hmps/laws/law_checks.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/laws/saint_venant_kirchhoff.hpp"

namespace mooney_rivlin_test {

using namespace hmps;
using law_checks::epsilon;

template <class P>
MooneyRivlin<P> paper_tissue() {
  return MooneyRivlin<P>::from_young(P(20e3), P(1e6));
}

/// Cauchy stress P F^T / J.
template <class T, int D>
Matrix<double, D> cauchy(const MooneyRivlin<T>& law, const Matrix<double, D>& F) {
  const Matrix<T, D> own = F.template cast<T>();
  const Matrix<double, D> P = first_piola_kirchhoff(law, own).template cast<double>();
  return P * F.transpose() / determinant(F);
}

/// The diagonal F with F11 = `stretch`, F22 = `stretch` if `both`, and the other components such that the free faces
/// bear no stress: Newton's iteration on the lateral stretch, in double.
Matrix<double, 3> free_faces(double stretch, bool both) {
  const auto law = paper_tissue<double>();
  const auto state = [&](double lateral) {
    Matrix<double, 3> F = Matrix<double, 3>::Zero();
    F.diagonal() = Eigen::Vector3d(stretch, both ? stretch : lateral, lateral);
    return F;
  };
  double lateral = both ? 1 / (stretch * stretch) : 1 / std::sqrt(stretch);
  for (int i = 0; i < 50; ++i) {
    const double h = 1e-6;
    const double slope = (cauchy(law, state(lateral + h))(2, 2) - cauchy(law, state(lateral - h))(2, 2)) / (2 * h);
    lateral -= cauchy(law, state(lateral))(2, 2) / slope;
  }
  EXPECT_NEAR(cauchy(law, state(lateral))(2, 2), 0.0, 1e-7);
  return state(lateral);
}

template <class K>
struct MooneyRivlinOf : testing::Test {};
TYPED_TEST_SUITE(MooneyRivlinOf, law_checks::Kinds);

TYPED_TEST(MooneyRivlinOf, IsAHyperelasticLaw) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  static_assert(HyperelasticLaw<MooneyRivlin<>, T, D> && LawWithEnergy<MooneyRivlin<>, T, D>);
  law_checks::hyperelastic<T, D>(MooneyRivlin<T>{T(2000), T(500), T(30000)});
  law_checks::hyperelastic<T, D>(paper_tissue<T>());
}

TYPED_TEST(MooneyRivlinOf, SimpleShearHasItsExactStresses) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const auto law = paper_tissue<T>();
  for (const double gamma : {0.1, 0.5, 1.0, 2.0}) {
    Matrix<double, D> F = Matrix<double, D>::Identity();
    F(0, 1) = gamma;
    const Matrix<double, D> sigma = cauchy(law, F);
    const double rounding = 20 * epsilon<T> * 2e6 * F.squaredNorm();
    EXPECT_NEAR(sigma(0, 1), 2 * (2 * 5000.0 / 3) * gamma, rounding);
    // sigma11 = (2/3) (2 C1 + C2) gamma^2 and sigma22 = -(2/3) (C1 + 2 C2) gamma^2 at J = 1.
    EXPECT_NEAR(sigma(0, 0), 2.0 * 5000 / 3 * gamma * gamma, rounding);
    EXPECT_NEAR(sigma(1, 1), -2.0 * 5000 / 3 * gamma * gamma, rounding);
  }
}

TYPED_TEST(MooneyRivlinOf, EnergyKeepsItsDigitsNearTheUnitTensor) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  // A volume-preserving shear of 1/1024, exact in T, has W = (C1 + C2) gamma^2 with I1 - 3 = I2 - 3.
  const T gamma = T(1) / T(1024);
  Matrix<T, D> F = Matrix<T, D>::Identity();
  F(0, 1) = gamma;
  const auto law = paper_tissue<T>();
  const double exact = static_cast<double>(law.c1 + law.c2) * static_cast<double>(gamma * gamma);
  EXPECT_NEAR(static_cast<double>(energy_density(law, F)), exact, 20 * epsilon<T> * exact);
}

template <class T>
struct MooneyRivlinIn : testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(MooneyRivlinIn, Scalars);

TYPED_TEST(MooneyRivlinIn, UniaxialStressIsTheExactOne) {
  struct Known {
    double stretch, stress, half_digit;
  };
  for (const Known known : {Known{0.5, -17515.426, 5e-4}, Known{0.7, -7597.4589, 5e-5}, Known{1.3, 5418.6321, 5e-5},
                            Known{1.5, 8771.2136, 5e-5}, Known{2.0, 17414.0623, 5e-5}}) {
    const Matrix<double, 3> F = free_faces(known.stretch, false);
    EXPECT_NEAR(cauchy(paper_tissue<TypeParam>(), F)(0, 0), known.stress,
                known.half_digit + 20 * epsilon<TypeParam> * 2e6)
        << "stretch " << known.stretch;
    if (known.stretch == 0.5) {
      EXPECT_NEAR(determinant(F), 0.99708076, 5e-9);
    }
  }
}

TYPED_TEST(MooneyRivlinIn, EquibiaxialStressIsTheExactOne) {
  struct Known {
    double stretch, stress;
  };
  for (const Known known : {Known{0.8, -9822.3128}, Known{1.1, 3859.0892}, Known{1.5, 21863.3411}})
    EXPECT_NEAR(cauchy(paper_tissue<TypeParam>(), free_faces(known.stretch, true))(0, 0), known.stress,
                5e-5 + 20 * epsilon<TypeParam> * 2e6)
        << "stretch " << known.stretch;
}

TEST(MooneyRivlin, ConstantsFollowFromYoungsModulus) {
  const auto law = MooneyRivlin<double>::from_young(20e3, 1e6, 4.0);
  EXPECT_DOUBLE_EQ(law.c1, 4 * law.c2);
  EXPECT_DOUBLE_EQ(law.young(), 20e3);
  EXPECT_DOUBLE_EQ(law.bulk_modulus(), 2e6);
  const double K = law.bulk_modulus(), G = law.shear_modulus();
  EXPECT_NEAR(9 * K * G / (3 * K + G), 19977.8, 0.05);
  EXPECT_NEAR(sound_speed(law, 1000.0), 44.8206, 5e-5);
}

TEST(MooneyRivlin, ModuliThatAreNotPositiveAreRefused) {
  EXPECT_NO_THROW(paper_tissue<double>().validate());
  EXPECT_NO_THROW((MooneyRivlin<double>{2000, -500, 1e6}.validate()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const MooneyRivlin<double> bad : {MooneyRivlin<double>{-1, 0, 1e6},
                                         {500, -500, 1e6},
                                         {1000, 1000, 0},
                                         {1000, 1000, -1},
                                         {nan, 1000, 1e6},
                                         {1e3, 1e3, nan}})
    EXPECT_THROW(bad.validate(), InputError);
  try {
    MooneyRivlin<double>{1000, 1000, -7}.validate();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("D1"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("-7"), std::string::npos);
  }
}

// Numbers that are taken for D1 by mistake: Poisson's ratio, D1 in MPa or kPa, and the 2 / K of other programs in 1/Pa
// and 1/MPa. In kPa, Poisson's ratio is above the -1/2 from which other laws accept it.
TEST(MooneyRivlin, RejectsConstantsThatAreNotD1) {
  for (const double d1 : {0.49, 0.3, 1.0, 1e-6, 1e-12, 1000.0, 2000.0}) {
    try {
      MooneyRivlin<double>::from_young(20e3, d1).validate();
      ADD_FAILURE() << d1 << " passes";
    } catch (const InputError& error) {
      const std::string text = error.what();
      for (const char* part : {"D1", "bulk modulus", "Poisson's ratio -"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
  // The smallest that passes has Poisson's ratio zero: K = 2 G / 3, G = E / 3.
  EXPECT_NO_THROW(MooneyRivlin<double>::from_young(20e3, 20e3 / 9 * (1 + 1e-12)).validate());
  EXPECT_THROW(MooneyRivlin<double>::from_young(20e3, 20e3 / 9 * (1 - 1e-12)).validate(), InputError);
  EXPECT_NO_THROW(MooneyRivlin<float>::from_young_poisson(20e3f, 0.0f).validate());
}

// One spelling means one material in every law.
TEST(MooneyRivlin, HasTheModuliItIsMadeFrom) {
  const double E = 20e3, nu = 0.45, K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));
  const auto check = [&](const auto& law) {
    EXPECT_NEAR(law.bulk_modulus(), K, 1e-12 * K);
    EXPECT_NEAR(law.shear_modulus(), G, 1e-12 * G);
    EXPECT_NO_THROW(law.validate());
  };
  check(MooneyRivlin<>::from_young_poisson(E, nu));
  check(MooneyRivlin<>::from_moduli(K, G, 3.0));
  check(hmps::NeoHookean<>::from_young_poisson(E, nu));
  check(hmps::NeoHookean<>::from_moduli(K, G));
  check(hmps::SaintVenantKirchhoff<>::from_young_poisson(E, nu));
  check(hmps::SaintVenantKirchhoff<>::from_moduli(K, G));
  check(hmps::LinearElastic<>::from_young_poisson(E, nu));
  check(hmps::LinearElastic<>::from_moduli(K, G));
  EXPECT_DOUBLE_EQ(MooneyRivlin<>::from_moduli(K, G, 3.0).c1, 3 * MooneyRivlin<>::from_moduli(K, G, 3.0).c2);
}

}  // namespace mooney_rivlin_test
