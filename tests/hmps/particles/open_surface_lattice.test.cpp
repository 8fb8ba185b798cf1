// SPDX-License-Identifier: MIT
#include "hmps/particles/open_surface_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "../../reference/backwards.hpp"
#include "../../reference/message_of.hpp"
#include "../shapes/surfaces.hpp"

namespace open_surface_lattice_test {

using hmps::Vector;
using namespace hmps_test;

template <class S>
class OpenSurfaceLattice : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(OpenSurfaceLattice, Scalars);

TYPED_TEST(OpenSurfaceLattice, FillsClosedSurfacesAsBefore) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto first = box_surface<S>(V(0, 0, 0), V(4, 4, 4));
  // Sites on faces and edges, a hole, an overlap, a surface inside out.
  for (const auto& mesh :
       {box_surface<S>(V(0, 0, 0), V(4, 3, 5)), joined(first, box_surface<S>(V(2, 0, 0), V(6, 4, 4))),
        joined(first, reversed(box_surface<S>(V(1, 1, 1), V(3, 3, 3)))), reversed(first)}) {
    const auto open = hmps::fill_open_lattice(mesh, S(0.5));
    EXPECT_EQ(open.points, hmps::fill_lattice(mesh, S(0.5)));
    EXPECT_EQ(open.open_edges, 0u);
    EXPECT_EQ(open.holes, 0u);
    EXPECT_EQ(open.largest_hole, 0);
    EXPECT_EQ(open.doubtful_sites, 0u);
  }
  auto turned = torus_surface<S>(S(2), S(0.75), 40, 24);
  const S c = static_cast<S>(std::cos(0.4)), s = static_cast<S>(std::sin(0.4));
  for (V& v : turned.vertices) v = V(c * v[0] - s * v[2], v[1], s * v[0] + c * v[2]);
  EXPECT_EQ(hmps::fill_open_lattice(turned, S(0.13)).points, hmps::fill_lattice(turned, S(0.13)));
}

TYPED_TEST(OpenSurfaceLattice, SmallHolesMoveFewSites) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto whole = torus_surface<S>(S(2), S(0.5), 60, 30);
  auto open = whole;
  std::mt19937 random(2);
  for (int k = 0; k < 20; ++k)
    open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(random() % open.triangles.size()));
  EXPECT_THROW((void)hmps::fill_lattice(open, S(0.1)), hmps::InputError);
  const auto filled = hmps::fill_open_lattice(open, S(0.1));
  const auto right = hmps::fill_lattice(whole, S(0.1));
  EXPECT_GT(filled.open_edges, 40u);
  EXPECT_LE(filled.open_edges, 60u);
  EXPECT_GT(filled.holes, 10u);
  EXPECT_LE(filled.holes, 20u);
  EXPECT_GT(filled.largest_hole, 0.05);
  EXPECT_LT(filled.largest_hole, 0.8);
  EXPECT_LT(filled.doubtful_sites, right.size() / 20);
  const auto before = [](const V& a, const V& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::vector<V> differ;
  std::set_symmetric_difference(filled.points.begin(), filled.points.end(), right.begin(), right.end(),
                                std::back_inserter(differ), before);
  // The cover of a hole deviates from the missing triangle by less than the hole's size; edges are 0.2 long, and few
  // sites lie that close to holes.
  EXPECT_LE(differ.size(), 20u);
  const auto same = hmps::fill_open_lattice(open, S(0.1), V(V::Zero()), Backwards{});
  EXPECT_EQ(same.points, filled.points);
  EXPECT_EQ(same.doubtful_sites, filled.doubtful_sites);
}

TYPED_TEST(OpenSurfaceLattice, AnOpenEndIsClosedByAPlane) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  // Without its upper face, the winding number of a box lacks the share of that face inside, and above it has that
  // share with the other sign: it is a half in the plane of the rim, more below and less above.
  auto open = box_surface<S>(V(0, 0, 0), V(4, 4, 4));
  std::erase_if(open.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](hmps::Index v) { return open.vertices[v][2] == 4; });
  });
  ASSERT_EQ(open.triangles.size(), 10u);
  const auto filled = hmps::fill_open_lattice(open, S(0.5), V(V::Constant(S(0.25))));
  EXPECT_EQ(filled.points.size(), 8u * 8u * 8u);
  EXPECT_EQ(filled.open_edges, 4u);
  EXPECT_EQ(filled.holes, 1u);
  EXPECT_NEAR(filled.largest_hole, 4 * std::sqrt(2.0), 1e-6);
  EXPECT_GT(filled.doubtful_sites, 0u);
}

TYPED_TEST(OpenSurfaceLattice, ReportsWhatItCannotFill) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(0, 0, 0), V(1, 1, 1));
  const auto message = [](const auto& mesh, double spacing) {
    return message_of([&] { (void)hmps::fill_open_lattice(mesh, static_cast<S>(spacing)); });
  };
  auto turned = box;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_NE(message(turned, 0.1).find("opposite orientation"), std::string::npos);
  auto sheet = box;
  sheet.triangles.resize(2);
  EXPECT_NE(message(sheet, 0.1).find("does not clearly enclose any lattice site"), std::string::npos)
      << message(sheet, 0.1);
  EXPECT_NE(message(hmps::weld(joined(box, reversed(box))), 0.1).find("double-sided"), std::string::npos);
  auto leaf = sheet;
  leaf.triangles = {leaf.triangles[0], {leaf.triangles[0][1], leaf.triangles[0][0], leaf.triangles[0][2]}};
  EXPECT_NE(message(joined(box, leaf), 0.1).find("double-sided"), std::string::npos);
  EXPECT_NE(message(box, 1.2).find("less than one spacing"), std::string::npos);
  EXPECT_NE(message(box, 1e-4).find("a scale of 1e-3"), std::string::npos);
  EXPECT_NE(message(box, -1).find("the lattice spacing is -1"), std::string::npos);
}

}  // namespace open_surface_lattice_test
