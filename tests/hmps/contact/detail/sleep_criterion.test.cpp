// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/sleep_criterion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

#include "hmps/core/executor.hpp"
#include "hmps/core/view.hpp"

namespace sleep_criterion_test {

using hmps::Index;
using Ball = hmps::SmoothMetaball;
using Criterion = hmps::detail::SleepCriterion<double, 3, Ball>;
using Point = hmps::Vector<double, 3>;
using Tensor = hmps::Matrix<double, 3>;

constexpr double radius = Ball::radius;  // the spacing is 1

/// A flat wall of three layers, and particle 0, the slave, `height` above the outermost.
struct Wall {
  std::vector<Index> particle, masters;
  std::vector<Point> x;
  std::vector<Tensor> F;
  hmps::detail::ParticleBounds<double, 3> bounds{1, radius};
  hmps::NormalDensity<double, 3, Ball> Z{1};
  hmps::detail::CheckInterval interval{8, 8};
  Criterion criterion;
  std::vector<Index> kept;
  explicit Wall(double height, const Tensor& gradient = Tensor::Identity()) {
    x.emplace_back(0.2, 0.3, height);
    for (int a = -5; a <= 5; ++a)
      for (int b = -5; b <= 5; ++b)
        for (int c = 0; c < 3; ++c) x.emplace_back(a, b, -c);
    F.assign(x.size(), gradient);
    F[0] = Tensor::Identity();
    for (Index i = 0; i < x.size(); ++i) {
      particle.push_back(i);
      if (i > 0) masters.push_back(i);
    }
    bounds.resize(x.size());
    criterion.resize(1);
    measure(true);
    for (int k = 0; k < 4; ++k) measure();  // until the bounds on strains have fallen to their minimum
  }
  void measure(bool is_first = false) {
    (void)bounds.measure(
        hmps::vectors(x), hmps::matrices(F), particle, is_first, interval, [](std::size_t) { return true; },
        hmps::Serial{});
    bounds.limit_travel(1e3, interval.until);
  }
  /// Moves all particles so far that each may deviate by `bound` until the next check.
  void allow(double bound) {
    for (Point& p : x) p[0] += 0.5 * (bound - 0.01);
    measure();
  }
  Criterion::Verdict judge() {
    kept.assign(masters.size(), 0);
    const auto verdict = criterion.judge({bounds, Z, interval}, {0, 0, 0.5}, masters, kept.data());
    kept.resize(verdict.kept);
    return verdict;
  }
  /// R_im with the slave lower by `lower` and all masters higher by as much.
  [[nodiscard]] double distance(double lower) const {
    double C = 0;
    for (const Index j : masters)
      C += Ball::value(std::min(1., (x[j] - x[0] + Point(0, 0, 2 * lower)).squaredNorm() / (radius * radius)));
    return Z.inverse(C).value;
  }
};

TEST(SleepCriterion, LetsASlaveRestOnlyAsFarAsItCannotTouch) {
  std::set<double> seen;
  double before = 0;
  for (double height = 0.5; height < 2; height += 0.02) {
    Wall wall(height);
    wall.allow(0.15);
    ASSERT_NEAR(wall.bounds.deviation()[0], 0.15, 1e-12);
    const double rest = wall.judge().rest;
    EXPECT_GE(rest, before) << "the higher, the longer";
    before = rest;
    seen.insert(rest);
    if (rest > 0) {
      EXPECT_GE(wall.distance(rest * 0.15), 1) << height;
    }
    // And not less than that, except for what strains and the direction of the deviations may add.
    if (rest < 1) {
      EXPECT_LT(wall.distance((rest > 0 ? 2 * rest : 0.25) * 0.15), 1.2) << height;
    }
  }
  EXPECT_EQ(seen, (std::set<double>{0, 0.25, 0.5, 1}));
}

TEST(SleepCriterion, FollowsTheDrift) {
  const auto rests = [](double height, double speed) {
    Wall wall(height);
    for (const double calls : {16., 8., 0.}) {
      wall.x[0][2] = height - calls * speed;
      wall.measure();
    }
    return wall.judge().rest > 0;
  };
  EXPECT_TRUE(rests(1.5, 0));
  EXPECT_TRUE(rests(1.5, -0.03)) << "at 1.26 by the next check";
  EXPECT_FALSE(rests(1.5, -0.06)) << "at 1.02";
  EXPECT_FALSE(rests(1.5, -0.3)) << "through the wall";
  EXPECT_TRUE(rests(1.5, 0.06));
  EXPECT_FALSE(rests(1, 0.1)) << "it touches now";
}

TEST(SleepCriterion, KeepsAllMastersThatMayComeWithinReach) {
  Wall wall(2.5);
  for (Index j : wall.masters) wall.x[j][2] += 0.2;  // towards the slave, an eighth of it per call
  wall.measure();
  for (Index j : wall.masters) wall.x[j][2] += 0.2;
  wall.measure();
  const auto verdict = wall.judge();
  ASSERT_EQ(wall.kept.size(), verdict.kept);
  EXPECT_TRUE(std::is_sorted(wall.kept.begin(), wall.kept.end()));
  const std::set<Index> kept(wall.kept.begin(), wall.kept.end());
  std::size_t met = 0, left = 0;
  for (const Index j : wall.masters) {
    const double now = (wall.x[j] - wall.x[0]).norm(), then = (wall.x[j] + Point(0, 0, 0.2) - wall.x[0]).norm();
    if (std::min(now, then) < radius) {
      EXPECT_TRUE(kept.count(j)) << j;
      met += now > radius ? 1 : 0;
    } else if (std::min(now, then) > 1.1 * radius) {
      EXPECT_FALSE(kept.count(j)) << j;
      ++left;
    }
  }
  EXPECT_GT(met, 0U);
  EXPECT_GT(left, 0U);
}

TEST(SleepCriterion, BoundsTheCompressionOfThoseKept) {
  Wall wall(1.5, 0.8 * Tensor::Identity());
  const auto verdict = wall.judge();
  ASSERT_GT(verdict.kept, 0U);
  EXPECT_NEAR(verdict.compression, 1.25 * 1.01, 1e-9) << "with the strain that is allowed for";
}

TEST(SleepCriterion, LeavesOutWhatIsFlattened) {
  Wall wall(1.2);
  const auto whole = wall.judge();
  Index nearest = 0;
  for (const Index j : wall.masters)
    if (nearest == 0 || (wall.x[j] - wall.x[0]).norm() < (wall.x[nearest] - wall.x[0]).norm()) nearest = j;
  wall.F[nearest].col(2).setZero();
  wall.measure();
  const auto verdict = wall.judge();
  EXPECT_EQ(verdict.kept, whole.kept - 1);
  EXPECT_EQ(std::count(wall.kept.begin(), wall.kept.end(), nearest), 0);
}

TEST(SleepCriterion, BoundsStretchesAlongTheNormal) {
  const auto rests = [](const Point& of_slave, const Point& of_wall) {
    Wall wall(1.3, of_wall.asDiagonal());
    wall.F[0] = of_slave.asDiagonal();
    for (int k = 0; k < 8; ++k) wall.measure();
    return wall.judge().rest > 0;
  };
  const Point same(1, 1, 1);
  EXPECT_TRUE(rests(Point(1.5, 1, 1), same)) << "a slave that is long beside the wall";
  EXPECT_FALSE(rests(Point(1, 1, 1.8), same)) << "and towards it";
  EXPECT_TRUE(rests(same, Point(1 / 1.5, 1, 1))) << "a wall that is narrow";
  EXPECT_FALSE(rests(same, Point(1, 1, 1.5))) << "and that is thick";
}

TEST(SleepCriterion, AllowsForATurnOfTheNormal) {
  for (const bool of_wall : {false, true}) {
    // Long along the wall, or narrow and therefore wide if it were turned.
    Wall wall(1.2);
    wall.x[0][0] = 0;  // where the normal is upright even though the wall is rough
    for (std::size_t i = 0; i < wall.F.size(); ++i)
      if ((i > 0) == of_wall) wall.F[i](0, 0) = of_wall ? 1 / 2.5 : 2.5;
    for (int k = 0; k < 8; ++k) wall.measure();
    EXPECT_EQ(wall.judge().rest, 0) << of_wall;
    for (int k = 0; k < 3; ++k) (void)wall.judge();
    EXPECT_GT(wall.judge().rest, 0) << of_wall << ": once the wall was seen not to turn";
  }
}

TEST(SleepCriterion, IsLateIfATrustedWallHasTurnedFurther) {
  for (const double angle : {0.1, 0.4}) {
    Wall wall(1.3);
    wall.F[0] = Eigen::Vector3d(1.5, 1, 1).asDiagonal();
    for (int k = 0; k < 8; ++k) wall.measure();
    ASSERT_GT(wall.judge().rest, 0);
    EXPECT_FALSE(wall.criterion.is_late(0));
    Tensor turn = Tensor::Identity();
    turn(1, 1) = turn(2, 2) = std::cos(angle);
    turn(1, 2) = -(turn(2, 1) = std::sin(angle));
    for (Point& x : wall.x) x = turn * x;
    for (Tensor& F : wall.F) F = turn * F;
    wall.measure();
    wall.bounds.limit_travel(0.1, 8);  // otherwise nothing would be kept out
    (void)wall.judge();
    EXPECT_EQ(wall.criterion.is_late(0), angle > 0.2) << angle;
    wall.criterion.resize(1);
    (void)wall.judge();
    EXPECT_FALSE(wall.criterion.is_late(0)) << "nothing is known about this slave";
  }
}

}  // namespace sleep_criterion_test
