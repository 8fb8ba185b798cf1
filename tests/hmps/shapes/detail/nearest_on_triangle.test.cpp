// SPDX-License-Identifier: MIT
#include "hmps/shapes/detail/nearest_on_triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "../random_points.hpp"

namespace nearest_on_triangle_test {

using V = hmps::Vector<double, 3>;
using hmps_test::random_points;

/// The distance to a triangle by halving it: an upper bound that exceeds the distance by 2^-levels of its size at most.
double sampled_distance(const std::array<V, 3>& t, const V& x, int n) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      least = std::min(least, ((t[0] * i + t[1] * j + t[2] * (n - i - j)) / n - x).norm());
  return least;
}

TEST(NearestOnTriangle, FindsTheNearestPoint) {
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

TEST(NearestOnTriangle, ReturnsTheNearestFeature) {
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

TEST(NearestOnTriangle, OfFlatTrianglesIsThatOfTheirEdges) {
  // A segment from two coincident corners to the third.
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
}

}  // namespace nearest_on_triangle_test
