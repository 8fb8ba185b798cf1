// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/gradients.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "hmps/core/math.hpp"

namespace gradients_test {

TEST(StretchBound, IsAboveTheLargestSingularValueAndSharpWhereItCounts) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    hmps::Matrix<double, 3> F;
    for (int c = 0; c < 9; ++c) F(c % 3, c / 3) = u(random);
    // Power iteration.
    hmps::Vector<double, 3> q(1, 2, 3);
    for (int k = 0; k < 200; ++k) q = (F.transpose() * (F * q)).normalized();
    EXPECT_GE((hmps::stretch_bound<double, 3>(F)), (F * q).norm() * (1 - 1e-12));
  }
  EXPECT_DOUBLE_EQ((hmps::stretch_bound<double, 3>(2 * hmps::Matrix<double, 3>::Identity())), 2);
  hmps::Matrix<double, 2> shear = hmps::Matrix<double, 2>::Identity();
  shear(0, 1) = 1;
  EXPECT_NEAR((hmps::stretch_bound<double, 2>(shear)), (1 + std::sqrt(5.)) / 2, 1e-12);
}

TEST(StretchBound, OfLanesIsThatOfEachNumber) {
  using Lanes = hmps::Lanes<double>;
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<hmps::Matrix<double, 3>> F(Lanes::width);
  for (auto& one : F)
    for (int c = 0; c < 9; ++c) one(c % 3, c / 3) = u(random);
  const auto lanes = hmps::detail::gather_gradients<double, 3>(F, [](std::size_t l) { return l; });
  const Lanes bound = hmps::stretch_bound<Lanes, 3>(lanes);
  for (int l = 0; l < Lanes::width; ++l)
    // A compiler may fuse products and sums of the one and not of the other: some roundings of numbers up to 9.
    EXPECT_NEAR(bound.lane[l], (hmps::stretch_bound<double, 3>(F[static_cast<std::size_t>(l)])), 1e-14);
}

TEST(GatherGradients, PutsEachParticleInItsLane) {
  using Lanes = hmps::Lanes<float>;
  std::vector<hmps::Matrix<double, 2>> F(3 * Lanes::width);
  for (std::size_t i = 0; i < F.size(); ++i)
    F[i] << static_cast<double>(i), static_cast<double>(i) + 0.25, -static_cast<double>(i), 0.5;
  const auto lanes = hmps::detail::gather_gradients<float, 2>(F, [](std::size_t l) { return 3 * l + 1; });
  for (int l = 0; l < Lanes::width; ++l)
    for (int c = 0; c < 2; ++c)
      for (int r = 0; r < 2; ++r)
        EXPECT_EQ(lanes(r, c).lane[l], static_cast<float>(F[3 * static_cast<std::size_t>(l) + 1](r, c)));
}

TEST(Undeformed, IsTheIdentity) {
  const hmps::detail::Undeformed<double, 3> F;
  EXPECT_EQ(F[7], (hmps::Matrix<double, 3>::Identity()));
}

}  // namespace gradients_test
