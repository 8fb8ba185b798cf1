// SPDX-License-Identifier: MIT
#include "hmps/particles/wall_normals.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "../../reference/message_of.hpp"
#include "hmps/core/view.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/implicit.hpp"

namespace wall_normals_test {

using Point = hmps::Vector<double, 3>;
using hmps_test::message_of;

TEST(WallNormals, AreThoseOfATurnedPlateAlsoInItsMiddle) {
  const hmps::Matrix<double, 3> axes = Eigen::AngleAxisd(0.6, Point(0.3, -0.5, 0.8).normalized()).matrix();
  const hmps::Box<double, 3> plate{Point(-5, -5, -1.5), Point(5, 5, 1.5)};
  const auto shape = hmps::rotated(plate, axes);
  std::vector<Point> places;
  for (const double z : {-1.0, 0.0, 0.3, 1.0}) places.push_back(axes * Point(0.4, -0.7, z));
  for (const Point& n : hmps::wall_normals(shape, hmps::vectors(places), 1.0))
    EXPECT_NEAR(std::abs(n.dot(axes.col(2))), 1, 1e-9);
}

TEST(WallNormals, AreRadialInAHollowBallOfFloats) {
  using Place = hmps::Vector<float, 3>;
  const auto shell = hmps::shell(hmps::Ball<float, 3>{Place::Zero(), 10}, 2.F);
  std::vector<Place> places;
  for (const float radius : {9.5F, 10.F, 10.5F}) places.push_back(radius * Place(1, 2, -2) / 3);
  for (const Place& n : hmps::wall_normals(shell, hmps::vectors(places), 1.0))
    EXPECT_NEAR(std::abs(n.dot(Place(1, 2, -2)) / 3), 1, 1e-3);
}

TEST(WallNormals, OfFittedParticlesAreZeroInBulk) {
  // A sheet in the plane that ends in a disc.
  using Place = hmps::Vector<double, 2>;
  const auto shape =
      hmps::unite(hmps::Box<double, 2>{Place(0, -1), Place(20, 1)}, hmps::Ball<double, 2>{Place(26, 0), 7});
  const auto fitted = hmps::fit_particles(shape, hmps::Box<double, 2>{Place(0, -8), Place(34, 8)}, 1);
  const auto normals = hmps::wall_normals(shape, fitted, 1);
  ASSERT_EQ(normals.size(), fitted.size());
  int in_sheet = 0, in_bulk = 0;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const Place& x = fitted.positions[i];
    if (fitted.layers[i] == 0) {
      EXPECT_EQ(normals[i], Place::Zero());
      ++in_bulk;
    } else if (x[0] > 2 && x[0] < 16) {
      EXPECT_NEAR(std::abs(normals[i][1]), 1, 1e-9);
      ++in_sheet;
    }
  }
  EXPECT_GT(in_sheet, 20);
  EXPECT_GT(in_bulk, 20);
}

TEST(WallNormals, RejectParticlesWithoutANormal) {
  const std::vector<Point> places{Point::Zero()};
  const auto normals = [&](const auto& shape, double spacing) {
    return [&places, shape, spacing] { (void)hmps::wall_normals(shape, hmps::vectors(places), spacing); };
  };
  const hmps::Ball<double, 3> ball{Point::Zero(), 1};
  const auto nan = [](const Point&) { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_NE(message_of(normals(ball, -1)).find("the spacing"), std::string::npos);
  EXPECT_NE(message_of(normals(nan, 1)).find("NaN"), std::string::npos);
  const auto sign = [](const Point& x) { return x.norm() < 2 ? -1.0 : 1.0; };
  EXPECT_NE(message_of(normals(sign, 1)).find("redistanced"), std::string::npos);
  const std::vector<hmps::Vector<float, 3>> far_away{{90, 0, 0}};
  const auto of_float = [&] {
    (void)hmps::wall_normals(hmps::Ball<float, 3>{.radius = 100}, hmps::vectors(far_away), 1e-3);
  };
  EXPECT_NE(message_of(of_float).find("not resolve"), std::string::npos);
}

}  // namespace wall_normals_test
