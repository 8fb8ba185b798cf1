// SPDX-License-Identifier: MIT
#include "hmps/shapes/isosurface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "hmps/core/error.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/surface_patch.hpp"
#include "hmps/shapes/triangle_tree.hpp"
#include "reference/backwards.hpp"
#include "reference/message_of.hpp"
#include "reference/two_threads.hpp"

namespace isosurface_test {

using hmps::isosurface;
using hmps_test::message_of;

template <class S>
class Isosurface : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Isosurface, Scalars);

template <class S>
using V = hmps::Vector<S, 3>;
template <class S>
[[nodiscard]] hmps::Box<S, 3> cube(S half) {
  return {V<S>::Constant(-half), V<S>::Constant(half)};
}

TYPED_TEST(Isosurface, IsClosedAndTurnedOutwardsWithItsVerticesOnTheBall) {
  using S = TypeParam;
  const hmps::Ball<S, 3> ball{V<S>(S(0.001), S(0.002), S(-0.0015)), S(0.01)};
  const auto mesh = isosurface(ball, cube<S>(S(0.014)), S(0.001));
  EXPECT_NO_THROW(require_closed(mesh));
  for (const auto& x : mesh.vertices) ASSERT_NEAR(ball(x), 0, 1e-3 / 2000);
  const double exact = 4 * std::numbers::pi / 3 * 1e-6;
  EXPECT_NEAR(volume(mesh), exact, 0.005 * exact);  // chords: 0.23 %
  EXPECT_LT(volume(mesh), exact);
}

// Each halving of the cells quarters the volume that is cut off, roughly, depending on how the cells happen to lie.
TYPED_TEST(Isosurface, ConvergesWithTheSquareOfTheCell) {
  using S = TypeParam;
  const hmps::Ball<S, 3> ball{V<S>::Zero(), S(1)};
  const auto missing = [&](S cell) {
    return 4 * std::numbers::pi / 3 - volume(isosurface(ball, cube<S>(S(1.3)), cell));
  };
  EXPECT_NEAR(missing(S(0.2)) / missing(S(0.05)), 16, 3);
  // 0.08 cell^2 / R in the mean, over the area of the ball.
  EXPECT_NEAR(missing(S(0.05)) / (4 * std::numbers::pi * 0.05 * 0.05), 0.08, 0.005);
}

// As the docstring states: on the edges and corners of boxes in 30 directions 0.58 and 0.65 cells at most.
TEST(Isosurface, BevelsRightAngledEdgesAsStated) {
  const double cell = 0.1;
  const hmps::Box<double, 3> block{V<double>(-0.6, -0.7, -0.5), V<double>(0.63, 0.64, 0.55)};
  double edge = 0, corner = 0;
  for (int k = 0; k < 6; ++k) {
    const V<double> axis = V<double>(std::sin(k), std::cos(2 * k), std::sin(3 * k + 1)).normalized();
    const hmps::Matrix<double, 3> turn = Eigen::AngleAxisd(0.37 * k, axis).toRotationMatrix();
    const V<double> moved(0.013 * k, 0.007 * k, -0.011 * k);
    const auto placed = [&](const V<double>& x) { return block(turn.transpose() * (x - moved)); };
    const hmps::TriangleTree surface(isosurface(placed, cube(1.3), cell));
    const auto off = [&](const V<double>& x) { return surface.distance(turn * x + moved) / cell; };
    for (double x = -0.4; x < 0.4; x += 0.02) edge = std::max(edge, off({x, block.upper[1], block.upper[2]}));
    corner = std::max(corner, off(block.upper));
  }
  EXPECT_LT(edge, 0.6);
  EXPECT_LT(corner, 0.7);
  EXPECT_GT(edge, 0.4);
}

// Every case occurs: whichever corners of a tetrahedron lie inside the shape, in either orientation.
TYPED_TEST(Isosurface, ClosesWhateverTheSignsOfTheNodes) {
  using S = TypeParam;
  const auto noise = [](const V<S>& x) {
    const S sum = std::sin(S(12.9898) * x[0] + S(78.233) * x[1] + S(37.719) * x[2]) * S(43758.5453);
    return sum - std::floor(sum) - S(0.5);
  };
  const auto mesh = isosurface(noise, cube<S>(S(1)), S(0.2));
  EXPECT_GT(mesh.triangles.size(), 5000u);
  EXPECT_NO_THROW(require_closed(mesh));
  EXPECT_GT(volume(mesh), 0);
}

TYPED_TEST(Isosurface, NeedsOnlyTheSign) {
  using S = TypeParam;
  const hmps::Ball<S, 3> ball{V<S>::Zero(), S(1)};
  const auto sign = [&](const V<S>& x) { return ball(x) < 0 ? S(-1) : S(1e6); };
  const auto cube3 = cube<S>(S(1.2));
  EXPECT_EQ(isosurface(sign, cube3, S(0.1)).vertices, isosurface(ball, cube3, S(0.1)).vertices);
}

