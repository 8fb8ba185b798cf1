// SPDX-License-Identifier: MIT
#include "hmps/contact/penalty.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

namespace penalty_test {

using hmps::PenaltyStiffness;
using Point = hmps::Vector<double, 3>;

TEST(PenaltyStiffness, RatioFollowsTheStepAndFixedDoesNot) {
  const auto ratio = PenaltyStiffness::ratio(0.3);
  EXPECT_DOUBLE_EQ(ratio.at(1000, 1e-5), 3e12);
  EXPECT_DOUBLE_EQ(ratio.at(1000, 0.5e-5), 12e12);
  const auto fixed = PenaltyStiffness::fixed(3e12);
  EXPECT_DOUBLE_EQ(fixed.at(1000, 1e-5), 3e12);
  EXPECT_DOUBLE_EQ(fixed.at(1000, 0.5e-5), 3e12);
  EXPECT_EQ(fixed.coefficient(1000, 2e-5), 3e12) << "beyond the limit of the linear law";
  EXPECT_EQ(ratio.coefficient(1000, 1e-5), ratio.at(1000, 1e-5));
}

TEST(PenaltyStiffness, RefusesWhatIsUnstable) {
  for (const double bad : {0., -1., 1., 2., std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW((void)PenaltyStiffness::ratio(bad), hmps::InputError) << bad;
  for (const double bad : {0., -1., std::numeric_limits<double>::infinity()})
    EXPECT_THROW((void)PenaltyStiffness::fixed(bad), hmps::InputError) << bad;
  EXPECT_THROW((void)PenaltyStiffness::fixed(3e12).at(1000, 2e-5), hmps::InputError);
}

TEST(NormalForce, PushesAndNeverPulls) {
  EXPECT_DOUBLE_EQ(hmps::normal_force(3., 2., 0., -5.), 6.);
  EXPECT_DOUBLE_EQ(hmps::normal_force(3., 2., 0.5, 4.), 8.);
  EXPECT_DOUBLE_EQ(hmps::normal_force(3., 2., 0.5, -4.), 4.);
  EXPECT_EQ(hmps::normal_force(3., 2., 10., -4.), 0.);
}

struct Quadratic {  // k p^2 / l0
  static double force(double k, double p, double l0) { return k * p * p / l0; }
  static double largest_stiffness(double k, double p, double l0) { return 2 * k * p / l0; }
};
struct NoStiffness {
  static double force(double k, double p, double) { return k * p; }
};
static_assert(hmps::PenaltyLaw<hmps::LinearPenalty> && hmps::PenaltyLaw<Quadratic>);
static_assert(!hmps::PenaltyLaw<NoStiffness> && !hmps::PenaltyLaw<Point>);

TEST(PenaltyLaw, GivesTheNormalForce) {
  EXPECT_EQ(hmps::normal_force(Quadratic{}, 3., 2., 4., 0., -5.), 3.);
  EXPECT_EQ(hmps::normal_force(Quadratic{}, 3., 2., 4., 0.5, -5.), 0.5);
  EXPECT_EQ(hmps::normal_force(Quadratic{}, 3., 2., 4., 0.5, -7.), 0.);
  EXPECT_EQ(hmps::normal_force(Quadratic{}, 3.F, 2.F, 4.F, 0.5F, 2.F), 4.F);
  // The linear law is (39), to the bit.
  EXPECT_EQ(hmps::normal_force(hmps::LinearPenalty{}, 0.3, 0.7, 4., 0.1, 0.9), hmps::normal_force(0.3, 0.7, 0.1, 0.9));
  EXPECT_EQ(hmps::LinearPenalty::force(3., 2., 4.), 6.);
  EXPECT_EQ(hmps::LinearPenalty::largest_stiffness(3., 2., 4.), 3.);
}

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

}  // namespace penalty_test
