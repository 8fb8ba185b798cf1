// SPDX-License-Identifier: MIT
#include "hmps/particles/surface_lattice.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "../../reference/backwards.hpp"
#include "../shapes/surfaces.hpp"
#include "hmps/particles/open_surface_lattice.hpp"

namespace surface_lattice_test {

using hmps::Vector;
using namespace hmps_test;

template <class S>
class SurfaceLattice : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SurfaceLattice, Scalars);

TYPED_TEST(SurfaceLattice, BoxOnTheSitesHoldsExactlyItsVolume) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  // Faces, edges and diagonals of the faces run through sites: the hard case for rays.
  const auto points = hmps::fill_lattice(box_surface<S>(V(0, 0, 0), V(4, 3, 5)), S(1));
  ASSERT_EQ(points.size(), 4u * 3u * 5u);
  EXPECT_EQ(points.front(), V(0, 0, 0));
  EXPECT_EQ(points[1], V(0, 0, 1));
  EXPECT_EQ(points.back(), V(3, 2, 4));
  const auto shifted = hmps::fill_lattice(box_surface<S>(V(0, 0, 0), V(4, 3, 5)), S(1), V(V::Constant(S(0.5))));
  EXPECT_EQ(shifted.size(), 4u * 3u * 5u);
}

TYPED_TEST(SurfaceLattice, VerticesEdgesAndPolesOnColumnsLeaveNoGapsOrSpikes) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  // Poles, meridians and quads of these surfaces lie on columns; a wrong count would fill or miss
  // a whole column, which the solid angle reveals.
  for (const auto& mesh : {torus_surface<S>(S(2), S(0.75), 16, 8), sphere_surface<S>(V(0, 0, 0), S(2.5), 1),
                           reversed(sphere_surface<S>(V(0, 0, 0), S(2.5), 2))}) {
    const auto points = hmps::fill_lattice(mesh, S(0.5));
    ASSERT_GT(points.size(), 100u);
    std::size_t sites = 0;
    for (int i = -6; i <= 6; ++i)
      for (int j = -6; j <= 6; ++j)
        for (int k = -6; k <= 6; ++k) {
          const V x(S(0.5) * S(i), S(0.5) * S(j), S(0.5) * S(k));
          const bool in = std::find(points.begin(), points.end(), x) != points.end();
          sites += in;
          if (in == hmps::inside(mesh, x)) continue;
          // They may differ only on the surface itself.
          bool near = false;
          for (int c = 0; c < 3; ++c)
            for (const double h : {-1e-5, 1e-5}) {
              V beside = x;
              beside[c] += static_cast<S>(h);
              near = near || hmps::inside(mesh, beside) == in;
            }
          EXPECT_TRUE(near) << x.transpose();
        }
    EXPECT_EQ(sites, points.size());
  }
}

TYPED_TEST(SurfaceLattice, TurnedSurfacesKeepTheirVolume) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 5; ++k) {
    auto mesh = box_surface<S>(V(0, 0, 0), V(S(1), S(0.8), S(0.6)));
    const Eigen::Matrix<S, 3, 3> turn =
        Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random))
            .normalized()
            .toRotationMatrix()
            .cast<S>();
    for (auto& v : mesh.vertices) v = turn * v;
    const double l0 = 0.02;
    const auto points = hmps::fill_lattice(mesh, static_cast<S>(l0));
    // The count of sites in a convex body fluctuates by much less than its surface in spacings.
    EXPECT_NEAR(static_cast<double>(points.size()) * l0 * l0 * l0, 0.48, 0.005);
    EXPECT_EQ(points, hmps::fill_lattice(mesh, static_cast<S>(l0), V(V::Zero()), Backwards{}));
  }
}

TYPED_TEST(SurfaceLattice, OverlapsAreUnitedAndHolesStayEmpty) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto first = box_surface<S>(V(0, 0, 0), V(4, 4, 4));
  EXPECT_EQ(hmps::fill_lattice(joined(first, box_surface<S>(V(2, 0, 0), V(6, 4, 4))), S(1)).size(), 6u * 16u);
  EXPECT_EQ(hmps::fill_lattice(joined(first, reversed(box_surface<S>(V(1, 1, 1), V(3, 3, 3)))), S(1)).size(), 64u - 8u);
  EXPECT_EQ(hmps::fill_lattice(joined(first, box_surface<S>(V(0, 0, 6), V(4, 4, 8))), S(1)).size(), 64u + 32u);
}

TYPED_TEST(SurfaceLattice, RejectsOpenSurfacesAndInvalidSpacings) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto box = box_surface<S>(V(0, 0, 0), V(1, 1, 1));
  auto open = box;
  open.triangles.pop_back();
  EXPECT_THROW((void)hmps::fill_lattice(open, S(0.5)), hmps::InputError);
  EXPECT_THROW((void)hmps::fill_lattice(box, S(0)), hmps::InputError);
  EXPECT_THROW((void)hmps::fill_lattice(box, S(1e-6)), hmps::InputError);
  EXPECT_EQ(hmps::fill_lattice(box, S(1), V(V::Constant(S(0.5)))).size(), 1u);
  const auto message = [&](S spacing) {
    try {
      (void)hmps::fill_lattice(box, spacing);
    } catch (const hmps::InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was thrown");
  };
  // Millimetres taken for metres, in the spacing and in the surface.
  EXPECT_NE(message(S(1.2)).find("is 1 m large, less than one spacing of 1.2"), std::string::npos) << message(S(1.2));
  EXPECT_NE(message(S(1e-4)).find("read with a scale of 1e-3"), std::string::npos) << message(S(1e-4));
}

TEST(SurfaceLatticeMisuse, IsRefusedWhereItsScalarDoesNotResolveTheSpacing) {
  const auto ball_at = [](float place) {
    hmps::SurfaceMesh<float> mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (auto& x : mesh.vertices) x = x * 0.01f + hmps::Vector<float, 3>::Constant(place);
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
  };
  EXPECT_FALSE(hmps::fill_lattice(ball_at(10), 1e-3f).empty());
  EXPECT_THROW((void)hmps::fill_lattice(ball_at(1000), 1e-3f), hmps::InputError);
  EXPECT_THROW((void)hmps::fill_open_lattice(ball_at(1000), 1e-3f), hmps::InputError);
}

}  // namespace surface_lattice_test
