// SPDX-License-Identifier: MIT
#include "hmps/shapes/surface_patch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "../../reference/message_of.hpp"
#include "hmps/shapes/surfaces.hpp"

namespace surface_patch_test {

using namespace hmps;
using V = Vector<double, 3>;

SurfaceMesh<double> brick() { return hmps_test::box_surface<double>(V(0, 0, 0), V(3, 2, 1)); }

double longest_edge(const SurfaceMesh<double>& mesh) {
  double longest = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
  return longest;
}

TEST(SurfacePatch, TakesTrianglesByDirectionOrPlace) {
  const auto mesh = brick();
  EXPECT_DOUBLE_EQ(area(mesh), 22);
  const auto top = surface_patch(mesh, [](const V&, const V& normal) { return normal[2] > 0.5; });
  EXPECT_EQ(top.triangles.size(), 2u);
  EXPECT_EQ(top.vertices.size(), 4u);
  EXPECT_DOUBLE_EQ(area(top), 6);
  for (const V& v : top.vertices) EXPECT_EQ(v[2], 1);
  const auto& t = top.triangles[0];
  EXPECT_GT(area_vector(top.vertices[t[0]], top.vertices[t[1]], top.vertices[t[2]])[2], 0);  // still seen from outside
  const auto left = surface_patch(mesh, [](const V& centre, const V&) { return centre[0] < 1e-9; });
  EXPECT_DOUBLE_EQ(area(left), 2);
  EXPECT_THROW((void)surface_patch(mesh, [](const V& centre, const V&) { return centre[0] > 4; }), InputError);
  SurfaceMesh<double> broken = mesh;
  broken.triangles[0][0] = 99;
  EXPECT_THROW((void)surface_patch(broken, [](const V&, const V&) { return true; }), InputError);
}

TEST(SurfacePatch, RefinedItIsTheSameSurfaceWithShortEdges) {
  for (const double longest : {1.5, 0.7, 0.31}) {
    const auto fine = refine(brick(), longest);
    EXPECT_LE(longest_edge(fine), longest);
    EXPECT_NO_THROW(require_closed(fine));
    EXPECT_NEAR(area(fine), 22, 1e-12);
    EXPECT_NEAR(volume(fine), 6, 1e-12);
    // Edges are halved, so that they do not become much shorter than necessary either.
    EXPECT_LT(static_cast<double>(fine.triangles.size()), 16 * 22 / (longest * longest));
  }
  const auto same = refine(brick(), 10);
  EXPECT_EQ(same.triangles, brick().triangles);
  // Also with uneven triangles that have one, two and three long edges.
  const auto torus = refine(hmps_test::torus_surface<double>(3, 1, 40, 5), 0.4);
  EXPECT_LE(longest_edge(torus), 0.4);
  EXPECT_NO_THROW(require_closed(torus));
  EXPECT_NEAR(volume(torus), volume(hmps_test::torus_surface<double>(3, 1, 40, 5)), 1e-10);
}

/// Edges of eight lengths are halved to exactly one, whose computed length depends on where the surface is.
template <class S>
std::size_t refined_triangles(double shift) {
  const S l0 = S(1e-3);
  const Vector<S, 3> lower = Vector<S, 3>::Constant(static_cast<S>(shift));
  const auto top = surface_patch(hmps_test::box_surface<S>(lower, lower + Vector<S, 3>::Constant(8 * l0)),
                                 [](const auto&, const auto& normal) { return normal[2] > S(0.5); });
  return refine(top, 1e-3 * std::sqrt(2.0)).triangles.size();
}
TEST(SurfacePatch, RefinesASurfaceAlikeWhereverItIs) {
  for (const double shift : {0.0, 1e-3, 1e-2, 5e-2, 0.3, 1.0}) {
    EXPECT_EQ(refined_triangles<double>(shift), 128u) << shift;
    EXPECT_EQ(refined_triangles<float>(shift), 128u) << shift;
  }
}

TEST(SurfacePatch, RejectsInvalidLengths) {
  for (const double longest : {0.0, -1.0, 1e-4}) EXPECT_THROW((void)refine(brick(), longest), InputError) << longest;
}

SurfaceMesh<double> triangle(const V& a, const V& b, const V& c) { return {{a, b, c}, {{0, 1, 2}}, "one triangle"}; }

TEST(SurfacePatch, CountsTrianglesBeforeItMakesThem) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(-20, 20);
  for (int trial = 0; trial < 300; ++trial) {
    const V a = V::Zero(), b(u(random), 0, 0), c(u(random), trial % 3 == 0 ? u(random) : 0.02 * u(random), 0);
    const auto fewest = detail::fewest_refined({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const auto made = static_cast<double>(refine(triangle(a, b, c), 1).triangles.size());
    EXPECT_LE(fewest, made);
    EXPECT_GE(fewest, made / 16) << b.transpose() << ", " << c.transpose();
  }
  EXPECT_EQ(detail::fewest_refined({1, 1, 1}), 1);
  EXPECT_EQ(detail::fewest_refined({4, 4, 4}), 16);
  // Slivers with a short edge, and with a corner on the middle of an edge.
  for (const double x : {0.0, 0.5}) {
    const auto sliver = triangle(V(0, 0, 0), V(1, 0, 0), V(x, 1e-9, 0));
    const std::string message = hmps_test::message_of([&] { (void)refine(sliver, 1e-7); });
    EXPECT_NE(message.find("e+1"), std::string::npos) << message;  // not 2e7, which is found by refining
    EXPECT_NE(message.find("remove long slivers"), std::string::npos) << message;
  }
  EXPECT_THROW((void)refine(triangle(V(0, 0, 0), V(1e200, 0, 0), V(0, 1e200, 0)), 1), InputError);
}

SurfaceMesh<double> inside_out() {
  SurfaceMesh<double> mesh = brick();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TEST(SurfacePatch, OfASurfaceThatIsInsideOutIsRefused) {
  const auto all = [](const V&, const V&) { return true; };
  EXPECT_NO_THROW((void)surface_patch(brick(), all));
  EXPECT_THROW((void)surface_patch(inside_out(), all), InputError);
}

TEST(SurfaceMeasures, RejectTrianglesOfMissingVertices) {
  SurfaceMesh<double> mesh = brick();
  mesh.triangles[3][1] = 99999;
  EXPECT_THROW((void)area(mesh), InputError);
  EXPECT_THROW((void)volume(mesh), InputError);
  EXPECT_THROW((void)inside(mesh, V(0, 0, 0)), InputError);
  EXPECT_THROW((void)inside(SurfaceMesh<double>{}, V(0, 0, 0)), InputError);
  EXPECT_THROW((void)inside(brick(), V(NAN, 0, 0)), InputError);
}

}  // namespace surface_patch_test
