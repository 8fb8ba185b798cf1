// SPDX-License-Identifier: MIT
#include "hmps/shapes/detail/surface_edges.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace surface_edges_test {

using namespace hmps::detail;
using Dropped = std::vector<std::size_t>;

/// The four faces of a tetrahedron, counter-clockwise seen from outside.
const Triangles tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

TEST(SurfaceEdges, CountsTheTrianglesOfEachEdge) {
  const auto edges = edge_uses(tetrahedron);
  ASSERT_EQ(edges.size(), 6u);
  EXPECT_EQ(count_unbalanced(edges), 0u);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    EXPECT_EQ(edges[k].uses(), 2);
    EXPECT_LT(edges[k].low, edges[k].high);
  }
  EXPECT_EQ(count_unbalanced(edge_uses({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}})), 3u);
  EXPECT_TRUE(edge_uses({}).empty());
  for (const auto& edge : edges) EXPECT_FALSE(edge.folded());
  for (const auto& edge : edge_uses({{4, 7, 5}, {7, 4, 5}})) EXPECT_TRUE(edge.folded());
  for (const auto& edge : edge_uses({{4, 7, 5}, {4, 7, 5}})) EXPECT_FALSE(edge.folded());
}

TEST(SurfaceEdges, FindsRepeatsInTheSameSenseOnly) {
  auto twice = tetrahedron;
  twice.push_back({3, 0, 1});  // {0, 1, 3}
  twice.push_back({0, 3, 1});  // its back
  EXPECT_EQ(repeated_triangles(twice), Dropped{4});
  EXPECT_EQ(without(twice, {1, 4}).size(), 4u);
  EXPECT_EQ(without(twice, {1, 4})[1], (std::array<hmps::Index, 3>{1, 2, 3}));
  EXPECT_TRUE(repeated_triangles(tetrahedron).empty());
}

TEST(SurfaceEdges, RepeatsThatCloseASurfaceAreNeeded) {
  // Two tetrahedra on one base, one within the other.
  Triangles within = tetrahedron;
  within.insert(within.end(), {{0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}});
  EXPECT_EQ(repeated_triangles(within), Dropped{4});
  EXPECT_TRUE(needless_repeats(within).empty());
  Triangles twice = tetrahedron;
  twice.insert(twice.end(), tetrahedron.begin(), tetrahedron.end());
  EXPECT_EQ(needless_repeats(twice), (Dropped{4, 5, 6, 7}));
}

TEST(SurfaceEdges, PartsOfBothSidesAreFoundWhole) {
  Triangles mesh = tetrahedron;
  EXPECT_TRUE(double_sided(mesh, 8).empty());
  for (const auto& [a, b, c] : tetrahedron) {
    mesh.push_back({a + 4, b + 4, c + 4});
    mesh.push_back({b + 4, a + 4, c + 4});
  }
  EXPECT_EQ(double_sided(mesh, 8), (Dropped{4, 5, 6, 7, 8, 9, 10, 11}));
}

}  // namespace surface_edges_test
