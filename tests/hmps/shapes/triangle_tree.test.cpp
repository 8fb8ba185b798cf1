// SPDX-License-Identifier: MIT
#include "hmps/shapes/triangle_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include "surfaces.hpp"

namespace triangle_tree_test {

using V = hmps::Vector<double, 3>;
using namespace hmps_test;

std::vector<V> random_points(std::size_t n, double reach) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-reach, reach);
  std::vector<V> points(n);
  for (V& p : points) p = V(uniform(random), uniform(random), uniform(random));
  return points;
}

/// The distance to a triangle by halving it: an upper bound that exceeds the distance by 2^-levels of its size at most.
double sampled_distance(const std::array<V, 3>& t, const V& x, int n) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      least = std::min(least, ((t[0] * i + t[1] * j + t[2] * (n - i - j)) / n - x).norm());
  return least;
}

TEST(TriangleTree, NearestPointsOfATriangleAreNearest) {
  const auto points = random_points(300, 2);
  for (std::size_t k = 0; k + 3 < points.size(); k += 4) {
    const std::array<V, 3> t{points[k], points[k + 1], points[k + 2]};
    const V x = points[k + 3], nearest = hmps::detail::nearest_on_triangle(t, x).place;
    // Samples lie within size / n of any point of the triangle.
    const double slack = 2 * (t[1] - t[0]).norm() / 60 + 2 * (t[2] - t[0]).norm() / 60;
    EXPECT_LE((nearest - x).norm(), sampled_distance(t, x, 60) + 1e-12);
    EXPECT_GE((nearest - x).norm(), sampled_distance(t, x, 60) - slack);
  }
}

TEST(TriangleTree, NearestPointsKnowTheirPartOfATriangle) {
  const std::array<V, 3> t{V(0, 0, 0), V(4, 0, 0), V(0, 4, 0)};
  const auto part = [&](double x, double y) { return hmps::detail::nearest_on_triangle(t, V(x, y, 1)).part; };
  const auto of_edges = [&](double x, double y) { return hmps::detail::nearest_on_edges(t, V(x, y, 1)).part; };
  for (const auto& [x, y, expected] :
       {std::tuple{-1.0, -1.0, 0u}, {6.0, 1.0, 1u}, {1.0, 6.0, 2u}, {1.0, -1.0, 3u}, {3.0, 3.0, 4u}, {-1.0, 1.0, 5u}}) {
    EXPECT_EQ(part(x, y), expected);
    EXPECT_EQ(of_edges(x, y), expected);
  }
  EXPECT_EQ(part(1, 1), 6u);
}

TEST(TriangleTree, FlatTrianglesAreTheirEdges) {
  // From the place of two corners to the third.
  EXPECT_EQ((hmps::detail::nearest_on_triangle({V(0, 0, 0), V(0, 0, 0), V(1, 0, 0)}, V(0.5, 1, 0)).place - V(0.5, 0, 0))
                .norm(),
            0);
  const auto points = random_points(400, 2);
  for (std::size_t k = 0; k + 3 < points.size(); k += 4) {
    const V &a = points[k], &b = points[k + 1], &x = points[k + 3];
    const V between = a + std::abs(points[k + 2][0]) / 2 * (b - a);
    for (const std::array<V, 3>& ends :
         {std::array{a, b, a}, std::array{a, b, b}, std::array{a, b, between}, std::array{a, a, a}})
      for (const auto& [i, j, l] :
           {std::array{0u, 1u, 2u}, std::array{1u, 2u, 0u}, std::array{2u, 0u, 1u}, std::array{1u, 0u, 2u}}) {
        const bool point = ends[0] == ends[1];
        const V nearest = point ? a : V(a + hmps::detail::nearest_on_segment<double, 3>(a, b, x) * (b - a));
        const V found = hmps::detail::nearest_on_triangle({ends[i], ends[j], ends[l]}, x).place;
        // Distances of a few units; the nearest point itself is known to the root of the rounding only.
        EXPECT_NEAR((found - x).norm(), (nearest - x).norm(), 1e-14);
      }
  }
  // A tree of one such triangle: it was skipped, and the distance infinite.
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
    // What is left out is of the third order, 2^-3 of a group's share; far from what would move the limit at 1/2.
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
  // The first term that is left out falls as the cube of the accuracy: by 64 here, of which half is asked for.
  const double coarse = worst(2);
  EXPECT_GT(coarse, 0);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(worst(8), coarse / 32);
}

TEST(TriangleTree, RefusesWhatIsNoSurface) {
  auto box = box_surface<double>(V(0, 0, 0), V(1, 1, 1));
  EXPECT_THROW((void)hmps::TriangleTree(box, 1), hmps::InputError);
  EXPECT_THROW((void)hmps::TriangleTree(box, std::numeric_limits<double>::quiet_NaN()), hmps::InputError);
  box.triangles.push_back({0, 1, 99});
  EXPECT_THROW((void)hmps::TriangleTree(box), hmps::InputError);
  EXPECT_THROW((void)hmps::TriangleTree(hmps::SurfaceMesh<double>{}), hmps::InputError);
}

}  // namespace triangle_tree_test
