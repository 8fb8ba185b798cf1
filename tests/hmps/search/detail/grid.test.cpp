// SPDX-License-Identifier: MIT
#include "hmps/search/detail/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

namespace grid_test {

template <class S_, int D_>
struct Case {
  using S = S_;
  static constexpr int D = D_;
};
template <class C>
class GridTest : public ::testing::Test {
 public:
  using Real = typename C::S;
  static constexpr int D = C::D;
  using Point = hmps::Vector<Real, D>;
  std::vector<Point> points;
  hmps::detail::Grid<Real, D> grid;

  void fill(std::size_t n, Real size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    points.resize(n);
    for (Point& p : points)
      for (int c = 0; c < D; ++c) p[c] = size * static_cast<Real>(u(random));
  }
  void build(Real cell) {
    grid.build(points.size(), cell, [&](std::size_t k) { return points[k]; });
  }
  void expect_true_neighbours(const Point& centre, Real radius) {
    std::vector<hmps::Index> found, expected;
    grid.visit(centre, radius, [&](hmps::Index k, Real squared) {
      found.push_back(k);
      EXPECT_EQ(squared, (points[k] - centre).squaredNorm());
    });
    std::sort(found.begin(), found.end());
    for (std::size_t k = 0; k < points.size(); ++k)
      if ((points[k] - centre).squaredNorm() <= radius * radius) expected.push_back(static_cast<hmps::Index>(k));
    EXPECT_EQ(found, expected);
  }
};
using Cases = ::testing::Types<Case<double, 3>, Case<double, 2>, Case<float, 3>, Case<float, 2>>;
TYPED_TEST_SUITE(GridTest, Cases);

TYPED_TEST(GridTest, FindsAllWithinARadius) {
  using S = typename TypeParam::S;
  this->fill(500, S(1));
  for (const S cell : {S(0.05), S(0.3), S(5)}) {
    this->build(cell);
    for (const S radius : {S(0), S(0.1), S(0.45), S(3)})
      for (std::size_t k = 0; k < 500; k += 37) this->expect_true_neighbours(this->points[k], radius);
  }
}

TYPED_TEST(GridTest, SearchesAroundPointsOutside) {
  using S = typename TypeParam::S;
  this->fill(200, S(1));
  this->build(S(0.3));
  for (const S away : {S(-1.2), S(1.2), S(-50), S(50)}) {
    auto centre = this->points[0];
    centre[TypeParam::D - 1] = away;
    for (const S radius : {S(0.1), S(0.5), S(60)}) this->expect_true_neighbours(centre, radius);
  }
}

TYPED_TEST(GridTest, HandlesDistantClumpsAndNoPoints) {
  using S = typename TypeParam::S;
  this->build(S(1));
  EXPECT_EQ(this->grid.size(), 0U);
  this->expect_true_neighbours(TestFixture::Point::Zero(), S(10));
  // A cell per spacing would need 10^12 cells here.
  this->fill(100, S(1e-2));
  for (std::size_t k = 50; k < 100; ++k) this->points[k].array() += S(100);
  this->build(S(1e-3));
  this->expect_true_neighbours(this->points[3], S(5e-3));
  this->expect_true_neighbours(this->points[70], S(5e-3));
}

TYPED_TEST(GridTest, RefusesBadCellsAndPoints) {
  using S = typename TypeParam::S;
  this->fill(10, S(1));
  EXPECT_THROW(this->build(S(0)), hmps::InputError);
  this->points[4][1] = std::numeric_limits<S>::quiet_NaN();
  EXPECT_THROW(this->build(S(1)), hmps::InputError);
}

// Building a cell list of points that are far apart must neither run forever nor need unbounded memory.
TYPED_TEST(GridTest, EndsForPointsThatAreFarApart) {
  using S = typename TypeParam::S;
  const S most = std::numeric_limits<S>::max();
  this->fill(10, S(1));
  this->points[4][1] = most / 4;
  this->build(S(1e-3));
  this->expect_true_neighbours(this->points[3], S(1));
  this->points[5][1] = -most / 4;
  this->build(std::numeric_limits<S>::min());
  this->expect_true_neighbours(this->points[3], S(1));
  this->points[4][1] = most;
  this->points[5][1] = -most;
  EXPECT_THROW(this->build(S(1)), hmps::InputError);
}

}  // namespace grid_test
