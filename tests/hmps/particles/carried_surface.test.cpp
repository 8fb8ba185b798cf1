// SPDX-License-Identifier: MIT
#include "hmps/particles/carried_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "../../reference/message_of.hpp"
#include "../../reference/two_threads.hpp"
#include "hmps/particles/surface_lattice.hpp"
#include "hmps/shapes/surfaces.hpp"

namespace carried_surface_test {

using namespace hmps;
using V = Vector<double, 3>;

constexpr double l0 = 2e-3;

struct Ball {
  SurfaceMesh<double> mesh = hmps_test::sphere_surface<double>(V(0.1, -0.2, 0.3), 0.01, 2);
  std::vector<V> reference = fill_lattice(mesh, l0);
  std::vector<V> vertices = mesh.vertices;
};

// Coefficients and sums carry a few dozen roundings of numbers of half a metre.
constexpr double rounding = 1e-14;

TEST(CarriedSurface, FollowsAffineMotionExactly) {
  Ball ball;
  const CarriedSurface carried(vectors(ball.reference), vectors(ball.mesh.vertices), l0);
  ASSERT_EQ(carried.size(), ball.vertices.size());
  Matrix<double, 3> F;
  F << 1.3, 0.4, -0.2, 0.1, 0.7, 0.3, -0.5, 0.2, 1.1;
  const V shift(0.05, -0.02, 0.4);
  std::vector<V> x;
  for (const V& r : ball.reference) x.push_back(F * r + shift);
  carried(vectors(x), vectors(ball.vertices));
  for (std::size_t p = 0; p < ball.vertices.size(); ++p)
    EXPECT_NEAR((ball.vertices[p] - (F * ball.mesh.vertices[p] + shift)).norm(), 0, rounding);
}

TEST(CarriedSurface, InterpolatesWhatIsLinearExactly) {
  Ball ball;
  const CarriedSurface carried(vectors(ball.reference), vectors(ball.mesh.vertices), l0);
  const V slope(2, -1, 0.5);
  std::vector<double> quantity, found(carried.size());
  for (const V& r : ball.reference) quantity.push_back(slope.dot(r));
  carried.interpolate(scalars(quantity), scalars(found));
  for (std::size_t p = 0; p < found.size(); ++p) EXPECT_NEAR(found[p], slope.dot(ball.mesh.vertices[p]), 2 * rounding);

  // The mean stays within the range of the values of the particles below the surface; the points lie beyond them.
  carried.mean(scalars(quantity), scalars(found));
  const auto [least, largest] = std::minmax_element(quantity.begin(), quantity.end());
  for (std::size_t p = 0; p < found.size(); ++p) {
    EXPECT_GT(found[p], *least);
    EXPECT_LT(found[p], *largest);
    EXPECT_NEAR(found[p], slope.dot(ball.mesh.vertices[p]), slope.norm() * 2.5 * l0);  // no particle is further away
  }
}

/// A bar along x of 60 x 20 x 20 mm, bent to a circle about y of the given radius: sections stay plane and across.
V bent(const V& r, double radius) {
  const double turn = r[0] / radius, out = radius - r[2];
  return {out * std::sin(turn), r[1], radius - out * std::cos(turn)};
}

/// Largest error at the faces of the bar with particles `spacing` apart; checks it against its bound.
double error_of_bent_bar(double spacing) {
  const double radius = 0.1;
  const Box<double, 3> bar{V(0, -0.01, -0.01), V(0.06, 0.01, 0.01)};
  const auto reference = fill_lattice(bar, bar, spacing, V::Constant(spacing / 2));
  std::vector<V> points, x;
  for (const double y : {-0.01, 0.0, 0.003})
    for (int k = 0; k <= 10; ++k) {
      points.emplace_back(0.006 * k, y, 0.01);
      points.emplace_back(0.006 * k, y, -0.01);
    }
  for (const V& r : reference) x.push_back(bent(r, radius));
  const CarriedSurface carried(vectors(reference), vectors(points), spacing);
  std::vector<V> places(points.size());
  carried(vectors(x), vectors(places));
  double largest = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    // The second derivative of `bent` is (radius - z) / radius^2 along x, 1 / radius mixed, and zero along z.
    const double curvature = (radius + 0.015) / (radius * radius) + 1 / radius;
    double bound = rounding;
    for (const auto& share : carried.shares(p))
      bound += curvature / 2 * std::abs(share.weight) * (reference[share.particle] - points[p]).squaredNorm();
    const double error = (places[p] - bent(points[p], radius)).norm();
    EXPECT_LE(error, bound) << points[p].transpose();
    largest = std::max(largest, error);
  }
  return largest;
}

TEST(CarriedSurface, HasSecondOrderErrorInABentBar) {
  const double coarse = error_of_bent_bar(4e-3), fine = error_of_bent_bar(2e-3);
  EXPECT_LT(coarse, 0.1 * 4e-3);  // a tenth of a spacing, though the bar is bent to a radius of five thicknesses
  EXPECT_GT(std::log2(coarse / fine), 1.7);
}

TEST(CarriedSurface, PointsAreCarriedByTheirOwnBodyOnly) {
  std::vector<V> reference;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) reference.emplace_back(l0 * i, l0 * j, l0 * k);
  const auto first = [&](std::size_t i) { return reference[i][0] < 3.5 * l0; };
  std::vector<V> x = reference, place(1), point{V(3.4 * l0, 1.5 * l0, 1.5 * l0)};
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!first(i)) x[i][1] += 1;
  const CarriedSurface carried(vectors(reference), vectors(point), l0, first);
  carried(vectors(x), vectors(place));
  EXPECT_NEAR((place[0] - point[0]).norm(), 0, rounding);
}

