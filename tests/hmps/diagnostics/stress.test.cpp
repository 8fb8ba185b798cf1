// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/stress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "../../reference/message_of.hpp"
#include "hmps/laws/neo_hookean.hpp"

namespace stress_test {

using namespace hmps;
using Tensor = Matrix<double, 3>;

constexpr double mu = 3e3, kappa = 2e6;
constexpr NeoHookean<double> law{mu, kappa};
// The summed terms are of the size of kappa |J - 1| or mu: a few units in their last place.
constexpr double rounding = 1e-14 * kappa;

void expect_near(const Tensor& found, const Tensor& expected, double tolerance) {
  for (int c = 0; c < 9; ++c) EXPECT_NEAR(found(c % 3, c / 3), expected(c % 3, c / 3), tolerance) << "component " << c;
}
Tensor turned() { return Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix(); }

// sigma = mu J^(-5/3) dev(F F^T) + kappa (J - 1), for W = mu / 2 (J^(-2/3) I1 - 3) + kappa / 2 (J - 1)^2.
TEST(Stress, OfUniaxialStretch) {
  const double a = 1.3, b = 0.9, J = a * b * b;
  const Tensor F = Vector<double, 3>(a, b, b).asDiagonal();
  const double apart = mu * std::pow(J, -5.0 / 3) * (a * a - b * b);
  const Vector<double, 3> sigma(kappa * (J - 1) + 2 * apart / 3, kappa * (J - 1) - apart / 3,
                                kappa * (J - 1) - apart / 3);
  expect_near(cauchy_stress(law, F), sigma.asDiagonal(), rounding);
  expect_near(first_piola_kirchhoff(law, F),
              Vector<double, 3>(sigma[0] * b * b, sigma[1] * a * b, sigma[2] * a * b).asDiagonal(), rounding);
  EXPECT_NEAR(von_mises_stress(law, F), apart, rounding);
}

TEST(Stress, OfSimpleShear) {
  const double g = 0.6;
  Tensor F = Tensor::Identity(), sigma;
  F(0, 1) = g;
  sigma << 2 * g * g / 3, g, 0, g, -g * g / 3, 0, 0, 0, -g * g / 3;
  expect_near(cauchy_stress(law, F), mu * sigma, rounding);
  EXPECT_NEAR(von_mises_stress(law, F), mu * std::sqrt(3 * g * g + g * g * g * g), rounding);
}

TEST(Stress, OfAChangeOfVolumeIsAPressure) {
  const Tensor F = 1.1 * Tensor::Identity();
  expect_near(cauchy_stress(law, F), kappa * (1.1 * 1.1 * 1.1 - 1) * Tensor::Identity(), rounding);
  EXPECT_NEAR(von_mises_stress(law, F), 0, rounding);
}

TEST(Stress, TurnsWithTheBody) {
  const Tensor R = turned();
  expect_near(cauchy_stress(law, R), Tensor::Zero(), rounding);
  Tensor F;
  F << 1.2, 0.3, 0, -0.1, 0.9, 0.2, 0, 0.1, 1.05;
  const Tensor sigma = cauchy_stress(law, F);
  expect_near(cauchy_stress(law, Tensor(R * F)), R * sigma * R.transpose(), rounding);
  expect_near(sigma, sigma.transpose(), rounding);
  EXPECT_NEAR(von_mises_stress(law, Tensor(R * F)), von_mises_stress(law, F), rounding);
}

TEST(Stress, InThePlaneIsThatOfPlaneStrain) {
  Matrix<double, 2> F;
  F << 1.1, 0.4, 0.1, 0.95;
  const Tensor sigma = cauchy_stress(law, plane_strain(F));
  EXPECT_NEAR((cauchy_stress(law, F) - sigma.topLeftCorner<2, 2>()).norm(), 0, rounding);
  EXPECT_NE(sigma(2, 2), 0);
  EXPECT_NEAR(von_mises_stress(law, F), von_mises_stress(sigma), rounding);
  std::vector<Matrix<double, 2>> of_all(2, F);
  std::vector<Tensor> whole(2);
  cauchy_stresses(matrices(of_all), law, matrices(whole));
  EXPECT_EQ(whole[1], sigma);
}

TEST(Stress, VonMisesIsThePullOfSimpleTensionAndIgnoresPressure) {
  Tensor sigma = Tensor::Zero();
  sigma(1, 1) = -5;
  EXPECT_DOUBLE_EQ(von_mises_stress(sigma), 5);
  EXPECT_NEAR(von_mises_stress(Tensor(sigma + 3 * Tensor::Identity())), 5, 1e-14);
  sigma << 0, 2, 0, 2, 0, 0, 0, 0, 0;
  EXPECT_DOUBLE_EQ(von_mises_stress(sigma), 2 * std::sqrt(3.0));
}

TEST(Stress, OfAllParticlesIsThatOfEach) {
  std::vector<Matrix<float, 3>> F(3, Matrix<float, 3>::Identity()), cauchy(3), piola(3);
  F[1](0, 1) = 0.5f;
  F[2](2, 2) = 1.25f;
  std::vector<double> shear{1e3, 2e3, 3e3}, mises(3);
  // One law for each particle, as for the force.
  const auto material = [&](const auto& at) { return NeoHookean{at(scalars(shear)), kappa}; };
  cauchy_stresses(matrices(F), material, matrices(cauchy));
  first_piola_kirchhoff_stresses(matrices(F), material, matrices(piola));
  von_mises_stresses(matrices(F), material, scalars(mises));
  for (std::size_t i = 0; i < 3; ++i) {
    const Tensor gradient = F[i].cast<double>();
    const NeoHookean<double> own{shear[i], kappa};
    EXPECT_EQ(cauchy[i], cauchy_stress(own, gradient).cast<float>());
    EXPECT_EQ(piola[i], first_piola_kirchhoff(own, gradient).cast<float>());
    EXPECT_EQ(mises[i], von_mises_stress(own, gradient));
  }
}

TEST(Stress, ABrokenParticleIsNamed) {
  std::vector<Tensor> F(3, Tensor::Identity()), stress(3), few(2);
  F[1](0, 0) = -1;  // turned inside out: J^(-2/3) is NaN
  const auto text = hmps_test::message_of<StateError>([&] { cauchy_stresses(matrices(F), law, matrices(stress)); });
  EXPECT_NE(text.find("the Cauchy stress of particle 1"), std::string::npos) << text;
  EXPECT_THROW(cauchy_stresses(matrices(F), law, matrices(few)), InputError);
  EXPECT_THROW(cauchy_stresses(matrices(F), NeoHookean<double>{-mu, kappa}, matrices(stress)), InputError);
  EXPECT_THROW(cauchy_stresses(matrices(F), law, matrices(F)), InputError);
}

TEST(Stress, NamesTheParticleWithAnInvalidModulus) {
  const std::vector<Tensor> F(3, Tensor::Identity());
  std::vector<double> shear{mu, -mu, mu}, mises(3);
  const auto stress = [&] {
    von_mises_stresses(
        matrices(F),
        [&](const auto& at) {
          return NeoHookean{at(scalars(shear)), kappa};
        },
        scalars(mises));
  };
  EXPECT_NE(hmps_test::message_of(stress).find("the law of particle 1"), std::string::npos);
  shear[1] = mu;
  EXPECT_NO_THROW(stress());
}

}  // namespace stress_test
