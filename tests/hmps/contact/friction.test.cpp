// SPDX-License-Identifier: MIT
#include "hmps/contact/friction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace friction_test {

using Point = hmps::Vector<double, 3>;

TEST(Friction, SticksBelowTheLimitAndSlidesAtIt) {
  const Point v(3, 4, 0);
  EXPECT_TRUE((hmps::friction_force<double, 3>(v, 2., 100.).isApprox(2. * v)));
  const Point f = hmps::friction_force<double, 3>(v, 200., 100.);
  EXPECT_NEAR(f.norm(), 100, 1e-12);
  EXPECT_NEAR(f.dot(v), 500, 1e-12);
  EXPECT_EQ((hmps::friction_force<double, 3>(Point::Zero(), 200., 100.)), Point::Zero());
}

TEST(Friction, TangentialPartIsNormalToTheNormal) {
  const Point n = Point(1, 2, 3).normalized(), v(0.3, -0.2, 0.7);
  const Point t = hmps::tangential<double, 3>(v, n);
  EXPECT_NEAR(t.dot(n), 0, 1e-15);
  EXPECT_NEAR((v - t).cross(n).norm(), 0, 1e-15);
}

/// Eqs. (40) to (43) on two particles that see only each other, at a high limit: their relative
/// tangential velocity after one step of unit length at unit density.
template <class Law>
double relative_velocity_after_stick(bool both_roles, bool prescribed) {
  const Point v(1, 0, 0);  // of the wall relative to the first particle
  const double passes = both_roles ? 2 : 1;
  // N: 1 for each pass that has the particle as a slave, and 1 for each that has it as a master of weight 1.
  const double first = both_roles ? 2 : 1, second = prescribed ? 0 : both_roles ? 2 : 1;
  const Point force = hmps::friction_force<double, 3>(v, Law::share(first + second), 1e9);
  // Each pass pushes the first by the force and the second by its reaction.
  const Point change = passes * force * (prescribed ? 1 : 2);
  return (v - change)[0];
}

TEST(CorrectedFriction, StickStopsTwoParticlesInOneStep) {
  for (const bool both : {true, false})
    for (const bool prescribed : {true, false})
      EXPECT_NEAR(relative_velocity_after_stick<hmps::CorrectedFriction>(both, prescribed), 0, 1e-15);
}

TEST(PaperFriction, StickReversesTwoFreeParticles) {
  EXPECT_DOUBLE_EQ(relative_velocity_after_stick<hmps::PaperFriction>(true, false), -3);
  EXPECT_DOUBLE_EQ(relative_velocity_after_stick<hmps::PaperFriction>(false, false), -1);
}

struct Halfway {
  static constexpr bool needs_load = false;
  template <class S>
  static S share(S) {
    return S(0.5);
  }
};
static_assert(hmps::FrictionLaw<Halfway>);
static_assert(!hmps::FrictionLaw<Point>);

}  // namespace friction_test