TYPED_TEST(Isosurface, IsClosedByTheFacesOfTheBox) {
  using S = TypeParam;
  const hmps::Ball<S, 3> ball{V<S>::Zero(), S(1)};
  const hmps::Box<S, 3> upper{V<S>(S(-2), S(-2), S(0)), V<S>::Constant(S(2))};
  const auto mesh = isosurface(ball, upper, S(0.05));
  EXPECT_NO_THROW(require_closed(mesh));
  EXPECT_NEAR(volume(mesh), 2 * std::numbers::pi / 3, 0.01);
  for (const auto& x : mesh.vertices) EXPECT_GT(x[2], S(-0.0001));
}

TEST(Isosurface, CostsAPatchTheAreaOfItsBevelledEdgesAsStated) {
  using P = V<double>;
  constexpr double bore = 10e-3, length = 12e-3;
  const auto tube = hmps::subtract(hmps::Cylinder<double, 3>{P(0, 0, -1), P(0, 0, 1), 20e-3},
                                   hmps::Cylinder<double, 3>{P(0, 0, -1), P(0, 0, 1), bore});
  const hmps::Box<double, 3> part{P(-25e-3, -25e-3, 0), P(25e-3, 25e-3, length)};
  for (const auto& [cell, lost] : {std::pair{1.25e-3, 0.039}, {0.625e-3, 0.029}}) {
    const auto patch = hmps::surface_patch(isosurface(tube, part, cell), [](const P& place, const P& normal) {
      return std::hypot(place[0], place[1]) < 1.1 * bore && std::abs(normal[2]) < 0.5;
    });
    EXPECT_NEAR(hmps::area(patch) / (2 * std::numbers::pi * bore * length), 1 - lost, 2e-3) << cell;
  }
}

TEST(Isosurface, DoesNotDependOnTheOrderOfTheWork) {
  const hmps::Ball<double, 3> ball{V<double>::Zero(), 1};
  const auto forwards = isosurface(ball, cube(1.2), 0.1);
  const auto backwards = isosurface(ball, cube(1.2), 0.1, hmps_test::Backwards{});
  EXPECT_EQ(forwards.vertices, backwards.vertices);
  EXPECT_EQ(forwards.triangles, backwards.triangles);
}

TEST(Isosurface, RejectsShapesThatItCannotCut) {
  const hmps::Ball<double, 3> ball{V<double>::Zero(), 1};
  const auto refused = [&](const auto& shape, const hmps::Box<double, 3>& box, double cell) {
    return message_of<hmps::InputError>([&] { (void)isosurface(shape, box, cell); });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused(ball, {V<double>::Constant(1), V<double>::Zero()}, 0.1).find("upper corner"), std::string::npos);
  EXPECT_NE(refused(ball, {V<double>::Constant(nan), V<double>::Zero()}, 0.1).find("nan"), std::string::npos);
  for (const double cell : {0.0, -0.1, nan})
    EXPECT_NE(refused(ball, cube(1.2), cell).find("positive width"), std::string::npos) << cell;
  EXPECT_NE(refused(ball, cube(1.2), 1e-9).find("too many"), std::string::npos);
  EXPECT_NE(refused(ball, {V<double>::Constant(2), V<double>::Constant(3)}, 0.1).find("no surface"), std::string::npos);
  const auto broken = [&](const V<double>& x) { return x[0] > 0 ? nan : ball(x); };
  EXPECT_NE(refused(broken, cube(1.2), 0.1).find("NaN at"), std::string::npos);
}

TEST(IsosurfaceMisuse, IsRefusedWhereItsScalarDoesNotResolveTheCells) {
  using P = hmps::Vector<float, 3>;
  const auto surface_at = [](float place) {
    const P middle = P::Constant(place), reach = P::Constant(7e-3f);
    return hmps::isosurface([&](const P& x) { return (x - middle).norm() - 6e-3f; },
                            hmps::Box<float, 3>{P(middle - reach), P(middle + reach)}, 1e-3f);
  };
  EXPECT_NEAR(hmps::volume(surface_at(10)) / hmps::volume(surface_at(0)), 1, 0.01);
  for (const float place : {100.0f, -1e3f, 1e4f}) EXPECT_THROW((void)surface_at(place), hmps::InputError) << place;
}

TEST(Isosurface, KeepsTheErrorOfTheShapeFromTheUsersThreads) {
  const auto broken = [](const V<double>& x) {
    return x[0] > 0 ? std::numeric_limits<double>::quiet_NaN() : x.norm() - 1;
  };
  const std::string error = hmps_test::message_in_two_threads(
      [&](const auto& execute) { (void)isosurface(broken, cube(1.2), 0.3, execute); });
  EXPECT_NE(error.find("NaN at"), std::string::npos) << error;
}

}  // namespace isosurface_test
