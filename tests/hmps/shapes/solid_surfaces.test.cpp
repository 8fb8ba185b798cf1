// SPDX-License-Identifier: MIT
#include "hmps/shapes/solid_surfaces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "hmps/shapes/surface_patch.hpp"

namespace solid_surfaces_test {

using namespace hmps;
using V2 = Vector<double, 2>;
using V3 = Vector<double, 3>;
using std::numbers::pi;

/// The volume of a closed surface; fails if it is open or its triangles are turned.
template <class S>
double volume_of(const SurfaceMesh<S>& mesh) {
  EXPECT_NO_THROW(require_closed(mesh));
  return volume(mesh);
}

double shortfall(int segments) { return std::sin(2 * pi / segments) / (2 * pi / segments); }

TEST(SolidSurfaces, BoxIsExact) {
  const auto mesh = box_surface(Box<double, 3>{V3(-1, 2, 3), V3(1, 5, 4)});
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_DOUBLE_EQ(volume_of(mesh), 6);
  EXPECT_DOUBLE_EQ(area(mesh), 22);
  const auto top = surface_patch(mesh, [](const auto&, const auto& n) { return n[2] > 0.9; });
  EXPECT_DOUBLE_EQ(area(top), 6);
  EXPECT_FLOAT_EQ(static_cast<float>(volume_of(box_surface(Box<float, 3>{{0, 0, 0}, {1, 1, 2}}))), 2);
}

TEST(SolidSurfaces, TubesConesAndBallsHaveTheVolumesOfTheirFormulas) {
  const std::vector<V2> tube{{4e-3, 0}, {6e-3, 0}, {6e-3, 0.02}, {4e-3, 0.02}};
  EXPECT_NEAR(volume_of(revolved_surface(tube, 64)) / (pi * 20e-6 * 0.02), shortfall(64), 1e-12);
  const std::vector<V2> turned(tube.rbegin(), tube.rend());
  EXPECT_NEAR(volume_of(revolved_surface(turned, 64)) / (pi * 20e-6 * 0.02), shortfall(64), 1e-12);
  // Corners and edges on the axis.
  EXPECT_NEAR(volume_of(revolved_surface<double>({{0, 0}, {2, 0}, {0, 3}}, 5)) / (pi * 4), shortfall(5), 1e-12);
  EXPECT_NEAR(volume_of(revolved_surface<double>({{2, -1}, {2, 1}, {0, 1}, {0, -1}}, 7)) / (pi * 8), shortfall(7),
              1e-12);
  std::vector<V2> half_circle;
  for (int k = 0; k <= 90; ++k) half_circle.emplace_back(std::sin(pi * k / 90), -std::cos(pi * k / 90));
  const auto ball = revolved_surface(half_circle, 180);
  EXPECT_NEAR(volume_of(ball) / (4 * pi / 3), 1, 2e-3);
  EXPECT_EQ(ball.vertices.size(), 2 + 89u * 180);  // the poles lie on the axis, although sin(pi) is not zero
  std::vector<Vector<float, 2>> in_float;
  for (const V2& at : half_circle) in_float.push_back(at.cast<float>());
  in_float.back()[0] = -8.7e-8f;  // sin(pi) in float
  EXPECT_NEAR(volume_of(revolved_surface(in_float, 180)) / (4 * pi / 3), 1, 2e-3);
}

TEST(SolidSurfaces, BoreIsAPatchWhoseNormalsPointToTheAxis) {
  const auto tube = revolved_surface<double>({{4e-3, 0}, {6e-3, 0}, {6e-3, 0.02}, {4e-3, 0.02}}, 32);
  const auto bore =
      surface_patch(tube, [](const auto& at, const auto& n) { return n[0] * at[0] + n[1] * at[1] < -1e-4; });
  EXPECT_NEAR(area(bore), 32 * 2 * 4e-3 * std::sin(pi / 32) * 0.02, 1e-15);
}

TEST(SolidSurfaces, SolidsThatDoNotExistAreErrors) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)box_surface(Box<double, 3>{V3(0, 0, 0), V3(1, 0, 1)}), InputError);
  EXPECT_THROW((void)box_surface(Box<double, 3>{V3(0, 0, 0), V3(1, nan, 1)}), InputError);
  EXPECT_THROW((void)revolved_surface<double>({{1, 0}, {2, 0}}, 8), InputError);
  EXPECT_THROW((void)revolved_surface<double>({{1, 0}, {2, 0}, {2, 1}}, 2), InputError);
  EXPECT_THROW((void)revolved_surface<double>({{-1, 0}, {2, 0}, {2, 1}}, 8), InputError);
  EXPECT_THROW((void)revolved_surface<double>({{1, 0}, {nan, 0}, {2, 1}}, 8), InputError);
  EXPECT_THROW((void)revolved_surface<double>({{1, 0}, {2, 0}, {3, 0}}, 8), InputError);
  EXPECT_THROW((void)revolved_surface<double>({{0.1, 100.1}, {0.2, 100.2}, {0.7, 100.7}}, 8), InputError);
  EXPECT_THROW((void)revolved_surface<double>({{1, 0}, {2, 0}, {2, 1}, {1, 0}}, 8), InputError);
}

}  // namespace solid_surfaces_test
