// SPDX-License-Identifier: MIT
#include "hmps/shapes/detail/polygon.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace polygon_test {

using hmps::detail::PolygonFault;
using hmps::detail::PolygonSplit;
using V = hmps::Vector<double, 3>;
using Polygon = std::vector<std::array<double, 2>>;

/// The polygon in a plane that lies askew, in millimetres.
std::vector<V> askew(const Polygon& polygon) {
  const Eigen::AngleAxisd turn(0.7, V(1, 2, -0.5).normalized());
  std::vector<V> corners;
  for (const auto& [x, y] : polygon) corners.push_back(1e-3 * (turn * V(x, y, 0) + V(3, -20, 5)));
  return corners;
}

PolygonSplit split(const std::vector<V>& corners) { return {corners, 1e-17}; }

/// Compares the areas of the polygon and of its triangles, with signs as seen against its normal.
void expect_covered_once(const Polygon& polygon) {
  const PolygonSplit parts = split(askew(polygon));
  ASSERT_EQ(parts.fault(), PolygonFault::none);
  ASSERT_EQ(parts.triangles().size(), polygon.size() - 2);
  double expected = 0, extent = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto& [a, b] = polygon[k];
    const auto& [c, d] = polygon[(k + 1) % polygon.size()];
    expected += a * d - b * c;
    extent = std::max({extent, std::abs(a), std::abs(b)});
  }
  // Triangles with the border of the polygon and without negative area cover it once.
  double sum = 0;
  for (const auto& [i, j, k] : parts.triangles()) {
    const auto& [a, b] = polygon[i];
    const auto& [c, d] = polygon[j];
    const auto& [e, f] = polygon[k];
    const double area = ((c - a) * (f - b) - (e - a) * (d - b)) * (expected > 0 ? 1 : -1);
    EXPECT_GE(area, -1e-5 * extent * extent);
    sum += std::abs(area);
  }
  EXPECT_NEAR(sum, std::abs(expected), 1e-5 * extent * extent);
}

/// The polygon from each of its corners on, in both orientations.
template <class Check>
void in_any_order(Polygon polygon, const Check& check) {
  for (int side = 0; side < 2; ++side) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      check(polygon);
      std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    }
    std::reverse(polygon.begin(), polygon.end());
  }
}

