// SPDX-License-Identifier: MIT
#include "hmps/shapes/redistanced.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

#include "hmps/particles/fitted.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/implicit.hpp"

namespace redistanced_test {

using V = hmps::Vector<double, 3>;
using Box = hmps::Box<double, 3>;
const Box around{V::Constant(-1.5), V::Constant(1.5)};

TEST(Redistanced, HandlesNonDistanceFunctions) {
  const hmps::Ball<double, 3> ball{V(0.1, -0.2, 0.05), 1};
  const auto steep = [&](const V& x) { return 40 * ball(x) * (2 + x[0]); };
  const auto distance = redistanced(steep, around, 0.05);
  static_assert(hmps::Shape<decltype(distance), double, 3>);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  for (int k = 0; k < 300; ++k) {
    const V x(uniform(random), uniform(random), uniform(random));
    EXPECT_NEAR(distance(x), ball(x), 0.002) << x.transpose();
  }
  EXPECT_TRUE(std::isnan(distance(V(std::numeric_limits<double>::quiet_NaN(), 0, 0))));
}

// By the minimum of the two distances, the middle of the joint lies 0.2 below the surface of either box.
TEST(Redistanced, FindsTheInsideOfUnitedParts) {
  const auto united = hmps::unite(Box{V(-1, -0.5, -0.5), V(0.2, 0.5, 0.5)}, Box{V(-0.2, -0.5, -0.5), V(1, 0.5, 0.5)});
  const auto distance = redistanced(united, around, 0.05);
  EXPECT_NEAR(united(V(0, 0, 0)), -0.2, 1e-12);
  EXPECT_NEAR(distance(V(0, 0, 0)), -0.5, 1e-4);
  EXPECT_NEAR(distance(V(0.1, 0.3, 0)), -0.2, 1e-4);
  EXPECT_NEAR(distance(V(0, 0, 0.7)), 0.2, 1e-4);
}

// Two plates at a right angle, and a fin of a third of a cell between the nodes of the cells. The sign used to be that
// of the shape, and the distance that to the surface of the plates, so that it jumped by up to the length of the fin.
TEST(Redistanced, DoesNotJumpAtFinsThinnerThanACell) {
  const auto plates = hmps::unite(Box{V(-1, -1, -0.2), V(1, 1, 0.2)}, Box{V(-0.2, -1, -0.2), V(0.2, 1, 1)});
  const auto shape = hmps::unite(plates, Box{V(-1.2, -0.01, 0.2), V(1.2, 0.01, 1.2)});
  const auto distance = redistanced(shape, around, 0.06);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.4, 1.4), step(-0.03, 0.03);
  for (int k = 0; k < 20000; ++k) {
    const V x(uniform(random), 0.1 * uniform(random), uniform(random));
    const V y = x + V(step(random), step(random), step(random));
    EXPECT_LE(std::abs(distance(x) - distance(y)), (x - y).norm() * (1 + 1e-9)) << x.transpose();
  }
}

TEST(Redistanced, IsInsideWhereItsSurfaceWindsAround) {
  const auto shape =
      hmps::subtract(hmps::unite(Box{V(-1, -1, -0.3), V(1, 1, 0.2)}, Box{V(-0.3, -0.9, 0), V(0.3, 1, 1)}),
                     hmps::Ball<double, 3>{V(0.2, 0.1, 0.3), 0.45});
  const double cell = 0.11;
  const auto distance = redistanced(shape, around, cell);
  const hmps::TriangleTree exact(isosurface(shape, around, cell), std::numeric_limits<double>::infinity());
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1.2, 1.2);
  int tried = 0;
  for (int k = 0; k < 4000; ++k) {
    const V x(uniform(random), uniform(random), uniform(random));
    if (exact.distance(x) > cell) continue;  // close to corners and edges
    EXPECT_EQ(distance(x) < 0, exact.winding_number(x) > 0.5) << x.transpose();
    ++tried;
  }
  EXPECT_GT(tried, 800);
}

TEST(Redistanced, EndsAtTheFacesOfTheBox) {
  const hmps::Ball<double, 3> ball{V::Zero(), 1};
  const auto upper = redistanced(ball, Box{V(-1.5, -1.5, 0), V::Constant(1.5)}, 0.05);
  EXPECT_NEAR(upper(V(0, 0, 0.1)), -0.1, 1e-4);
  EXPECT_NEAR(upper(V(0, 0, -0.1)), 0.1, 1e-4);
  EXPECT_NEAR(upper(V(0, 0, 0.8)), -0.2, 2e-3);
}

// A plate whose width grows along x. In place of a distance, the shape has a multiple of |y| less the half width.
TEST(Redistanced, CanFitAnyShape) {
  const auto plate = [](const V& x) {
    const double side = std::abs(x[1]) - 0.5 - 0.2 * (x[0] + 1) * (x[0] + 1) / 4;
    return std::max({std::abs(x[2]) - 0.15, 8 * side, std::abs(x[0]) - 1});
  };
  const double l0 = 0.15, exact = 0.3 * (2 * 2 * 0.5 + 2 * 0.2 * 8 / 12);
  const auto distance = redistanced(plate, around, l0 / 6);
  const auto fitted = hmps::fit_particles(distance, around, l0);
  double sum = 0;
  for (const double volume : fitted.volumes) sum += volume;
  EXPECT_NEAR(sum, exact, 0.01 * exact);
  EXPECT_LT(fitted.largest_deviation, 0.05 * l0);
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const V& x = fitted.positions[i];
    EXPECT_EQ(fitted.layers[i], 2);
    EXPECT_NEAR(distance(x), -l0 / 2, 0.05 * l0);
    const bool along_rim = plate({x[0], x[1], 0}) > -1.1 * l0;
    EXPECT_TRUE(along_rim || std::abs(std::abs(x[2]) - l0 / 2) < 0.02 * l0) << x.transpose();
  }
}

TEST(Redistanced, CanBeCalledAfterAMove) {
  const hmps::Box<double, 3> box{V(-1, -1, -1), V(1, 1, 1)};
  auto first = redistanced(hmps::Ball<double, 3>{.radius = 0.5}, box, 0.25);
  const double before = first(V(0, 0, 0));
  const auto second = std::move(first);
  EXPECT_EQ(second(V(0, 0, 0)), before);
  EXPECT_EQ(first(V(0, 0, 0)), before);  // NOLINT(bugprone-use-after-move)
}

}  // namespace redistanced_test
