// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/strain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace strain_test {

using namespace hmps;
using Tensor = Matrix<double, 3>;
constexpr double rounding = 4e-15;  // of numbers of about 1, summed a few times

Tensor turned() { return Eigen::AngleAxisd(0.8, Eigen::Vector3d(2, 1, -1).normalized()).toRotationMatrix(); }

TEST(Strain, OfUniaxialStretchUnderAnyRotation) {
  const Tensor F = turned() * Vector<double, 3>(0.5, 1.5, 1).asDiagonal();
  const Tensor E = green_lagrange_strain(F);
  EXPECT_NEAR((E - Tensor(Vector<double, 3>(-0.375, 0.625, 0).asDiagonal())).norm(), 0, rounding);
  EXPECT_NEAR((principal_stretches(F) - Vector<double, 3>(1.5, 1, 0.5)).norm(), 0, rounding);
  const Tensor mirrored = F * Vector<double, 3>(1, 1, -1).asDiagonal();  // a stretch has no sign
  EXPECT_NEAR((principal_stretches(mirrored) - Vector<double, 3>(1.5, 1, 0.5)).norm(), 0, rounding);
}

TEST(Strain, OfSimpleShear) {
  const double g = 0.7;
  Matrix<double, 2> F;
  F << 1, g, 0, 1;
  Matrix<double, 2> expected;
  expected << 0, g / 2, g / 2, g * g / 2;
  EXPECT_NEAR((green_lagrange_strain(F) - expected).norm(), 0, rounding);
  const double root = std::sqrt(1 + g * g / 4);
  EXPECT_NEAR((principal_stretches(F) - Vector<double, 2>(root + g / 2, root - g / 2)).norm(), 0, rounding);
}

TEST(Strain, RigidRotationHasNoneAndVolumeTheSameInAllDirections) {
  EXPECT_NEAR(green_lagrange_strain(turned()).norm(), 0, rounding);
  EXPECT_NEAR((principal_stretches(turned()) - Vector<double, 3>::Ones()).norm(), 0, rounding);
  const Tensor F = 1.2 * turned();
  EXPECT_NEAR((green_lagrange_strain(F) - 0.22 * Tensor::Identity()).norm(), 0, rounding);
  EXPECT_NEAR((principal_stretches(F) - Vector<double, 3>::Constant(1.2)).norm(), 0, rounding);
}

TEST(Strain, KeepsItsDigitsWhenSmall) {
  Tensor F = Tensor::Identity();
  F(0, 1) = 1e-12;
  EXPECT_DOUBLE_EQ(green_lagrange_strain(F)(0, 1), 0.5e-12);
  EXPECT_DOUBLE_EQ(green_lagrange_strain(F)(1, 1), 0.5e-24);
}

TEST(Strain, OfAllParticlesIsThatOfEach) {
  std::vector<Matrix<float, 2>> F(2, Matrix<float, 2>::Identity());
  F[1] << 1.5f, 0.25f, 0.f, 0.75f;
  std::vector<Matrix<double, 2>> strain(2);
  std::vector<Vector<double, 2>> stretch(2);
  green_lagrange_strains(matrices(F), matrices(strain));
  principal_stretches(matrices(F), vectors(stretch));
  for (std::size_t i = 0; i < 2; ++i) {
    const Matrix<double, 2> gradient = F[i].cast<double>();
    EXPECT_EQ(strain[i], green_lagrange_strain(gradient));
    EXPECT_EQ(stretch[i], principal_stretches(gradient));
  }
  F[1](0, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(green_lagrange_strains(matrices(F), matrices(strain)), InputError);
  strain.pop_back();
  EXPECT_THROW(green_lagrange_strains(matrices(F), matrices(strain)), InputError);
}

// Earlier, it was written as infinity.
TEST(Strain, ThatIsNotFiniteNamesTheParticle) {
  std::vector<Tensor> F(2, Tensor::Identity()), strain(2);
  std::vector<Vector<double, 3>> stretch(2);
  F[1](0, 0) = 1e200;
  const auto said = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const StateError& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_NE(said([&] { green_lagrange_strains(matrices(F), matrices(strain)); }).find("strain of particle 1 is not"),
            std::string::npos);
  EXPECT_NE(said([&] { principal_stretches(matrices(F), vectors(stretch)); }).find("stretches of particle 1 is not"),
            std::string::npos);
}

}  // namespace strain_test
