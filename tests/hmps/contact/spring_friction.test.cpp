// SPDX-License-Identifier: MIT
#include "hmps/contact/spring_friction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace spring_friction_test {

using Point = hmps::Vector<double, 3>;

static_assert(hmps::FrictionLaw<hmps::SpringFriction>);
static_assert(hmps::detail::has_spring<hmps::SpringFriction> && !hmps::detail::has_spring<hmps::CorrectedFriction> &&
              !hmps::detail::has_spring<hmps::PaperFriction>);
static_assert(hmps::detail::damping_of<hmps::CorrectedFriction>() == 0 &&
              hmps::detail::damping_of<hmps::SpringFriction>() == hmps::SpringFriction::damping);

/// Below the limit: a spring and a damper.
TEST(SpringFriction, IsElasticBelowTheLimit) {
  const Point slip(3e-6, 4e-6, 0), velocity(1e-3, 0, 0);
  const auto found = hmps::spring_friction<double, 3>(slip, velocity, 1e9, 1e5, 1e4);
  EXPECT_EQ(found.elastic, slip);
  EXPECT_TRUE(found.sticks);
  EXPECT_NEAR((found.force - Point(3100, 4000, 0)).norm(), 0, 1e-9);
}

/// Beyond it the spring is cut to what the limit holds, in the direction of the slip.
TEST(SpringFriction, SlidesBeyondTheLimit) {
  const Point slip(3e-5, 4e-5, 0);
  const auto found = hmps::spring_friction<double, 3>(slip, Point::Zero(), 1e9, 1e5, 1e4);
  EXPECT_NEAR(1e9 * found.elastic.norm(), 1e4, 1e-8);
  EXPECT_NEAR(found.elastic.cross(slip).norm(), 0, 1e-22);
  EXPECT_NEAR(found.force.norm(), 1e4, 1e-8);
  // The second time there is nothing left to cut, except for rounding.
  const auto again = hmps::spring_friction<double, 3>(found.elastic, Point::Zero(), 1e9, 1e5, 1e4);
  EXPECT_NEAR((again.elastic - found.elastic).norm(), 0, 1e-20);
  // When the slip reverses, the spring yields at once: it starts back from the limit, not from where the slip ended.
  const Point back = found.elastic - Point(3e-7, 4e-7, 0);
  EXPECT_TRUE((hmps::spring_friction<double, 3>(back, Point::Zero(), 1e9, 1e5, 1e4)).sticks);
}

/// While it slides, the spring holds what the damper leaves of the limit.
TEST(SpringFriction, SharesTheLimitWithTheDamper) {
  const Point slip(3e-5, 4e-5, 0), velocity(0.03, 0.04, 0);  // the damper takes half of the limit
  const auto found = hmps::spring_friction<double, 3>(slip, velocity, 1e9, 1e5, 1e4);
  EXPECT_FALSE(found.sticks);
  EXPECT_NEAR(found.force.norm(), 1e4, 1e-8);
  EXPECT_NEAR((1e9 * found.elastic + 1e5 * velocity - found.force).norm(), 0, 1e-8);
}

/// A damper that takes all of the limit leaves nothing for the spring and never turns it against the slip; a damper
/// that slides back does not stretch the spring.
TEST(SpringFriction, DoesNotReverseOrStretchTheSpring) {
  const Point slip(1e-6, 0, 0);
  const auto fast = hmps::spring_friction<double, 3>(slip, Point(1, 0, 0), 1e9, 1e5, 1e4);
  EXPECT_NEAR((fast.force - Point(1e4, 0, 0)).norm(), 0, 1e-8);
  EXPECT_EQ(fast.elastic, Point::Zero());
  const auto back = hmps::spring_friction<double, 3>(slip, Point(-1, 0, 0), 1e9, 1e5, 1e4);
  EXPECT_NEAR((back.force + Point(1e4, 0, 0)).norm(), 0, 1e-8);
  EXPECT_EQ(back.elastic, slip);
}

/// A slip that decelerates by `a` comes to rest below the limit L, not at it, where its force would follow the normal
/// force. With tau = c / k, it sticks when v = a tau, with the spring at L - c a tau; until it rests, it slips by
/// another a tau^2 / 2. This holds to first order in dt / tau, which is 1/200.
TEST(SpringFriction, ComesToRestBelowTheLimit) {
  constexpr double k = 1e9, c = 1e5, tau = c / k, dt = tau / 200, a = 1, limit = 4 * k * a * tau * tau;
  Point elastic = Point::Zero();
  for (double v = 5 * a * tau; v > 0; v -= a * dt)
    elastic = hmps::spring_friction<double, 3>(elastic + Point(v * dt, 0, 0), Point(v, 0, 0), k, c, limit).elastic;
  const auto rest = hmps::spring_friction<double, 3>(elastic, Point::Zero(), k, c, limit);
  EXPECT_TRUE(rest.sticks);
  EXPECT_NEAR(rest.force[0], limit - k * a * tau * tau / 2, 0.02 * k * a * tau * tau);
}

TEST(SpringFriction, HoldsNothingWithoutALoad) {
  const auto found = hmps::spring_friction<double, 3>(Point(1e-6, 0, 0), Point(0, 1, 0), 1e9, 1e5, 0);
  EXPECT_EQ(found.force, Point::Zero());
  EXPECT_EQ(found.elastic, Point::Zero());
  const auto none = hmps::spring_friction<double, 3>(Point::Zero(), Point::Zero(), 1e9, 1e5, 0);
  EXPECT_EQ(none.force, Point::Zero());
}

/// A closed path of slip gives back no more energy than was put in: the work on the slave, force times slip of the wall
/// relative to it, is not negative.
TEST(SpringFriction, TakesEnergyOnAClosedPath) {
  constexpr double dt = 1e-6;
  for (const double damping : {0., 1e5}) {
    Point elastic = Point::Zero(), last = Point::Zero();
    double work = 0;
    for (int k = 0; k < 4000; ++k) {
      const double t = 2e-3 * 3.14159265358979323846 * k;
      const Point place(2e-5 * std::sin(t), 1e-5 * std::sin(2 * t), 0), step = place - last;
      const auto found = hmps::spring_friction<double, 3>(elastic + step, step / dt, 1e9, damping, 1e4);
      work += found.force.dot(step);
      elastic = found.elastic, last = place;
    }
    EXPECT_GT(work, 1e4 * 1e-5) << "it slides, by more than the elastic slip";
  }
}

}  // namespace spring_friction_test
