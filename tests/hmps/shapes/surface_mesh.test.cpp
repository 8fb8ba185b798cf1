// SPDX-License-Identifier: MIT
#include "hmps/shapes/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "../../reference/message_of.hpp"
#include "surfaces.hpp"

namespace surface_mesh_test {

using hmps::Vector;
using namespace hmps_test;

template <class S>
class SurfaceMesh : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SurfaceMesh, Scalars);

/// Every triangle with corners of its own, as STL has it.
template <class S>
hmps::SurfaceMesh<S> exploded(const hmps::SurfaceMesh<S>& mesh) {
  hmps::SurfaceMesh<S> result;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<hmps::Index>(result.vertices.size());
    for (const hmps::Index v : t) result.vertices.push_back(mesh.vertices[v]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

TYPED_TEST(SurfaceMesh, HasVolumeAndBounds) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(10, -1, 0), V(12, 2, 4));
  EXPECT_NEAR(hmps::volume(box), 24, 24 * 8 * std::numeric_limits<S>::epsilon());
  EXPECT_NEAR(hmps::volume(reversed(box)), -24, 24 * 8 * std::numeric_limits<S>::epsilon());
  EXPECT_EQ(hmps::bounds(box).lower, V(10, -1, 0));
  EXPECT_EQ(hmps::bounds(box).upper, V(12, 2, 4));
  // Inscribed, so smaller than the ball by the order of the squared edge: (1.05 / 2^3)^2 / 2.
  const double ball = 4.0 / 3.0 * std::numbers::pi;
  const double sphere = hmps::volume(sphere_surface<S>(V(0, 0, 0), S(1), 3));
  EXPECT_LT(sphere, ball);
  EXPECT_GT(sphere, ball * (1 - 0.01));
}

TYPED_TEST(SurfaceMesh, ClosedSurfacesPass) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  EXPECT_NO_THROW(hmps::require_closed(box_surface<S>(V(0, 0, 0), V(1, 1, 1))));
  EXPECT_NO_THROW(hmps::require_closed(sphere_surface<S>(V(0, 0, 0), S(1), 2)));
  EXPECT_NO_THROW(hmps::require_closed(torus_surface<S>(S(2), S(0.5), 12, 8)));
  // Two boxes that share an edge, along which four triangles meet.
  const auto two = joined(box_surface<S>(V(0, 0, 0), V(1, 1, 1)), box_surface<S>(V(1, 1, 0), V(2, 2, 1)));
  EXPECT_NO_THROW(hmps::require_closed(hmps::weld(two)));
}

TYPED_TEST(SurfaceMesh, WeldingJoinsCornersAndDropsNeedles) {
  using S = TypeParam;
  const auto torus = torus_surface<S>(S(2), S(0.5), 12, 8);
  const auto loose = exploded(torus);
  EXPECT_NE(message_of([&] { hmps::require_closed(loose); }).find("open"), std::string::npos);
  auto welded = hmps::weld(loose);
  EXPECT_EQ(welded.vertices.size(), torus.vertices.size());
  EXPECT_EQ(welded.triangles.size(), torus.triangles.size());
  EXPECT_NO_THROW(hmps::require_closed(welded));
  // Cut the first triangle at a point that almost coincides with its first corner: into two needles and itself.
  auto needles = torus;
  const auto [a, b, c] = needles.triangles[0];
  const auto p = static_cast<hmps::Index>(needles.vertices.size());
  needles.vertices.push_back(needles.vertices[a] + S(1e-6) * (needles.vertices[b] - needles.vertices[a]));
  needles.triangles[0] = {p, b, c};
  needles.triangles.push_back({a, b, p});
  needles.triangles.push_back({a, p, c});
  welded = hmps::weld(needles);
  EXPECT_EQ(welded.triangles.size(), torus.triangles.size());
  EXPECT_NO_THROW(hmps::require_closed(welded));
  EXPECT_THROW((void)hmps::weld(torus, -1), hmps::InputError);
}

TYPED_TEST(SurfaceMesh, OpenTurnedAndBrokenSurfacesAreNamed) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(0, 0, 0), V(2, 2, 2));
  auto open = box;
  open.source = "box.stl";
  open.triangles.pop_back();
  const std::string text = message_of([&] { hmps::require_closed(open); });
  EXPECT_NE(text.find("box.stl is open at 3 edges"), std::string::npos) << text;
  EXPECT_NE(text.find("fill its holes"), std::string::npos) << text;
  auto turned = box;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_NE(message_of([&] { hmps::require_closed(turned); }).find("opposite orientation at 3 edges"),
            std::string::npos);
  auto degenerate = box;
  degenerate.triangles.push_back({1, 1, 2});
  EXPECT_NE(message_of([&] { hmps::require_closed(degenerate); }).find("names vertex 1 twice"), std::string::npos);
  auto beyond = box;
  beyond.triangles.push_back({1, 99, 2});
  EXPECT_NE(message_of([&] { hmps::require_closed(beyond); }).find("names vertex 99"), std::string::npos);
  EXPECT_NE(message_of([&] { (void)hmps::weld(beyond); }).find("names vertex 99"), std::string::npos);
  auto nan = box;
  nan.vertices[3][1] = std::numeric_limits<S>::quiet_NaN();
  EXPECT_NE(message_of([&] { hmps::require_closed(nan); }).find("vertex 3"), std::string::npos);
  EXPECT_THROW(hmps::require_closed(hmps::SurfaceMesh<S>{}), hmps::InputError);
  auto bare = box;
  bare.triangles.clear();
  EXPECT_THROW(hmps::require_closed(bare), hmps::InputError);
}

