// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/momentum.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace momentum_test {

using namespace hmps;

template <class T>
struct MomentumIn : testing::Test {};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(MomentumIn, Scalars);

TYPED_TEST(MomentumIn, RigidMotionOfARing) {
  // Four particles of 2 g at unit distance from (3, 4, 0) that turn at 5 rad/s about z and move at 1 m/s along y.
  const std::vector<Vector<double, 3>> arms{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  std::vector<Vector<TypeParam, 3>> x, v;
  for (const auto& arm : arms) {
    const Vector<double, 3> position = arm + Vector<double, 3>(3, 4, 0);
    const Vector<double, 3> velocity = cross<3>({0, 0, 5}, arm) + Vector<double, 3>(0, 1, 0);
    x.push_back(position.cast<TypeParam>());
    v.push_back(velocity.cast<TypeParam>());
  }
  std::vector<double> density{1000, 1000, 500, 2000}, volume{2e-6, 2e-6, 4e-6, 1e-6};
  const Vector<double, 3> p = linear_momentum(vectors(v), scalars(density), scalars(volume));
  EXPECT_LT((p - Vector<double, 3>(0, 8e-3, 0)).norm(), 1e-15);
  const Vector<double, 3> about(3, 4, 0);
  const Vector<double, 3> spin = angular_momentum(vectors(x), vectors(v), 1000.0, 2e-6, about);
  EXPECT_LT((spin - Vector<double, 3>(0, 0, 4 * 2e-3 * 5)).norm(), 1e-15);
  const Vector<double, 3> all = angular_momentum(vectors(x), vectors(v), 1000.0, 2e-6);
  EXPECT_LT((all - spin - cross<3>(about, p)).norm(), 1e-15);
}

TYPED_TEST(MomentumIn, PlaneHasOneComponentOfSpin) {
  std::vector<Vector<TypeParam, 2>> x{{1, 0}, {-1, 0}}, v{{0, 3}, {0, -3}};
  EXPECT_NEAR(angular_momentum(vectors(x), vectors(v), 1000.0, 1e-3)[0], 6.0, 1e-14);
  EXPECT_EQ(linear_momentum(vectors(v), 1000.0, 1e-3).norm(), 0.0);
}

TEST(Momentum, BadInputIsRefused) {
  std::vector<Vector<double, 2>> x(3, Vector<double, 2>::Zero()), few(2, Vector<double, 2>::Zero());
  EXPECT_THROW((void)angular_momentum(vectors(x), vectors(few), 1000.0, 1.0), InputError);
  const Vector<double, 2> nowhere(std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_THROW((void)angular_momentum(vectors(x), vectors(x), 1000.0, 1.0, nowhere), InputError);
  EXPECT_THROW((void)linear_momentum(vectors(x), 0.0, 1.0), InputError);
  EXPECT_THROW((void)linear_momentum(vectors(x), 1000.0, -1.0), InputError);
}

TEST(Momentum, RejectsANullView) {
  const auto nowhere = vectors<3>(static_cast<const double*>(nullptr), 2);
  EXPECT_THROW((void)linear_momentum(nowhere, 1000.0, 1e-9), InputError);
}

}  // namespace momentum_test
