// SPDX-License-Identifier: MIT
#include "hmps/bonds/detail/plausible_spacing.hpp"

#include <gtest/gtest.h>

#include <string>

#include "../../../reference/scenes.hpp"
#include "../bonds_of_a_scene.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/core/view.hpp"

namespace plausible_spacing_test {

using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;

template <int D>
std::string error_with(const scenes::Points<D>& points, double spacing, double ratio = 1.75) {
  return error_of(
      [&] { (void)hmps::BondList<float, D>(hmps::vectors(points), {.spacing = spacing, .radius_ratio = ratio}); });
}

// Millimetres given as metres: a list of all pairs of these 13,824 particles would take gigabytes.
TEST(PlausibleSpacing, RefusesASpacingThatBondsEverythingToEverything) {
  const auto points = scenes::box<3>({24, 24, 24});
  const std::string error = error_with<3>(points, 1.2);
  EXPECT_TRUE(has(error, "particle 0 has 13823 neighbours")) << error;
  EXPECT_TRUE(has(error, "64 particles that were sampled have 13823 on average")) << error;
  EXPECT_TRUE(has(error, "a spacing of 1.2 m gives about 22")) << error;
  EXPECT_TRUE(has(error, "the typical distance to the nearest particle is 0.0012 m")) << error;
}

TEST(PlausibleSpacing, RejectsASpacingWithFewNeighbours) {
  auto points = scenes::box<3>({6, 6, 6});
  points.push_back(points.front() + hmps::Vector<double, 3>(1e-7, 0, 0));  // one pair within the radius
  const std::string error = error_with<3>(points, 1.2e-6);
  EXPECT_TRUE(has(error, "particle 5 has 0 neighbours")) << error;
  EXPECT_TRUE(has(error, "62 of 64 particles")) << error;
  EXPECT_TRUE(has(error, "a spacing of 1.2e-06 m looks wrong")) << error;
  EXPECT_TRUE(has(error, "the typical distance to the nearest particle is 0.0012 m")) << error;
}

// A radius in metres instead of a number of spacings: the spacing itself is not wrong.
TEST(PlausibleSpacing, NamesARadiusThatIsNotInSpacings) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  const std::string error = error_with<3>(scenes::box<3>({6, 6, 6}), l0, 1.75 * l0);
  EXPECT_TRUE(has(error, "radius_ratio is a number of spacings")) << error;
}

// Somewhat denser or sparser than a lattice, or with another radius, as clouds that are not lattices may be.
TEST(PlausibleSpacing, AcceptsUnusualSpacings) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  for (const double ratio : {0.85, 1.0, 1.2}) {
    EXPECT_EQ(error_with<3>(scenes::box<3>({7, 7, 7}), ratio * l0), "nothing was thrown") << ratio;
    EXPECT_EQ(error_with<2>(scenes::box<2>({9, 9}), ratio * l0), "nothing was thrown") << ratio;
  }
  for (const double radius : {1.01, 1.4143, 1.7321, 2.0, 3.1}) {
    EXPECT_EQ(error_with<2>(scenes::box<2>({9, 9}), l0, radius), "nothing was thrown") << radius;
    EXPECT_EQ(error_with<3>(scenes::box<3>({9, 9, 9}), l0, radius), "nothing was thrown") << radius;
  }
}

// No cloud that fills a body has its particles as far apart or as densely as this.
TEST(PlausibleSpacing, RefusesSpacingsThatNoCloudHas) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  for (const double ratio : {0.6, 0.7, 1.5, 2.0}) {
    EXPECT_TRUE(has(error_with<3>(scenes::box<3>({9, 9, 9}), ratio * l0), "give a spacing of that size")) << ratio;
    EXPECT_TRUE(has(error_with<2>(scenes::box<2>({9, 9}), ratio * l0), "give a spacing of that size") || ratio == 1.5);
  }
}

}  // namespace plausible_spacing_test
