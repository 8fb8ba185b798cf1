// SPDX-License-Identifier: MIT
#include "hmps/shapes/triangle_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "random_points.hpp"
#include "surfaces.hpp"

namespace triangle_tree_test {

using V = hmps::Vector<double, 3>;
using namespace hmps_test;

TEST(TriangleTree, MayHoldOneFlatTriangle) {
  // The triangle used to be skipped, so that the distance was infinite.
  const hmps::SurfaceMesh<double> sliver{{V(0, 0, 0), V(0, 0, 0), V(1, 0, 0)}, {{0, 1, 2}}};
  EXPECT_EQ(hmps::TriangleTree(sliver).distance(V(0.5, 1, 0)), 1);
}

TEST(TriangleTree, DistanceIsThatOfAllTriangles) {
  const auto torus = torus_surface<double>(2, 0.5, 40, 24);
  const hmps::TriangleTree tree(torus);
  EXPECT_EQ(tree.size(), torus.triangles.size());
  for (const V& x : random_points(200, 4)) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& t : torus.triangles)
      least = std::min(least, (hmps::detail::nearest_on_triangle(
                                   {torus.vertices[t[0]], torus.vertices[t[1]], torus.vertices[t[2]]}, x)
                                   .place -
                               x)
                                  .squaredNorm());
    EXPECT_EQ(tree.distance(x), std::sqrt(least));
    const auto nearest = tree.nearest(x);
    EXPECT_EQ(nearest.distance, std::sqrt(least));
    EXPECT_EQ((nearest.point.place - x).norm(), std::sqrt(least));
    const auto& t = torus.triangles[nearest.triangle];
    EXPECT_EQ(
        hmps::detail::nearest_on_triangle({torus.vertices[t[0]], torus.vertices[t[1]], torus.vertices[t[2]]}, x).place,
        nearest.point.place);
  }
}

TEST(TriangleTree, WindsOnceAroundTheInside) {
  const auto torus = torus_surface<double>(2, 0.5, 40, 24);
  const hmps::TriangleTree tree(torus), exact(torus, std::numeric_limits<double>::infinity());
  for (const V& x : random_points(200, 3)) {
    const double whole = hmps::inside(torus, x) ? 1 : 0;
    EXPECT_NEAR(exact.winding_number(x), whole, 1e-12);
    // The terms left out are of the third order, 2^-3 of a group's share: far too little to matter at the limit of 1/2.
    EXPECT_NEAR(tree.winding_number(x), whole, 0.02);
  }
  EXPECT_NEAR(hmps::TriangleTree(reversed(torus)).winding_number(V(2, 0, 0)), -1, 0.02);
}

TEST(TriangleTree, ApproximatesBetterWithAccuracy) {
  auto open = sphere_surface<double>(V(0, 0, 0), 1, 3);
  std::erase_if(open.triangles, [&](const auto& t) { return open.vertices[t[0]][2] > 0.3; });
  const hmps::TriangleTree exact(open, std::numeric_limits<double>::infinity());
  const auto worst = [&](double accuracy) {
    const hmps::TriangleTree tree(open, accuracy);
    double result = 0;
    for (const V& x : random_points(200, 1.5))
      result = std::max(result, std::abs(tree.winding_number(x) - exact.winding_number(x)));
    return result;
  };
  // The first term that is left out falls as the cube of the accuracy: by 64 here, of which the test requires half.
  const double coarse = worst(2);
  EXPECT_GT(coarse, 0);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(worst(8), coarse / 32);
}

TEST(TriangleTree, RejectsInvalidSurfaces) {
  auto box = box_surface<double>(V(0, 0, 0), V(1, 1, 1));
  EXPECT_THROW((void)hmps::TriangleTree(box, 1), hmps::InputError);
  EXPECT_THROW((void)hmps::TriangleTree(box, std::numeric_limits<double>::quiet_NaN()), hmps::InputError);
  box.triangles.push_back({0, 1, 99});
  EXPECT_THROW((void)hmps::TriangleTree(box), hmps::InputError);
  EXPECT_THROW((void)hmps::TriangleTree(hmps::SurfaceMesh<double>{}), hmps::InputError);
}

}  // namespace triangle_tree_test
