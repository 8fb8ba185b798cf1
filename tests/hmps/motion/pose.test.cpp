// SPDX-License-Identifier: MIT
#include "hmps/motion/pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

namespace pose_test {

using hmps::Matrix;
using hmps::Pose;
using hmps::Vector;

template <class S_, int D_>
struct Case {
  using S = S_;
  static constexpr int D = D_;
};

template <class S, int D>
Pose<S, D> example(double angle) {
  Pose<S, D> pose;
  if constexpr (D == 2)
    pose.rotation = hmps::rotation<S>(static_cast<S>(angle));
  else
    pose.rotation = hmps::rotation<S>(Vector<S, 3>(static_cast<S>(angle) * Vector<S, 3>(1, 2, -2) / S(3)));
  pose.pivot = Vector<S, D>::Constant(S(0.5));
  pose.translation = Vector<S, D>::Unit(1);
  return pose;
}

template <class T>
class PoseTest : public testing::Test {};
using Cases = testing::Types<Case<float, 2>, Case<double, 2>, Case<float, 3>, Case<double, 3>>;
TYPED_TEST_SUITE(PoseTest, Cases);

TYPED_TEST(PoseTest, RestIsTheDefault) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const Vector<S, D> x = Vector<S, D>::Constant(S(3));
  EXPECT_EQ((Pose<S, D>{}(x)), x);
}

TYPED_TEST(PoseTest, KeepsDistancesAndTranslatesItsPivot) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const S eps = S(16) * std::numeric_limits<S>::epsilon();
  for (const double angle : {0.0, 1e-9, 0.09, 0.11, 1.0, 3.0, 7.0}) {
    const auto pose = example<S, D>(angle);
    EXPECT_LE((pose.rotation.transpose() * pose.rotation - Matrix<S, D>::Identity()).norm(), eps);
    EXPECT_NEAR(pose.rotation.determinant(), S(1), eps);
    EXPECT_LE((pose(pose.pivot) - pose.pivot - pose.translation).norm(), eps);
  }
}

TYPED_TEST(PoseTest, ComposesAndInverts) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const S eps = S(64) * std::numeric_limits<S>::epsilon();
  const auto first = example<S, D>(0.7);
  auto second = example<S, D>(-1.9);
  second.pivot = Vector<S, D>::Constant(S(-2));
  const Vector<S, D> x = S(2) * Vector<S, D>::Unit(0) - Vector<S, D>::Unit(D - 1);
  EXPECT_LE((compose(second, first)(x) - second(first(x))).norm(), eps);
  EXPECT_GT((compose(first, second)(x) - second(first(x))).norm(), S(0.1));
  EXPECT_LE((inverse(first)(first(x)) - x).norm(), eps);
}

TEST(Rotation, TurnsTheRightWay) {
  using V = Vector<double, 3>;
  const double quarter = std::numbers::pi / 2;
  EXPECT_LE((hmps::rotation<double>(V(0, 0, quarter)) * V(1, 0, 0) - V(0, 1, 0)).norm(), 1e-15);
  EXPECT_LE((hmps::rotation<double>(V(0, quarter, 0)) * V(0, 0, 1) - V(1, 0, 0)).norm(), 1e-15);
  EXPECT_LE((hmps::rotation(quarter) * Vector<double, 2>(1, 0) - Vector<double, 2>(0, 1)).norm(), 1e-15);
  const V a(1, 2, 3), b(-2, 0.5, 4);
  EXPECT_EQ(V(hmps::skew(a) * b), V(a.cross(b)));
}

TEST(Rotation, SeriesAndClosedFormMeet) {
  using V = Vector<double, 3>;
  // Two angles on either side of the switch: the rotations must differ by no more than the angles.
  const V axis = V(1, 2, -2) / 3.0;
  const double h = 1e-12;
  const auto below = hmps::rotation<double>(V((0.1 - h) * axis));
  const auto above = hmps::rotation<double>(V((0.1 + h) * axis));
  EXPECT_LE((above - below).norm(), 4 * h);
  const V rate(0.3, -1, 0.2);
  EXPECT_LE((hmps::angular_velocity<double>(V((0.1 + h) * axis), rate) -
             hmps::angular_velocity<double>(V((0.1 - h) * axis), rate))
                .norm(),
            4 * h);
}

TEST(Velocity, IsTheRateOfThePosition) {
  using V = Vector<double, 3>;
  // A rotation vector whose direction turns: its rate is not the angular velocity.
  for (const double size : {0.0, 0.05, 0.8, 2.5}) {
    const auto vector = [&](double t) { return V(size * V(std::cos(3 * t), std::sin(2 * t), 0.5)); };
    const V rate = size * V(-3 * std::sin(0.6), 2 * std::cos(0.4), 0);
    const auto pose = [&](double t) {
      return Pose<double, 3>{hmps::rotation<double>(vector(t)), V(1, 0, 2), V(t, t * t, 0)};
    };
    const hmps::PoseRate<double, 3> speed{hmps::angular_velocity<double>(vector(0.2), rate), V(1, 0.4, 0)};
    const V x(0.3, -0.4, 1.5);
    // The central difference has errors of the order of h^2 and of 1e-16 / h.
    const double h = 1e-5;
    const V expected = (pose(0.2 + h)(x) - pose(0.2 - h)(x)) / (2 * h);
    EXPECT_LE((velocity(pose(0.2), speed, x) - expected).norm(), 1e-8);
  }
  const Pose<double, 2> turned{hmps::rotation(0.5), Vector<double, 2>(1, 0), Vector<double, 2>(0, 0)};
  const hmps::PoseRate<double, 2> spin{Vector<double, 1>(2.0), Vector<double, 2>(0, 1)};
  const Vector<double, 2> v = velocity(turned, spin, Vector<double, 2>(2, 0));
  EXPECT_NEAR(v[0], -2 * std::sin(0.5), 1e-15);
  EXPECT_NEAR(v[1], 1 + 2 * std::cos(0.5), 1e-15);
}

}  // namespace pose_test