const Polygon corner_piece{{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
const Polygon dart{{0, 0}, {4, -1}, {1, 0}, {4, 1}};
const Polygon comb{{0, 0}, {9, 0}, {9, 5}, {8, 5}, {8, 1}, {6, 1}, {6, 5}, {5, 5},
                   {5, 1}, {3, 1}, {3, 5}, {2, 5}, {2, 1}, {1, 1}, {1, 5}, {0, 5}};

TEST(PolygonSplit, CoversConcavePolygonsOnce) {
  for (const Polygon& polygon : {corner_piece, dart, comb}) in_any_order(polygon, expect_covered_once);
  // A square with a square hole, to which an edge leads and returns.
  in_any_order({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}}, expect_covered_once);
  // Corners on the edges of an L, one of them twice.
  in_any_order({{0, 0}, {5, 0}, {10, 0}, {10, 0}, {10, 4}, {7, 4}, {4, 4}, {4, 7}, {4, 10}, {0, 10}},
               expect_covered_once);
  Polygon spiral;
  for (int k = 0; k <= 40; ++k) spiral.push_back({(5 + k) * std::cos(0.4 * k), (5 + k) * std::sin(0.4 * k)});
  for (int k = 40; k >= 0; --k) spiral.push_back({(9 + k) * std::cos(0.4 * k), (9 + k) * std::sin(0.4 * k)});
  in_any_order(spiral, expect_covered_once);
}

TEST(PolygonSplit, CoversRandomStarsOnce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0.05, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 4 + trial % 20;
    Polygon polygon;
    for (int k = 0; k < n; ++k) {
      const double r = u(random), angle = 2 * std::numbers::pi * k / n;
      polygon.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    expect_covered_once(polygon);
  }
}

// Rounding puts corners on a diagonal to one side of it or the other.
TEST(PolygonSplit, CoversStaircasesOnceWhateverTheirPlane) {
  const Polygon staircase{{0, 3}, {0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 3}};
  const Polygon bay{{0, 0}, {3, 3}, {7, 0}, {6, 5}, {7, 7}, {3, 7}, {0, 7}, {3, 6}, {2, 3}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto any = [&] { return V(u(random), u(random), u(random)); };
  for (const Polygon& polygon : {staircase, bay})
    for (int trial = 0; trial < 500; ++trial) {
      const V along = any().normalized(), across = along.cross(any()).normalized();
      std::vector<V> corners;
      for (const auto& corner : polygon) corners.push_back(corner[0] * along + corner[1] * across);
      ASSERT_EQ(split(corners).fault(), PolygonFault::none) << trial;
    }
}

// No plane shows such a face; it stays what it always was.
TEST(PolygonSplit, KeepsTheFanOfStronglyWarpedPolygons) {
  const PolygonSplit parts = split({{0.44, 0.73, 0.07}, {1.07, 0.99, 0.9}, {1.78, 1.11, 0.19}, {0.02, 1.01, 0.53}});
  EXPECT_EQ(parts.fault(), PolygonFault::none);
  EXPECT_EQ(parts.triangles()[1], (PolygonSplit::Triangle{0, 2, 3}));
}

void expect_fan(const std::vector<V>& corners) {
  const PolygonSplit parts = split(corners);
  EXPECT_EQ(parts.fault(), PolygonFault::none);
  ASSERT_EQ(parts.triangles().size(), corners.size() - 2);
  for (std::size_t k = 0; k < parts.triangles().size(); ++k)
    EXPECT_EQ(parts.triangles()[k], (PolygonSplit::Triangle{0, k + 1, k + 2}));
}

TEST(PolygonSplit, KeepsTheFanOfConvexPolygons) {
  const auto fan = [](const Polygon& polygon) { expect_fan(askew(polygon)); };
  fan({{0, 0}, {1, 0}, {0, 1}});
  in_any_order({{0, 0}, {3, 0}, {3, 1}, {0, 1}}, fan);
  in_any_order({{0, 0}, {1, 0}, {3, 0}, {3, 1}, {2, 1}, {0, 1}, {0, 0.5}}, fan);  // corners on edges
  in_any_order({{0, 0}, {3, 0}, {3, 0}, {3, 1}, {0, 1}}, fan);                    // a corner twice
  in_any_order({{0, 0}, {3, 0}, {3, 1}, {1.5, 1 - 1e-6}, {0, 1}}, fan);           // concave by the sixth digit
  in_any_order({{0, 0}, {3, 0}, {3, 0}, {0, 0}}, fan);                            // a line: nothing after welding
  Polygon round;
  for (int k = 0; k < 100; ++k)
    round.push_back({std::cos(0.02 * k * std::numbers::pi), 2 * std::sin(0.02 * k * std::numbers::pi)});
  in_any_order(round, fan);
  // A quadrilateral that is not plane.
  expect_fan({{0, 0, 0}, {1, 0, 0.2}, {1, 1, -0.1}, {0, 1, 0.3}});
  expect_fan(std::vector<V>(5, V(1, 2, 3)));
  // Of an L, the fan from the inner corner and from the outer one.
  fan({{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}});
}

TEST(PolygonSplit, FindsFaults) {
  const auto fault = [](PolygonFault expected) {
    return [expected](const Polygon& polygon) { EXPECT_EQ(split(askew(polygon)).fault(), expected); };
  };
  in_any_order({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, fault(PolygonFault::no_area));
  in_any_order({{0, 0}, {1, 0}, {3, 0}, {2, 0}}, fault(PolygonFault::none));  // on a line
  in_any_order({{0, 0}, {2, 2}, {2, 0}, {0, 1}}, fault(PolygonFault::crosses_itself));
  Polygon pentagram, twice = dart, loop;
  for (int k = 0; k < 5; ++k)
    pentagram.push_back({std::cos(0.8 * k * std::numbers::pi), std::sin(0.8 * k * std::numbers::pi)});
  in_any_order(pentagram, fault(PolygonFault::crosses_itself));
  twice.insert(twice.end(), dart.begin(), dart.end());
  in_any_order(twice, fault(PolygonFault::crosses_itself));
  // Corners on crossing edges, where a part is covered twice.
  in_any_order({{0, 1}, {0, 0}, {0, 3}, {2, 3}, {2, 0}, {1, 2}, {2, 3}, {2, 0}}, fault(PolygonFault::crosses_itself));
  // A loop whose crossing is a corner, inside and outside.
  in_any_order({{0, 0}, {6, -4}, {6, 4}, {0, 0}, {3, -1}, {3, 1}}, fault(PolygonFault::crosses_itself));
  in_any_order({{0, 0}, {6, -4}, {6, 4}, {0, 0}, {-3, 1}, {-3, -1}}, [](const Polygon& polygon) {
    expect_covered_once(polygon);  // it only touches
  });
  in_any_order({{0, 0}, {6, -4}, {6, 4}, {0, 0}, {-3, -1}, {-3, 1}}, fault(PolygonFault::crosses_itself));
}

}  // namespace polygon_test
