// SPDX-License-Identifier: MIT
#include "hmps/shapes/surface_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

#include "../../reference/message_of.hpp"
#include "surfaces.hpp"

namespace surface_file_test {

using hmps::Vector;
using namespace hmps_test;

template <class S>
class SurfaceFile : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SurfaceFile, Scalars);

template <class S>
std::string ascii_stl(const hmps::SurfaceMesh<S>& mesh) {
  std::ostringstream text;
  text.precision(17);
  text << "solid thing\r\n";
  for (const auto& t : mesh.triangles) {
    text << "  facet normal 0 0 0\n    outer loop\n";
    for (const hmps::Index v : t) text << "      VERTEX " << mesh.vertices[v].transpose() << "\r\n";
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid thing\n";
  return text.str();
}

template <class S>
std::string binary_stl(const hmps::SurfaceMesh<S>& mesh, std::string header) {
  header.resize(80, ' ');
  const auto put = [&](const auto& value) { header.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    put(std::array<float, 3>{});
    for (const hmps::Index v : t)
      for (int c = 0; c < 3; ++c) put(static_cast<float>(mesh.vertices[v][c]));
    put(std::uint16_t{0});
  }
  return header;
}

template <class S>
std::string obj(const hmps::SurfaceMesh<S>& mesh) {
  std::ostringstream text;
  text.precision(17);
  text << "# made by a test\nmtllib none.mtl\no thing\n";
  for (const auto& v : mesh.vertices) text << "v " << v.transpose() << "\n";
  text << "vn 0 0 1\n";
  for (const auto& t : mesh.triangles) text << "f " << t[0] + 1 << "//1 " << t[1] + 1 << "/2/1 " << t[2] + 1 << "\n";
  return text.str();
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\n  lacks: " << part;
}

TYPED_TEST(SurfaceFile, ReadsWhatWasWrittenInEveryFormat) {
  using S = TypeParam;
  const auto torus = torus_surface<S>(S(2), S(0.5), 12, 8);
  // Binary STL holds floats.
  const double relative = 32 * std::numeric_limits<float>::epsilon();
  for (const auto& [ending, bytes] :
       {std::pair{".stl", ascii_stl(torus)}, std::pair{".STL", binary_stl(torus, "binary")},
        std::pair{".stl", binary_stl(torus, "solid but binary")}, std::pair{".obj", obj(torus)}}) {
    const TemporaryFile file(ending, bytes);
    const auto mesh = hmps::read_surface<S>(file.path());
    EXPECT_EQ(mesh.vertices.size(), torus.vertices.size());
    EXPECT_EQ(mesh.triangles.size(), torus.triangles.size());
    EXPECT_EQ(mesh.source, file.path());
    EXPECT_NEAR(hmps::volume(mesh), hmps::volume(torus), relative * hmps::volume(torus));
    const auto scaled = hmps::read_surface<S>(file.path(), 1e-3);
    EXPECT_NEAR(hmps::volume(scaled), 1e-9 * hmps::volume(torus), relative * 1e-9 * hmps::volume(torus));
  }
}

TYPED_TEST(SurfaceFile, ObjTakesPolygonsAndNegativeIndices) {
  using S = TypeParam;
  const TemporaryFile file(".obj",
                           "v 0 0 0\nv 1 0 0 # a comment\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                           "f 4 3 2 1\nf -4 -3 -2 -1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const auto mesh = hmps::read_obj<S>(file.path());
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(hmps::volume(mesh), 1, 8 * std::numeric_limits<S>::epsilon());
}

/// `text` with every `from` replaced by `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

TYPED_TEST(SurfaceFile, AsciiStlIsReadAsProgramsWriteIt) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(0, 0, 0), V(1, 1, 1));
  const std::string usual = ascii_stl(box);
  const std::string mark = "\xEF\xBB\xBF";
  const std::string unix_ends = replaced(usual, "\r\n", "\n");
  const std::string two = replaced(ascii_stl(box_surface<S>(V(2, 0, 0), V(3, 1, 1))), "thing", "other");
  for (const auto& [bytes, solids] :
       {std::pair{replaced(unix_ends, "solid thing", "solid"), 1}, std::pair{"\r\n \n" + usual, 1},
        std::pair{mark + usual, 1}, std::pair{mark + "\n\nSOLID\n" + unix_ends.substr(unix_ends.find('\n') + 1), 1},
        std::pair{replaced(replaced(usual, "endsolid", "end solid"), "endfacet", "end facet"), 1},
        std::pair{replaced(unix_ends, "\n", "\r"), 1}, std::pair{usual + "\n" + two, 2},
        std::pair{replaced(usual, "thing", "caf\xE9 \x80"), 1},
        std::pair{usual.substr(0, usual.rfind("endsolid")), 1}}) {
    const TemporaryFile file(".stl", bytes);
    const auto mesh = hmps::read_surface<S>(file.path());
    EXPECT_EQ(mesh.triangles.size(), 12u * static_cast<std::size_t>(solids)) << bytes.substr(0, 60);
    EXPECT_NEAR(hmps::volume(mesh), solids, 1e-6);
  }
}

