// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/wall_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>
#include <vector>

#include "hmps/core/executor.hpp"
#include "hmps/core/view.hpp"

namespace wall_motion_test {

using hmps::Index;

/// Adds a master to `wall`.
template <class S, int D>
void add(hmps::detail::WallMotion<S, D>& wall, S w, const hmps::Vector<S, D>& r, const hmps::Vector<S, D>& moved) {
  hmps::detail::Quad<S> place, motion;
  hmps::detail::set_quad<S>(r, place);
  hmps::detail::set_quad<S>(moved, motion);
  wall.add(w, place, motion);
}

/// A turn by `angle` (rad) about a fixed axis.
template <class S, int D>
hmps::Matrix<S, D> turn(S angle) {
  if constexpr (D == 2) {
    return Eigen::Rotation2D<S>(angle).toRotationMatrix();
  } else {
    return Eigen::AngleAxis<S>(angle, hmps::Vector<S, 3>(S(0.6), S(-0.48), S(0.64))).toRotationMatrix();
  }
}

template <class S, int D>
void recovers_a_rigid_motion() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0, 1);
  const S spacing = S(2e-3), angle = S(0.02);
  const hmps::Matrix<S, D> R = turn<S, D>(angle);
  // A point moves from `from` to R from + shift, in spacings from a fixed point; the slave moves with the wall.
  const hmps::Vector<S, D> slave = hmps::Vector<S, D>::Constant(S(3)), shift = hmps::Vector<S, D>::Constant(S(0.1));
  const auto moved = [&](const hmps::Vector<S, D>& from) { return (R * from - from + shift).eval(); };
  hmps::detail::WallMotion<S, D> wall(spacing);
  for (int k = 0; k < 16; ++k) {
    hmps::Vector<S, D> x;
    for (int c = 0; c < D; ++c) x[c] = static_cast<S>(c == D - 1 ? -1 - u(random) : 4 * u(random) - 2);
    add<S, D>(wall, S(1) / S(16), x + S(0.5) * (moved(slave + x) - moved(slave)), spacing * moved(slave + x));
  }
  wall.finish();
  const S rounding = 100 * std::numeric_limits<S>::epsilon();  // of lengths of up to 5 spacings
  EXPECT_LT((wall.moved() - spacing * moved(slave)).norm(), rounding * spacing);
  EXPECT_GT(wall.by_turning().norm(), S(0.5) * angle * spacing) << "otherwise the bound above proves nothing";
  const hmps::Vector<S, D> vector = hmps::Vector<S, D>::Unit(0);
  EXPECT_LT((wall.turned(vector) - R * vector).norm(), S(0.3) * angle * angle * angle + rounding);
  EXPECT_NEAR(wall.turned(vector).norm(), 1, 4 * std::numeric_limits<S>::epsilon());
}

TEST(WallMotion, RecoversARigidMotion) {
  recovers_a_rigid_motion<double, 3>();
  recovers_a_rigid_motion<float, 3>();
  recovers_a_rigid_motion<double, 2>();
}

/// One master determines no rotation, two determine none about the line between them.
TEST(WallMotion, OfFewMastersIsTheirMean) {
  using Point = hmps::Vector<double, 3>;
  hmps::detail::WallMotion<double, 3> one(1), line(1);
  add<double, 3>(one, 1, Point(0.3, 0.2, -1), Point(1e-6, 2e-6, 0));
  one.finish();
  EXPECT_LT((one.moved() - Point(1e-6, 2e-6, 0)).norm(), 1e-8);
  for (const double x : {-1., 1.}) add<double, 3>(line, 0.5, Point(x, 0, -1), Point(1e-6, 0, 0));
  line.finish();
  EXPECT_LT((line.moved() - Point(1e-6, 0, 0)).norm(), 1e-8);
}

TEST(WallMotion, AcrossKeepsTheLength) {
  using Point = hmps::Vector<double, 3>;
  const Point across = hmps::detail::WallMotion<double, 3>::across(Point(3, 0, 0.1), Point(0, 0, 1));
  EXPECT_NEAR((across - Point(Point(3, 0, 0.1).norm(), 0, 0)).norm(), 0, 1e-15);
  EXPECT_EQ((hmps::detail::WallMotion<double, 3>::across(Point::Zero(), Point(0, 0, 1))), Point::Zero());
}

TEST(ParticleMotion, IsThatSinceTheCallBefore) {
  struct Awake {
    Index particle;
  };
  using Point = hmps::Vector<double, 3>;
  std::vector<Point> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const std::vector<Index> particle{0, 2, 3};
  hmps::detail::ParticleMotion<float, 3> motion;
  motion.choose(particle, std::vector<Awake>{{2}, {3}, {0}});  // the last one is not a particle
  motion.update(hmps::vectors(x), particle, hmps::Serial{});
  EXPECT_EQ(motion.moved(0)[0], 0) << "there was no call before";
  EXPECT_EQ(motion.between(0, 1), (hmps::Vector<float, 3>(1, 0, 0)));
  x[2][1] = 0.5;
  motion.update(hmps::vectors(x), particle, hmps::Serial{});
  EXPECT_EQ(motion.moved(0)[1], 0.5F);
  EXPECT_EQ(motion.moved(1)[1], 0);
  motion.update(hmps::vectors(x), particle, hmps::Serial{});
  EXPECT_EQ(motion.moved(0)[1], 0);
}

}  // namespace wall_motion_test
