// SPDX-License-Identifier: MIT
#include "hmps/shapes/obj_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "../../reference/message_of.hpp"
#include "hmps/shapes/surface_patch.hpp"

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

/// Parses `text` and returns the surface.
hmps::SurfaceMesh<double> parsed(const std::string& text) {
  hmps::SurfaceMesh<double> mesh;
  mesh.source = "a.obj";
  hmps::detail::ObjParser<double>(mesh, 1e-3)(text);
  return mesh;
}

TEST(ObjFile, ConcaveFacesKeepTheirArea) {
  const std::string vertices =
      "v 0 0 5\nv 10 0 5\nv 10 4 5\nv 4 4 5\nv 4 10 5\nv 0 10 5\n"
      "v 0 0 0\nv 10 0 0\nv 10 4 0\nv 4 4 0\nv 4 10 0\nv 0 10 0\n";
  const std::string faces =
      "f 2 3 4 5 6 1\nf 12 11 10 9 8 7\n"
      "f 1 7 8 2\nf 2 8 9 3\nf 3 9 10 4\nf 4 10 11 5\nf 5 11 12 6\nf 6 12 7 1\n";
  for (const std::string& text : {vertices + faces, faces + vertices}) {
    const auto mesh = parsed(text);
    EXPECT_EQ(mesh.triangles.size(), 20u);
    EXPECT_NO_THROW(hmps::require_closed(mesh));
    EXPECT_NEAR(hmps::volume(mesh), 320e-9, 1e-20);
    EXPECT_NEAR(hmps::area(mesh), 2 * 64e-6 + 40 * 5e-6, 1e-17);
  }
}

TEST(ObjFile, NamesTheLineOfAFaceThatIsNone) {
  const std::string vertices = "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 0.5 0.5 0\nv 1 0 0\n";
  const auto message = [&](const std::string& face) {
    return hmps_test::message_of([&] { (void)parsed(vertices + "f 1 2 3\n" + face); });
  };
  EXPECT_NE(message("f 1 2 3 4").find("a.obj, line 9: the border of a face of 4 corners crosses itself"),
            std::string::npos);
  EXPECT_NE(message("f 1 5 7 4\nf 1 2 3\n").find("a.obj, line 9: a face of 4 corners encloses no area"),
            std::string::npos);
  EXPECT_EQ(message("f 1 6 5 2\n"), "") << "a face on a line, which closes a gap between edges";
  // Vertices that are no numbers are reported by the checks of the whole surface.
  EXPECT_EQ(message("v 1e308 0 0\nv -1e308 0 0\nv 0 1e308 0\nv 0 -1e308 0\nf 8 10 9 11\n"), "");
}

}  // namespace obj_file_test
