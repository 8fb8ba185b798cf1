// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/organ_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "../../../reference/message_of.hpp"
#include "hmps/core/executor.hpp"

namespace organ_motion_test {

using hmps::Index;
using Point = hmps::Vector<double, 3>;

/// Two organs of `size` particles each that touch in both roles: sides 0 and 1. The first particle of each is only a
/// slave.
struct Organs {
  std::size_t size;
  hmps::detail::OrganPairs pairs;
  std::vector<Point> place;
  std::vector<double> reach;
  hmps::detail::OrganMotion<double, 3> motion;
  explicit Organs(std::size_t size_of_each) : size(size_of_each), place(2 * size, Point::Zero()), reach(2 * size, 1) {
    std::size_t organ[2];
    for (std::size_t o = 0; o < 2; ++o) {
      std::vector<Index> all(size);
      for (std::size_t k = 0; k < size; ++k) {
        all[k] = static_cast<Index>(o * size + k);
        place[o * size + k] = Point(static_cast<double>(k), static_cast<double>(o), 0);
      }
      const std::vector<Index> masters(all.begin() + 1, all.end());
      organ[o] = pairs.add_organ({.name = o == 0 ? "liver" : "lung", .slaves = all, .masters = masters}, 1);
    }
    pairs.add_pair(organ[0], organ[1], {});
    pairs.number_particles();
    motion.resize(pairs);
    motion.restart(place, reach);
  }
  void measure() { motion.measure(pairs, place, reach, hmps::Serial{}); }
  [[nodiscard]] double used(std::size_t side) const { return motion.used(pairs.sides()[side]); }
};

TEST(OrganMotion, IsNothingIfOrgansMoveTogether) {
  Organs organs(600);  // in more than one chunk
  organs.measure();
  EXPECT_EQ(organs.used(0), 0);
  for (Point& x : organs.place) x += Point(0.25, 0.5, -2);
  organs.measure();
  organs.measure();  // the first call measures relative to the previous mean
  EXPECT_NEAR(organs.used(0), 0, 1e-12);
  EXPECT_NEAR(organs.used(1), 0, 1e-12);
}

TEST(OrganMotion, IsTheDistanceByWhichOneMovesAlone) {
  Organs organs(600);
  for (std::size_t k = 0; k < organs.size; ++k) organs.place[k] += Point(3, 0, 4);
  organs.measure();
  organs.measure();
  EXPECT_NEAR(organs.used(0), 5, 1e-9);
  EXPECT_NEAR(organs.used(1), 5, 1e-9);
  organs.motion.restart(organs.place, organs.reach);
  organs.measure();
  EXPECT_EQ(organs.used(0), 0);
}

TEST(OrganMotion, BoundsHowFarTwoMembersApproach) {
  Organs organs(600);
  const std::vector<Point> built = organs.place;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int step = 0; step < 20; ++step) {
    const Point shift[2] = {{u(random), 0, u(random)}, {0, u(random), 0}};
    for (std::size_t i = 0; i < built.size(); ++i)
      organs.place[i] += shift[i / organs.size] + 0.1 * Point::Constant(u(random));
    organs.measure();
    double most = 0;
    for (std::size_t i = 0; i < organs.size; i += 7)
      for (std::size_t j = organs.size; j < built.size(); j += 5)
        most = std::max(most, ((organs.place[i] - built[i]) - (organs.place[j] - built[j])).norm());
    for (std::size_t side = 0; side < 2; ++side) EXPECT_GE(organs.used(side), most) << step;
    organs.measure();
    for (std::size_t side = 0; side < 2; ++side) {
      EXPECT_GE(organs.used(side), most) << step;
      EXPECT_LE(organs.used(side), 3 * most) << step;
    }
  }
}

TEST(OrganMotion, IsABoundWhileTheMeanMovesBack) {
  Organs organs(3);
  for (std::size_t k = 0; k < 3; ++k) organs.place[k][0] += 1;
  organs.measure();
  // Two of three go back half the way and one goes on by as much, so that it is 1.5 from where it was.
  organs.place[0][0] -= 0.5;
  organs.place[1][0] -= 0.5;
  organs.place[2][0] += 0.5;
  organs.measure();
  EXPECT_GE(organs.used(0), 1.5 - 1e-12);
}

TEST(OrganMotion, CountsTheLargestGrowthOfMasters) {
  Organs organs(600);
  organs.reach[0] = 9;  // of a slave
  organs.measure();
  EXPECT_EQ(organs.used(0), 0);
  EXPECT_EQ(organs.used(1), 0);
  organs.reach[3] = 1.5;
  organs.reach[550] = 1.25;
  organs.reach[4] = 0.5;
  organs.measure();
  EXPECT_EQ(organs.used(0), 0) << "the first organ is slave";
  EXPECT_EQ(organs.used(1), 0.5) << "the first organ is wall";
}

TEST(OrganMotion, ReportsThePositionThatIsNotFinite) {
  Organs organs(600);
  organs.place[1187][2] = std::numeric_limits<double>::quiet_NaN();
  const std::string text = hmps_test::message_of<hmps::StateError>([&] { organs.measure(); });
  EXPECT_NE(text.find("component 2 of the position of particle 1187 of 'lung' to be"), std::string::npos) << text;
  Organs huge(600);
  for (Point& x : huge.place) x[0] = 1e308;
  EXPECT_NE(hmps_test::message_of<hmps::StateError>([&] { huge.measure(); }).find("of 'liver' to overflow"),
            std::string::npos);
}

}  // namespace organ_motion_test
