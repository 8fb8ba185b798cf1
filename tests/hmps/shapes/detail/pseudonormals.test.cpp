// SPDX-License-Identifier: MIT
#include "hmps/shapes/detail/pseudonormals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hmps/shapes/surface_mesh.hpp"

namespace pseudonormals_test {

using V = hmps::Vector<double, 3>;

/// The tetrahedron in the corner of the first octant. The faces there point along the negative axes.
hmps::SurfaceMesh<double> tetrahedron() {
  return {{V(0, 0, 0), V(1, 0, 0), V(0, 2, 0), V(0, 0, 3)}, {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
}

TEST(Pseudonormals, FacesEdgesAndCornersOfATetrahedron) {
  const hmps::detail::Pseudonormals<double> normals(tetrahedron());
  EXPECT_EQ(normals(0, 6), V(0, 0, -1));
  EXPECT_EQ(normals(1, 6), V(-1, 0, 0));
  EXPECT_EQ(normals(0, 3), V(-1, 0, -1));  // the edge from corner 0 to 2, with the second triangle
  EXPECT_EQ(normals(1, 5), V(-1, 0, -1));  // the same edge seen from there
  EXPECT_LT((normals(3, 6) - V(6, 3, 2) / 7).norm(), 1e-15);
  EXPECT_LT((normals(0, 4) - V(6, 3, -5) / 7).norm(), 1e-15);
  // Three right angles meet at corner 0, whichever triangle is asked.
  const V origin = V::Constant(-std::numbers::pi / 2);
  for (const std::size_t t : {0u, 1u, 2u}) EXPECT_LT((normals(t, 0) - origin).norm(), 1e-15);
  // At corner 1 two right-angled faces have the angles atan(2) and atan(3).
  const double third = std::acos(1 / std::sqrt(50.0));
  EXPECT_LT((normals(3, 0) - (V(0, 0, -std::atan(2)) + V(0, -std::atan(3), 0) + third * V(6, 3, 2) / 7)).norm(), 1e-14);
}

TEST(Pseudonormals, FacesWithoutAreaDoNotCount) {
  auto mesh = tetrahedron();
  mesh.vertices.push_back(V(0.5, 0, 0));  // on the edge from corner 0 to 1, which becomes a face without area
  mesh.triangles = {{0, 2, 4}, {4, 2, 1}, {0, 3, 2}, {0, 1, 3}, {0, 4, 1}, {1, 2, 3}};
  const hmps::detail::Pseudonormals<double> normals(mesh);
  EXPECT_EQ(normals(4, 6), V(0, 0, 0));
  EXPECT_EQ(normals(4, 3), V(0, 0, -1));
  EXPECT_EQ(normals(4, 5), V(0, -1, 0));
}

TEST(Pseudonormals, AnEdgeOfOneTriangleHasItsNormal) {
  const hmps::SurfaceMesh<float> one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const hmps::detail::Pseudonormals<double> normals(one);
  EXPECT_EQ(normals(0, 3), V(0, 0, 2));
}

}  // namespace pseudonormals_test
