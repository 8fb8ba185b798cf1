// SPDX-License-Identifier: MIT
#include "hmps/shapes/obj_file.hpp"

#include <gtest/gtest.h>

namespace obj_file_test {

using Triangle = std::array<hmps::Index, 3>;

TEST(ObjFile, NumbersCornersForwardsAndBackwards) {
  hmps::SurfaceMesh<double> mesh;
  hmps::detail::ObjParser<double>(mesh, 2)("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -1/1 -2//2 -3\nv 0 0 1\nf 1 2 3 4");
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[3], (hmps::Vector<double, 3>(0, 0, 2)));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[1], (Triangle{2, 1, 0}));
  EXPECT_EQ(mesh.triangles[2], (Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[3], (Triangle{0, 2, 3}));
}

TEST(ObjFile, NegativeNumbersCountOnlyEarlierVertices) {
  hmps::SurfaceMesh<double> mesh;
  EXPECT_THROW(hmps::detail::ObjParser<double>(mesh, 1)("f -1 -2 -3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"), hmps::InputError);
}

}  // namespace obj_file_test