TYPED_TEST(SurfaceMesh, NamesDuplicateTriangles) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(0, 0, 0), V(2, 2, 2));
  const auto message = [](const auto& mesh) { return message_of([&] { hmps::require_closed(mesh); }); };
  auto one_twice = box;
  one_twice.triangles.push_back({2, 1, 0});  // the first one, {0, 2, 1}, from another corner
  EXPECT_NE(message(one_twice).find("13 triangles, of which 1 are repeated"), std::string::npos) << message(one_twice);
  auto all_twice = box;
  all_twice.triangles.insert(all_twice.triangles.end(), box.triangles.begin(), box.triangles.end());
  EXPECT_NE(message(all_twice).find("24 triangles, of which 12"), std::string::npos) << message(all_twice);
  for (const auto& mesh : {one_twice, all_twice}) {
    const auto single = hmps::drop_repeated(mesh);
    EXPECT_NO_THROW(hmps::require_closed(single));
    EXPECT_EQ(single.triangles, box.triangles);
  }
  const auto both_sides = hmps::weld(joined(box, reversed(box)));
  EXPECT_NE(message(both_sides).find("a part of 24 triangles"), std::string::npos) << message(both_sides);
  EXPECT_NE(message(both_sides).find("double-sided"), std::string::npos);
  // Also beside a sound body, where the part would be missing silently.
  const auto part = joined(box_surface<S>(V(4, 0, 0), V(5, 1, 1)), both_sides);
  EXPECT_NE(message(part).find("a part of 24 triangles"), std::string::npos) << message(part);
  // A single triangle in both orientations, whose edges have two triangles as they should.
  hmps::SurfaceMesh<S> leaf;
  leaf.vertices = {V(9, 0, 0), V(10, 0, 0), V(9, 1, 0)};
  leaf.triangles = {{0, 1, 2}, {1, 0, 2}};
  for (const auto& mesh : {leaf, joined(box, leaf)})
    EXPECT_NE(message(mesh).find("a part of 2 triangles"), std::string::npos) << message(mesh);
}

TYPED_TEST(SurfaceMesh, PartsMayShareTriangles) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(0, 0, 0), V(1, 1, 1));
  // Face to face: the wall between them occurs in both orientations.
  const auto beside = hmps::weld(joined(box, box_surface<S>(V(0, 0, 1), V(1, 1, 2))));
  EXPECT_EQ(beside.vertices.size(), 12u);
  EXPECT_NO_THROW(hmps::require_closed(beside));
  // One in the other on the same base, which occurs twice in the same orientation and is needed both times.
  const auto within = hmps::weld(joined(box, box_surface<S>(V(0, 0, 0), V(1, 1, 2))));
  EXPECT_EQ(within.vertices.size(), 12u);
  EXPECT_NO_THROW(hmps::require_closed(within));
  EXPECT_EQ(hmps::drop_repeated(within).triangles.size(), 24u);
}

TYPED_TEST(SurfaceMesh, DistinguishesFlapsFromHoles) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  auto flap = box_surface<S>(V(0, 0, 0), V(2, 2, 2));
  flap.vertices.push_back(V(-1, -1, 1));
  flap.triangles.push_back({0, 4, 8});
  std::string text = message_of([&] { hmps::require_closed(flap); });
  EXPECT_NE(text.find("is open at 2 edges"), std::string::npos) << text;
  EXPECT_NE(text.find("It also has 1 edges at which an odd number of triangles meet"), std::string::npos) << text;
  // An inner wall from edge to edge leaves no edge open.
  auto wall = box_surface<S>(V(0, 0, 0), V(2, 2, 2));
  wall.triangles.push_back({2, 3, 4});
  wall.triangles.push_back({3, 5, 4});
  text = message_of([&] { hmps::require_closed(wall); });
  EXPECT_EQ(text.find("open"), std::string::npos) << text;
  EXPECT_NE(text.find("4 edges at which an odd number of triangles meet"), std::string::npos) << text;
  EXPECT_NE(text.find("inner wall"), std::string::npos) << text;
}

TYPED_TEST(SurfaceMesh, DistinguishesInsideFromOutside) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto hollow = joined(box_surface<S>(V(0, 0, 0), V(4, 4, 4)), reversed(box_surface<S>(V(1, 1, 1), V(3, 3, 3))));
  EXPECT_TRUE(hmps::inside(hollow, V(S(0.5), S(0.5), S(0.5))));
  EXPECT_FALSE(hmps::inside(hollow, V(2, 2, 2)));
  EXPECT_FALSE(hmps::inside(hollow, V(5, 2, 2)));
  const auto torus = torus_surface<S>(S(2), S(0.5), 24, 16);
  EXPECT_TRUE(hmps::inside(torus, V(2, 0, 0)));
  EXPECT_TRUE(hmps::inside(reversed(torus), V(2, 0, 0)));
  EXPECT_FALSE(hmps::inside(torus, V(0, 0, 0)));
}

}  // namespace surface_mesh_test