TEST(CarriedSurface, WorksInThePlane) {
  std::vector<Vector<float, 2>> reference;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) reference.emplace_back(static_cast<float>(i), static_cast<float>(j));
  std::vector<Vector<double, 2>> points{{-0.5, 2.2}, {5.5, 5.5}}, places(2);
  const CarriedSurface<2> carried(vectors(reference), vectors(points), 1);
  for (auto& r : reference) r = {2 * r[1], r[0] + 1};
  carried(vectors(reference), vectors(places));
  EXPECT_NEAR((places[0] - Vector<double, 2>(4.4, 0.5)).norm(), 0, 1e-13);
  EXPECT_NEAR((places[1] - Vector<double, 2>(11, 6.5)).norm(), 0, 1e-13);
}

TEST(CarriedSurface, RejectsPointsThatNothingCarries) {
  Ball ball;
  std::vector<V> away{V(0, 0, 0)}, none, sheet;
  EXPECT_THROW(CarriedSurface(vectors(ball.reference), vectors(away), l0), InputError);
  EXPECT_THROW(CarriedSurface(vectors(ball.reference), vectors(ball.vertices), 0), InputError);
  EXPECT_THROW(CarriedSurface(vectors(none), vectors(ball.vertices), l0), InputError);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) sheet.emplace_back(l0 * (i - 10), l0 * (j - 10), 0.0);
  EXPECT_THROW(CarriedSurface(vectors(sheet), vectors(away), l0), InputError);  // nothing tells how it is tilted
  const CarriedSurface carried(vectors(ball.reference), vectors(ball.vertices), l0);
  EXPECT_THROW(carried(vectors(away), vectors(ball.vertices)), InputError);
  EXPECT_THROW(carried(vectors(ball.reference), vectors(away)), InputError);
  auto broken = ball.vertices;
  broken[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(hmps_test::message_of([&] {
              (void)CarriedSurface(vectors(ball.reference), vectors(broken), l0);
            }).find("hmps: component 1 of the place of point 3 of a carried surface is nan"),
            0u);
}

// Earlier, the error said that such a point lies further than 8 spacings from the particles, which have a layer at 6.5.
TEST(CarriedSurface, SaysWhatIsMissingAroundAPointThatNothingCarries) {
  std::vector<V> block;
  for (int i = 0; i < 13; ++i)
    for (int j = 0; j < 13; ++j)
      for (int k = 0; k < 4; ++k) block.push_back(l0 * V(i - 6, j - 6, -k));
  const auto at = [&](double height) {
    std::vector<V> point{V(0, 0, height * l0)};
    (void)CarriedSurface(vectors(block), vectors(point), l0);
  };
  EXPECT_NO_THROW(at(6));
  const std::string words = hmps_test::message_of([&] { at(6.7); });
  EXPECT_NE(words.find("those within 8 spacings of"), std::string::npos) << words;
  EXPECT_NE(words.find("do not span space"), std::string::npos) << words;
}

TEST(CarriedSurface, RejectsOutputOverItsInput) {
  // As many points as particles, so that the sizes are right.
  Ball ball;
  const CarriedSurface carried(vectors(ball.reference), vectors(ball.reference), l0);
  auto x = ball.reference;
  std::vector<double> quantity(x.size(), 1);
  EXPECT_THROW(carried(vectors(x), vectors(x)), InputError);
  EXPECT_THROW(carried.interpolate(scalars(quantity), scalars(quantity)), InputError);
  EXPECT_THROW(carried.mean(scalars(quantity), scalars(quantity)), InputError);
  EXPECT_EQ(x, ball.reference);
}

TEST(CarriedSurface, RefusesAPointThatDoesNotExist) {
  Ball ball;
  const CarriedSurface carried(vectors(ball.reference), vectors(ball.vertices), l0);
  EXPECT_FALSE(carried.shares(carried.size() - 1).empty());
  EXPECT_THROW((void)carried.shares(carried.size()), InputError);
}

TEST(CarriedSurface, HasNoPointsAfterAMove) {
  Ball ball;
  CarriedSurface carried(vectors(ball.reference), vectors(ball.vertices), l0);
  const auto moved = std::move(carried);
  EXPECT_EQ(moved.size(), ball.vertices.size());
  EXPECT_EQ(carried.size(), 0U);                      // NOLINT(bugprone-use-after-move)
  EXPECT_THROW((void)carried.shares(0), InputError);  // NOLINT(bugprone-use-after-move)
}

TEST(CarriedSurface, KeepsTheErrorOfAPointFromTheUsersThreads) {
  Ball ball;
  ball.vertices[5] += V(1, 0, 0);
  ball.vertices.back() += V(1, 0, 0);
  const std::string error = hmps_test::message_in_two_threads([&](const auto& execute) {
    const auto every = [](std::size_t) { return true; };
    (void)CarriedSurface(vectors(ball.reference), vectors(ball.vertices), l0, every, execute);
  });
  EXPECT_NE(error.find("point 5 of a carried surface"), std::string::npos) << error;
}

}  // namespace carried_surface_test
