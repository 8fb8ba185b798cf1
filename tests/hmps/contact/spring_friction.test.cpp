// SPDX-License-Identifier: MIT
#include "hmps/contact/spring_friction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace {

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
  // A second time nothing is left to be cut, but for rounding.
  const auto again = hmps::spring_friction<double, 3>(found.elastic, Point::Zero(), 1e9, 1e5, 1e4);
  EXPECT_NEAR((again.elastic - found.elastic).norm(), 0, 1e-20);
  // Turned back, it yields at once: the limit is where the force was, not where the slip ended.
  const Point back = found.elastic - Point(3e-7, 4e-7, 0);
  EXPECT_TRUE((hmps::spring_friction<double, 3>(back, Point::Zero(), 1e9, 1e5, 1e4)).sticks);
}

/// The damper may reach the limit before the spring does; it leaves no slip behind.
TEST(SpringFriction, DampsUpToTheLimitWithoutSliding) {
  const auto found = hmps::spring_friction<double, 3>(Point(1e-6, 0, 0), Point(0, 1, 0), 1e9, 1e5, 1e4);
  EXPECT_FALSE(found.sticks);
  EXPECT_NEAR(found.force.norm(), 1e4, 1e-8);
  EXPECT_EQ(found.elastic, Point(1e-6, 0, 0));
}

TEST(SpringFriction, HoldsNothingWithoutALoad) {
  const auto found = hmps::spring_friction<double, 3>(Point(1e-6, 0, 0), Point(0, 1, 0), 1e9, 1e5, 0);
  EXPECT_EQ(found.force, Point::Zero());
  EXPECT_EQ(found.elastic, Point::Zero());
  const auto none = hmps::spring_friction<double, 3>(Point::Zero(), Point::Zero(), 1e9, 1e5, 0);
  EXPECT_EQ(none.force, Point::Zero());
}

/// A closed path of slip gives back no more than was put in: the work on the slave, force times slip of the wall
/// against it, is not negative.
TEST(SpringFriction, TakesEnergyOnAClosedPath) {
  Point elastic = Point::Zero(), last = Point::Zero();
  double work = 0;
  for (int k = 0; k < 4000; ++k) {
    const double t = 2e-3 * 3.14159265358979323846 * k;
    const Point place(2e-5 * std::sin(t), 1e-5 * std::sin(2 * t), 0);
    const auto found = hmps::spring_friction<double, 3>(elastic + place - last, Point::Zero(), 1e9, 0, 1e4);
    work += found.force.dot(place - last);
    elastic = found.elastic, last = place;
  }
  EXPECT_GT(work, 1e4 * 1e-5) << "it slides, by more than the elastic slip";
}

}  // namespace
