// SPDX-License-Identifier: MIT
#include "hmps/contact/penetration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace penetration_test {

TEST(Penetration, SupportIsThePointOfTheEllipsoidThatReachesFurthest) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 10; ++trial) {
    hmps::Matrix<double, 3> F;
    for (int c = 0; c < 9; ++c) F(c % 3, c / 3) = (c % 4 == 0) + 0.5 * u(random);
    const hmps::Vector<double, 3> n = hmps::Vector<double, 3>(u(random), u(random), u(random)).normalized();
    double furthest = 0;
    // The ellipsoid is the image F q of the sphere |q| = l0 / 2; a point reaches as far as -n . F q.
    const hmps::Vector<double, 3> reach = -0.5e-3 * (F.transpose() * n);
    for (int a = 0; a < 400; ++a)
      for (int b = 0; b < 800; ++b) {
        const double theta = 3.14159265358979 * (a + 0.5) / 400, phi = 2 * 3.14159265358979 * b / 800;
        furthest = std::max(furthest, std::sin(theta) * (std::cos(phi) * reach[0] + std::sin(phi) * reach[1]) +
                                          std::cos(theta) * reach[2]);
      }
    // The grid's nearest point is at most 0.005 rad away; the error is 1 - cos of that.
    const double support = hmps::slave_support<double, 3>(F, n, 0.5e-3);
    EXPECT_LE(furthest, support * (1 + 1e-12));
    EXPECT_GE(furthest, support * (1 - 4e-4));
  }
}

TEST(Penetration, UndeformedSlaveIsASphereInAnyDirection) {
  const hmps::Matrix<float, 2> I = hmps::Matrix<float, 2>::Identity();
  EXPECT_FLOAT_EQ((hmps::slave_support<float, 2>(I, {0.6F, 0.8F}, 2.F)), 2.F);
}

TEST(Penetration, IsZeroWhereTheyDoNotTouch) {
  EXPECT_DOUBLE_EQ(hmps::penetration(0.5, 0.3), 0.2);
  EXPECT_EQ(hmps::penetration(0.5, 0.5), 0.);
  EXPECT_EQ(hmps::penetration(0.5, 0.7), 0.);
  EXPECT_DOUBLE_EQ(hmps::penetration(0.5, -0.2), 0.7);
}

}  // namespace penetration_test
