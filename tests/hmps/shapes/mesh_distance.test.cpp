// SPDX-License-Identifier: MIT
#include "hmps/shapes/mesh_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "hmps/contact/surface_correction.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/particles/surface_lattice.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/isosurface.hpp"
#include "surfaces.hpp"

namespace mesh_distance_test {

using hmps::Vector;
using namespace hmps_test;

template <class S>
class MeshDistance : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(MeshDistance, Scalars);

TYPED_TEST(MeshDistance, IsThatOfTheBox) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const V lower(-1, 0, 2), upper(1, 3, 4);
  const hmps::Box<S, 3> box{lower, upper};
  const hmps::MeshDistance<S> mesh(box_surface<S>(lower, upper)), turned(reversed(box_surface<S>(lower, upper)));
  static_assert(hmps::Shape<hmps::MeshDistance<S>, S, 3>);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-2, 6);
  for (int k = 0; k < 500; ++k) {
    const V x(static_cast<S>(uniform(random)), static_cast<S>(uniform(random)), static_cast<S>(uniform(random)));
    EXPECT_NEAR(mesh(x), box(x), 16 * std::numeric_limits<S>::epsilon());
    EXPECT_EQ(mesh(x), turned(x));
  }
  EXPECT_EQ(mesh.box().upper, upper);
  EXPECT_TRUE(std::isnan(mesh(V(0, std::numeric_limits<S>::quiet_NaN(), 0))));
  EXPECT_TRUE(std::isnan(mesh(V(0, std::numeric_limits<S>::infinity(), 0))));
}

TYPED_TEST(MeshDistance, FillsAndRaisesAsShapesDo) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const auto sphere = sphere_surface<S>(V(0, 0, 0), S(0.01), 3);
  const hmps::MeshDistance<S> shape(sphere);
  const S l0 = S(0.0011);
  const auto points = hmps::fill_lattice(shape, shape.box(), l0);
  EXPECT_EQ(points, hmps::fill_lattice(sphere, l0));
  std::vector<hmps::Index> skin;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (shape(points[i]) > -l0) skin.push_back(static_cast<hmps::Index>(i));
  const hmps::SurfaceCorrection<S, 3> raised(hmps::vectors(points), std::span<const hmps::Index>(skin), shape, l0);
  // Half a spacing below the sphere, of which the triangles fall short by 0.4 % of the radius at most.
  for (std::size_t k = 0; k < skin.size(); ++k)
    EXPECT_NEAR((points[skin[k]] + raised.offsets()[k]).norm(), S(0.01) - l0 / 2, S(1e-4));
  // Cut in half by a plane.
  const auto half = hmps::intersect(shape, hmps::HalfSpace<S, 3>{V::Zero(), V(0, 0, 1)});
  EXPECT_LT(half(V(0, 0, S(-0.005))), 0);
  EXPECT_GT(half(V(0, 0, S(0.005))), 0);
}

TEST(MeshDistance, CanBeCalledAfterAMove) {
  using V = hmps::Vector<double, 3>;
  const hmps::Box<double, 3> box{V(-1, -1, -1), V(1, 1, 1)};
  hmps::MeshDistance<double> first(hmps::isosurface(hmps::Ball<double, 3>{.radius = 0.5}, box, 0.25));
  const double before = first(V(0, 0, 0));
  const auto second = std::move(first);
  EXPECT_EQ(second(V(0, 0, 0)), before);
  EXPECT_EQ(first(V(0, 0, 0)), before);  // NOLINT(bugprone-use-after-move)
}

}  // namespace mesh_distance_test
