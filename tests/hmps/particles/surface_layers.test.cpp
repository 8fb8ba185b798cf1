// SPDX-License-Identifier: MIT
#include "hmps/particles/surface_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "../../reference/backwards.hpp"
#include "hmps/particles/fitted.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/shapes/implicit.hpp"

namespace surface_layers_test {

using hmps_test::Backwards;

using V = hmps::Vector<double, 3>;
using Indices = std::vector<hmps::Index>;

template <int D>
Indices where(const std::vector<hmps::Vector<double, D>>& points, const auto& holds) {
  Indices found;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (holds(points[i])) found.push_back(static_cast<hmps::Index>(i));
  return found;
}

const hmps::Box<double, 3> region{V(-9, -9, -9), V(9, 9, 9)};

TEST(SurfaceLayers, OfABoxAreItsOuterSites) {
  std::vector<V> points;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 9; ++k) points.emplace_back(1e-3 * i, 1e-3 * j, 1e-3 * k);
  const auto layers = hmps::surface_layers(hmps::vectors(points), 1e-3);
  const auto depth = [](const V& x) { return std::min(x.minCoeff(), (V(6e-3, 7e-3, 8e-3) - x).minCoeff()) / 1e-3; };
  EXPECT_EQ(layers.outermost, where<3>(points, [&](const V& x) { return depth(x) < 0.5; }));
  EXPECT_EQ(layers.two_outermost, where<3>(points, [&](const V& x) { return depth(x) < 1.5; }));
}

TEST(SurfaceLayers, OfALatticeInAnyDirectionAreTheSitesThatLackANeighbour) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::vector<V> normals{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 1, 3}, {1, 2, 3}, {0, 1, 5}};
  for (int k = 0; k < 3; ++k) normals.emplace_back(normal(random), normal(random), normal(random));
  for (const V& n : normals) {
    const auto depth = [&](const V& x) { return std::min(0.13 - x.dot(n.normalized()), 8.9 - x.norm()); };
    const auto points = hmps::fill_lattice([&](const V& x) { return -depth(x); }, region, 1.0);
    const auto layers = hmps::surface_layers(hmps::vectors(points), 1.0);
    EXPECT_EQ(layers.outermost, where<3>(points, [&](const V& x) {
                bool lacks = false;
                for (int c = 0; c < 3; ++c)
                  for (const double step : {-1, 1}) lacks = lacks || depth(x + step * V::Unit(c)) < 0;
                return lacks;
              }));
    // Along a lattice plane the second layer ends between one and two spacings below the surface; others lie between.
    for (const hmps::Index i : layers.two_outermost) EXPECT_LT(depth(points[i]), 2.5);
    const auto least = where<3>(points, [&](const V& x) { return depth(x) < 1.5; });
    EXPECT_TRUE(std::includes(layers.two_outermost.begin(), layers.two_outermost.end(), least.begin(), least.end()));
  }
}

TEST(SurfaceLayers, OfThinWallsAreAllParticles) {
  Indices all;
  std::vector<V> points;
  for (const int thick : {1, 2, 3}) {
    points.clear();
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        for (int k = 0; k < thick; ++k) points.emplace_back(i, j, k);
    const auto layers = hmps::surface_layers(hmps::vectors(points), 1.0);
    all.resize(points.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<hmps::Index>(i);
    EXPECT_EQ(layers.two_outermost, all);
    EXPECT_EQ(layers.outermost.size(), thick < 3 ? points.size() : points.size() - 36u);
  }
}

TEST(SurfaceLayers, OfIrregularCloudsAreTheirLayers) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  std::vector<V> points, sites;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      for (int k = 0; k < 8; ++k) {
        sites.emplace_back(i, j, k);
        points.push_back(sites.back() + V(uniform(random), uniform(random), uniform(random)));
      }
  const auto depth = [](const V& x) { return std::min(x.minCoeff(), (V(11, 11, 7) - x).minCoeff()); };
  auto layers = hmps::surface_layers(hmps::vectors(points), 1.0);
  EXPECT_EQ(layers.outermost, where<3>(sites, [&](const V& x) { return depth(x) < 0.5; }));
  EXPECT_EQ(layers.two_outermost, where<3>(sites, [&](const V& x) { return depth(x) < 1.5; }));
  // Fitted layers lie half a spacing below the surface, and a spacing apart.
  const hmps::Ball<double, 3> ball{V::Zero(), 6};
  const auto fitted = hmps::fit_particles(ball, hmps::Box<double, 3>{V(-6, -6, -6), V(6, 6, 6)}, 1.0);
  layers = hmps::surface_layers(hmps::vectors(fitted.positions), 1.0);
  EXPECT_EQ(layers.outermost, where<3>(fitted.positions, [&](const V& x) { return ball(x) > -1; }));
  EXPECT_EQ(layers.two_outermost, where<3>(fitted.positions, [&](const V& x) { return ball(x) > -2; }));
}

