// SPDX-License-Identifier: MIT
#include "hmps/bonds/detail/plausible_spacing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../../../reference/scenes.hpp"
#include "../bonds_of_a_scene.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/core/view.hpp"
#include "hmps/particles/fitted.hpp"

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

template <int D>
scenes::Points<D> irregular(scenes::Points<D> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < D; ++c)
      points[i][c] += 0.05 * scenes::Scene<D>::spacing * std::sin(static_cast<double>(7 * i) + 2.0 * c);
  return points;
}

// Denser or sparser than a lattice, as clouds that are not regular may be, or with another radius.
TEST(PlausibleSpacing, AcceptsUnusualSpacings) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  for (const double ratio : {0.7, 1.0, 1.3}) {
    EXPECT_EQ(error_with<3>(irregular<3>(scenes::box<3>({9, 9, 9})), ratio * l0), "nothing was thrown") << ratio;
    EXPECT_EQ(error_with<2>(irregular<2>(scenes::box<2>({9, 9})), ratio * l0), "nothing was thrown") << ratio;
  }
  for (const double radius : {1.01, 1.4143, 1.7321, 2.0, 3.1}) {
    EXPECT_EQ(error_with<2>(scenes::box<2>({9, 9}), l0, radius), "nothing was thrown") << radius;
    EXPECT_EQ(error_with<3>(scenes::box<3>({9, 9, 9}), l0, radius), "nothing was thrown") << radius;
  }
}

// Once these passed, with another effective radius than the caller thought. The spacing of a lattice is known.
TEST(PlausibleSpacing, RefusesAnotherSpacingThanThatOfALattice) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  const auto turned = [](auto points) {
    for (auto& x : points) x = (Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, -1).normalized()) * x).eval();
    return points;
  };
  auto two_bodies = scenes::box<3>({6, 6, 6});
  for (const auto& x : scenes::box<3>({6, 5, 4}))
    two_bodies.push_back(x + hmps::Vector<double, 3>(8.3 * l0, 0.2 * l0, 0.4 * l0));
  for (const double ratio : {0.7, 0.9, 0.97, 1.03, 1.1, 1.3}) {
    for (const auto& points : {scenes::box<3>({9, 9, 9}), scenes::box<3>({12, 9, 2}), scenes::box<3>({9, 3, 3}),
                               turned(scenes::box<3>({9, 9, 9})), two_bodies})
      EXPECT_TRUE(has(error_with<3>(points, ratio * l0), "lattice of spacing 0.0012")) << ratio;
    EXPECT_TRUE(has(error_with<2>(scenes::box<2>({9, 9}), ratio * l0), "lattice of spacing 0.0012")) << ratio;
  }
  for (const double ratio : {0.985, 1.0, 1.015})
    EXPECT_EQ(error_with<3>(turned(scenes::box<3>({9, 9, 9})), ratio * l0), "nothing was thrown") << ratio;
}

// Regular clouds that are no cubic lattice have a spacing (the cube root of the volume of a particle) that is not the
// distance to the nearest neighbour.
TEST(PlausibleSpacing, AcceptsTheSpacingOfOtherRegularClouds) {
  scenes::Points<3> face_centred, body_centred, flat, layer;
  scenes::Points<2> triangular;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j) {
      for (int k = 0; k < 7; ++k) {
        const hmps::Vector<double, 3> x(i, j, k);
        if ((i + j + k) % 2 == 0) face_centred.push_back(x);
        body_centred.push_back(2 * x);
        body_centred.push_back(2 * x + hmps::Vector<double, 3>::Ones());
        if (k < 3) flat.emplace_back(i, j, 0.8 * k);
      }
      layer.emplace_back(i, j, 0);
      triangular.emplace_back(i + 0.5 * (j % 2), std::sqrt(0.75) * j);
    }
  EXPECT_EQ(error_with<3>(face_centred, std::cbrt(2)), "nothing was thrown");
  EXPECT_EQ(error_with<3>(body_centred, std::cbrt(4)), "nothing was thrown");
  EXPECT_EQ(error_with<3>(flat, std::cbrt(0.8)), "nothing was thrown");
  EXPECT_EQ(error_with<2>(triangular, std::sqrt(std::sqrt(0.75))), "nothing was thrown");
  EXPECT_FALSE(has(error_with<3>(layer, 1.2), "lattice of spacing"));
}

TEST(PlausibleSpacing, RefusesSpacingsThatNoCloudHas) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  for (const double ratio : {0.58, 0.6}) {
    EXPECT_TRUE(has(error_with<3>(irregular<3>(scenes::box<3>({9, 9, 9})), ratio * l0), "spacing of about that size"));
    EXPECT_TRUE(has(error_with<2>(irregular<2>(scenes::box<2>({9, 9})), ratio * l0), "spacing of about that size"));
  }
  EXPECT_TRUE(has(error_with<3>(scenes::box<3>({16, 16, 16}), 1.5 * l0), "give a spacing of that size"));
  EXPECT_TRUE(has(error_with<2>(scenes::box<2>({40, 40}), 2.1 * l0), "give a spacing of that size"));
  EXPECT_TRUE(has(error_with<3>(scenes::box<3>({24, 24, 2}), 2.1 * l0), "give a spacing of that size"));
}

// Finer in a part, or several bodies in one place that are not bonded to each other.
TEST(PlausibleSpacing, AcceptsGradedCloudsAndBodiesThatOverlap) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  auto graded = scenes::box<3>({12, 12, 12});
  for (const auto& x : scenes::box<3>({8, 8, 8}))
    graded.push_back(0.5 * (x - scenes::box<3>({1, 1, 1})[0]) + graded[0] +
                     hmps::Vector<double, 3>::Constant(0.25 * l0));
  EXPECT_EQ(error_with<3>(graded, l0), "nothing was thrown");
  std::vector<hmps::Vector<double, 3>> overlapping;
  for (int body = 0; body < 3; ++body)
    for (const auto& x : scenes::box<3>({8, 8, 8}))
      overlapping.push_back(x + hmps::Vector<double, 3>::Constant(0.25 * l0 * body));
  const auto same = [](std::size_t i, std::size_t j) { return i / 512 == j / 512; };
  EXPECT_NO_THROW((hmps::BondList<double, 3>(hmps::vectors(overlapping), {.spacing = l0}, same)));
}

// A shell of one layer, in which the particles lie closer across it and farther apart along it.
TEST(PlausibleSpacing, AcceptsTheCloudsOfFittedShells) {
  const auto shell = [](const hmps::Vector<double, 3>& x) { return std::abs(x.norm() - 4) - 0.31; };
  const hmps::Vector<double, 3> reach = hmps::Vector<double, 3>::Constant(4.6);
  const auto fitted =
      hmps::fit_particles(shell, hmps::Box<double, 3>{-reach, reach}, 1.0, {.least_layers = 1, .least_support = 0});
  EXPECT_NO_THROW((hmps::BondList<double, 3>(hmps::vectors(fitted.positions), {.spacing = 1.0, .radius_ratio = 2.5})));
}

}  // namespace plausible_spacing_test