TYPED_TEST(SurfaceFile, BinaryStlIsReadWithItsTailButNotWithoutTriangles) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(0, 0, 0), V(1, 1, 1));
  std::string zeros = "solid SolidWorks";
  zeros.resize(80, '\0');
  for (const std::string& bytes :
       {binary_stl(box, "solid SolidWorks") + "\n\n", binary_stl(box, zeros) + std::string(49, 'x'),
        binary_stl(box, "binary") + std::string(512, '\0')}) {
    const TemporaryFile file(".stl", bytes);
    EXPECT_EQ(hmps::read_surface<S>(file.path()).triangles.size(), 12u);
  }
  std::string short_count = binary_stl(box, "binary");
  short_count[80] = 10;
  const TemporaryFile file(".stl", short_count);
  expect_contains(message_of([&] { (void)hmps::read_surface<S>(file.path()); }),
                  "announces 10 triangles, which end at byte 584, but 100 bytes follow, enough for 2 more");
}

TYPED_TEST(SurfaceFile, ObjLinesMayContinueAndFacesMayComeFirst) {
  using S = TypeParam;
  const std::string faces = "f 4 3 \\\n 2 1\nf 5 6 7\\ \r\n8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7 # \\\nf 4 1 5 8\n";
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 \\\n 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  for (const std::string& bytes : {points + faces, faces + points, "\xEF\xBB\xBF" + points + faces}) {
    const TemporaryFile file(".obj", bytes);
    const auto mesh = hmps::read_surface<S>(file.path());
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(hmps::volume(mesh), 1, 8 * std::numeric_limits<S>::epsilon());
  }
  // Lines are counted as they stand in the file.
  const TemporaryFile beyond(".obj", points + "f 1 2 \\\n 3\nf 1 2 9\n");
  expect_contains(message_of([&] { (void)hmps::read_surface<S>(beyond.path()); }),
                  "line 12: a face names vertex 9 but 8 vertices are in the file");
  const TemporaryFile last(".obj", points + "f 1 2 3 \\");
  expect_contains(message_of([&] { (void)hmps::read_surface<S>(last.path()); }), "is open at 3 edges");
}

TYPED_TEST(SurfaceFile, DoubledFacesGiveTheBodyOrAnError) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(0, 0, 0), V(1, 1, 1));
  auto once = box;
  once.triangles.push_back(box.triangles.back());
  for (const auto& mesh : {once, joined(box, box)})
    for (const auto& [ending, bytes] : {std::pair{".stl", ascii_stl(mesh)}, std::pair{".obj", obj(mesh)}}) {
      const TemporaryFile file(ending, bytes);
      const auto read = hmps::read_surface<S>(file.path());
      EXPECT_EQ(read.triangles.size(), 12u);
      EXPECT_NEAR(hmps::volume(read), 1, 8 * std::numeric_limits<S>::epsilon());
    }
  const TemporaryFile file(".stl", binary_stl(joined(box, reversed(box)), "binary"));
  expect_contains(message_of([&] { (void)hmps::read_surface<S>(file.path()); }), "a part of 24 triangles");
}