TEST(SurfaceLayers, DistinguishTouchingBodies) {
  std::vector<V> points;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) points.emplace_back(i, j, k);
  const auto same = [&](std::size_t i, std::size_t j) { return (points[i][0] < 3.5) == (points[j][0] < 3.5); };
  // One body of 8 x 4 x 4 has 6 x 2 x 2 sites within, two cubes have 2^3 each.
  EXPECT_EQ(hmps::surface_layers(hmps::vectors(points), 1.0).outermost.size(), 128u - 24u);
  const auto layers = hmps::surface_layers(hmps::vectors(points), 1.0, same);
  EXPECT_EQ(layers.outermost.size(), 128u - 16u);
  const auto backwards = hmps::surface_layers(hmps::vectors(points), 1.0, same, Backwards{});
  EXPECT_EQ(layers.outermost, backwards.outermost);
  EXPECT_EQ(layers.two_outermost, backwards.two_outermost);
}

TEST(SurfaceLayers, OfAreasAreFoundToo) {
  using P = hmps::Vector<double, 2>;
  const hmps::Ball<double, 2> disc{P::Zero(), 7.3};
  const auto points = hmps::fill_lattice(disc, hmps::Box<double, 2>{P(-8, -8), P(8, 8)}, 1.0);
  const auto layers = hmps::surface_layers(hmps::vectors(points), 1.0);
  EXPECT_EQ(layers.outermost, where<2>(points, [&](const P& x) {
              bool lacks = false;
              for (int c = 0; c < 2; ++c)
                for (const double step : {-1, 1}) lacks = lacks || disc(x + step * P::Unit(c)) >= 0;
              return lacks;
            }));
}

TEST(SurfaceLayers, RejectsInvalidSpacings) {
  const std::vector<V> points{V(0, 0, 0)}, none;
  EXPECT_THROW((void)hmps::surface_layers(hmps::vectors(points), 0), hmps::InputError);
  EXPECT_THROW((void)hmps::surface_layers(hmps::vectors(points), NAN), hmps::InputError);
  EXPECT_EQ(hmps::surface_layers(hmps::vectors(points), 1.0).outermost, Indices{0});
  EXPECT_TRUE(hmps::surface_layers(hmps::vectors(none), 1.0).outermost.empty());
}

TEST(SurfaceLayers, RefuseAnotherUnitAndAOneSidedPredicate) {
  std::vector<V> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(i % 10, i / 10 % 10, i / 100);
  for (const double spacing : {1e3, 1e-3})
    EXPECT_THROW((void)hmps::surface_layers(hmps::vectors(points), spacing), hmps::InputError) << spacing;
  const auto one_sided = [](std::size_t i, std::size_t j) { return i < j; };
  EXPECT_THROW((void)hmps::surface_layers(hmps::vectors(points), 1.0, one_sided), hmps::InputError);
  const auto never = [](std::size_t, std::size_t) { return false; };
  EXPECT_THROW((void)hmps::surface_layers(hmps::vectors(points), 1.0, never), hmps::InputError);
}

TEST(SurfaceLayers, OfOneBodyOfSeveral) {
  std::vector<V> points;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) points.emplace_back(i, j, k);
  const hmps::ParticleSet left(points.size(), [&](std::size_t i) { return points[i][0] < 5.5; });
  const auto same = [&](std::size_t i, std::size_t j) { return left(i) == left(j); };
  const auto both = hmps::surface_layers(hmps::vectors(points), 1.0, same);
  const std::vector<V> alone(points.begin(), points.begin() + 216);
  const auto of_left = both.of(left), expected = hmps::surface_layers(hmps::vectors(alone), 1.0);
  EXPECT_EQ(of_left.outermost, expected.outermost);
  EXPECT_EQ(of_left.two_outermost, expected.two_outermost);
  EXPECT_EQ(both.of(~left).outermost.size(), of_left.outermost.size());
  EXPECT_THROW((void)both.of(hmps::ParticleSet(216, [](std::size_t) { return true; })), hmps::InputError);
}

}  // namespace surface_layers_test