TYPED_TEST(SurfaceFile, OpenSurfacesAreReadOnRequest) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  auto open = box_surface<S>(V(0, 0, 0), V(1, 1, 1));
  open.triangles.pop_back();
  const std::string bytes = ascii_stl(open);
  const TemporaryFile file(".stl", bytes);
  expect_contains(message_of([&] { (void)hmps::read_surface<S>(file.path()); }), "read it with .closed = false");
  const auto mesh = hmps::read_surface<S>(file.path(), {.scale = 1e-3, .closed = false});
  EXPECT_EQ(mesh.triangles.size(), 11u);
  EXPECT_EQ(hmps::bounds(mesh).upper, V(V::Constant(static_cast<S>(1e-3))));
  // A file that is cut off between two facets looks like an open surface.
  const TemporaryFile cut(".stl", bytes.substr(0, bytes.rfind("endsolid")));
  expect_contains(message_of([&] { (void)hmps::read_surface<S>(cut.path(), {.closed = false}); }),
                  "without 'endsolid'");
  expect_contains(message_of([&] { (void)hmps::read_surface<S>(file.path(), {.scale = 0}); }), "a scale of 0");
}

TYPED_TEST(SurfaceFile, NamesFileLineAndCauseOfWhatIsWrong) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto message = [](const char* ending, const std::string& bytes) {
    const TemporaryFile file(ending, bytes);
    const std::string text = message_of([&] { (void)hmps::read_surface<S>(file.path()); });
    EXPECT_NE(text.find(file.path()), std::string::npos) << text;
    return text;
  };
  expect_contains(message(".obj", "v 0 0 0\nv 1 x 0\n"), "line 2: 'x' is not a finite number");
  expect_contains(message(".obj", "v 0 0\n"), "line 1: a vertex has only 2 coordinates");
  expect_contains(message(".obj", "v 0 0 inf\n"), "line 1: 'inf' is not a finite number");
  expect_contains(message(".obj", "v 0 0 0\nf 1 2 3\n"), "line 2: a face names vertex 2 but 1 vertices are in");
  expect_contains(message(".obj", "v 0 0 0\nf 1 1\n"), "line 2: a face has 2 corners");
  expect_contains(message(".obj", "v 0 0 0\nf 1 a 1\n"), "line 2: 'a' is not a corner");
  expect_contains(message(".obj", "v 0 0 0\nf 0 1 1\n"), "line 2: a face names vertex 0");
  expect_contains(message(".obj", ""), "has no vertices");
  expect_contains(message(".stl", "solid a\nfacet normal 0 0 1\nvertex 1 2\n"), "line 3: a vertex has only 2");
  expect_contains(message(".stl", "solid a\nfacet\nvertex 1 2 3\nendfacet\n"), "line 4: a facet ends after 1 vertices");
  expect_contains(message(".stl", "solid a\nvertex 1 2 3\n"), "line 2: 'vertex' outside of a facet");
  expect_contains(message(".stl", "solid a\nfacet\nvertex 1 2 3\n"), "cut off");
  expect_contains(message(".stl", "solid a\nfacets\n"), "line 2: 'facets' is not a keyword");
  expect_contains(message(".stl", "PK"), "is not an STL file");
  expect_contains(message(".stl", "solid a\nfa\xFF\x1b[2Jcet\n"), "line 2: 'fa\\xff\\x1b[2jcet' is not a keyword");
  expect_contains(message(".obj", "v 0 0 \x01\n"), "line 1: '\\x01' is not a finite number");
  expect_contains(message(".obj", "v 0 0 0\nf 1 1 \xC3\n"), "line 2: '\\xc3' is not a corner");
  expect_contains(message(".obj", "\xFF\xFEv"), "UTF-16");
  expect_contains(message(".obj", "f 1 2 9999999999\n"), "line 1: a face names vertex 9999999999, more than");
  const auto box = box_surface<S>(V(0, 0, 0), V(1, 1, 1));
  const std::string whole = binary_stl(box, "binary");
  expect_contains(message(".stl", whole.substr(0, whole.size() - 7)),
                  "ends at byte 677 but announces 12 triangles in 684 bytes");
  auto nan = box;
  nan.vertices[0][0] = std::numeric_limits<S>::quiet_NaN();
  expect_contains(message(".stl", binary_stl(nan, "binary")), "byte 96: a coordinate of triangle 0");
  auto open = box;
  open.triangles.pop_back();
  expect_contains(message(".stl", ascii_stl(open)), "is open at 3 edges");
  expect_contains(message(".ply", ""), "neither .stl nor .obj");
  expect_contains(message(".vtp", ""), "ParaView");
  expect_contains(message_of([] { (void)hmps::read_obj<S>("no/such/file.obj"); }), "cannot open no/such/file.obj");
  EXPECT_THROW((void)hmps::read_stl<S>(std::filesystem::temp_directory_path().string()), hmps::InputError);
}

}  // namespace surface_file_test
