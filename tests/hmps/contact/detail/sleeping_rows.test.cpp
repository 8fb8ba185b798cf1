// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/sleeping_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

#include "hmps/contact/bodies.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/view.hpp"

namespace sleeping_rows_test {

using hmps::Index;
using Ball = hmps::SmoothMetaball;
using Point = hmps::Vector<double, 3>;
using List = std::vector<Index>;

constexpr double l0 = 1e-3, bound = 0.15 * l0;

/// A pile with its broad-phase list. Every particle may deviate by `bound` from a drift of `speed` (m per call) along
/// the plate.
struct Rows {
  bodies::Pile<double, 3> pile;
  bodies::Loops loops;
  hmps::detail::OrganPairs organs;
  hmps::detail::ParticleBounds<double, 3> particles{l0, Ball::radius* l0};
  hmps::detail::BroadPhase<double, 3> list;
  hmps::NormalDensity<double, 3, Ball> density{l0};
  hmps::detail::SleepingRows<double, 3, Ball> sleeping;
  bool is_late = false;

  explicit Rows(double gap, double speed = 0, bool backwards = false, bool has_one_slave = false)
      : pile(gap), loops{.backwards = backwards} {
    const List one{pile.block.bottom[5]}, none;
    const auto a = organs.add_organ(
        {.name = "plate", .slaves = has_one_slave ? none : pile.plate.top, .masters = pile.plate.upper}, l0);
    const auto b = organs.add_organ({.name = "block",
                                     .slaves = has_one_slave ? one : pile.block.bottom,
                                     .masters = has_one_slave ? none : pile.block.lower},
                                    l0);
    organs.add_pair(a, b, {.roles = has_one_slave ? hmps::Roles::only_second_is_slave : hmps::Roles::both});
    organs.number_particles();
    particles.resize(organs.particle().size());
    measure(true);
    for (int k = 0; k < 4; ++k) {
      move(8 * speed);
      measure(false);
    }
    list.build({organs, particles.place(), particles.reach(), particles.compression(), particles.radius(), l0},
               [&](std::size_t n, const auto& body) { loops(n, body); });
    sleeping.resize(organs.slots());
    move((bound - 0.01 * l0) / 2 + 8 * speed);
    measure(false);
    // From now on, all of this motion is drift.
    step = pile.x[0] - before;
    is_late = sleeping.put_to_sleep(source(), {8, 8}, loops);
  }
  Point before = Point::Zero(), step = Point::Zero();
  void move(double by) {
    before = pile.x[0];
    for (Point& x : pile.x) x[0] += by;
  }
  void measure(bool is_first) {
    (void)particles.measure(
        hmps::vectors(pile.x), hmps::matrices(pile.F), organs.particle(), is_first, {8, 8},
        [](std::size_t) { return true; }, loops);
    particles.limit_travel(1, 8);
  }
  [[nodiscard]] hmps::detail::SleepingRows<double, 3, Ball>::Source source() const {
    return {organs, list, particles, density};
  }
  /// Watches `calls` calls after the check, with all particles on their drift except `i`, which is `by` m off.
  bool watch(std::size_t calls, Index i, double by) {
    const auto home = pile.x;
    for (Point& x : pile.x) x += static_cast<double>(calls) / 8 * step;
    pile.x[i][1] += by;
    const bool fits = sleeping.watch(source(), hmps::vectors(pile.x), calls, loops);
    pile.x = home;
    return fits;
  }
  /// The slaves of the rows that are awake, ascending.
  [[nodiscard]] std::set<Index> awake(std::size_t* candidates = nullptr) const {
    hmps::detail::ActiveRows<double> active;
    sleeping.list_awake(list, active);
    active.finish(organs);
    std::set<Index> slaves;
    for (std::size_t r = 0; r + 1 < active.rows().size(); ++r)
      slaves.insert(active.awake()[active.rows()[r].slave].particle);
    if (candidates != nullptr) *candidates = active.master_of().size();
    return slaves;
  }
  /// The slaves of the rows that particle `i` is in.
  [[nodiscard]] std::set<Index> slaves_of(Index i) const {
    std::set<Index> slaves;
    const auto number = static_cast<std::size_t>(
        std::lower_bound(organs.particle().begin(), organs.particle().end(), i) - organs.particle().begin());
    for (Index q = list.rows_of_begin(number); q < list.rows_of_begin(number + 1); ++q)
      slaves.insert(organs.particle()[list.rows()[list.rows_of()[q]].slave]);
    return slaves;
  }
};

TEST(SleepingRows, SleepWhereBodiesAreApart) {
  const Rows apart(1.8), touching(0.9);
  EXPECT_FALSE(apart.is_late);
  EXPECT_TRUE(apart.awake().empty());
  ASSERT_FALSE(apart.list.masters().empty());
  EXPECT_FALSE(touching.awake().empty());
  EXPECT_LT(touching.awake().size(), touching.list.rows().size() - 1);
  EXPECT_EQ(apart.sleeping.woken() + touching.sleeping.woken(), 0U);
}

TEST(SleepingRows, WakeByWhatTheirParticlesDeviate) {
  std::set<double> shares;
  for (double gap = 1; gap < 2; gap += 0.05) {
    const Rows rows(gap);
    const Index i = rows.pile.block.bottom[5];
    const std::set<Index> first = rows.awake(), own = rows.slaves_of(i);
    std::set<Index> last = first;
    for (const double share : {0.2, 0.27, 0.45, 0.55, 0.95}) {
      Rows now = rows;
      ASSERT_TRUE(now.watch(3, i, share * bound)) << gap;
      const std::set<Index> awake = now.awake();
      EXPECT_TRUE(std::includes(awake.begin(), awake.end(), last.begin(), last.end())) << gap << " " << share;
      for (const Index slave : awake)
        EXPECT_TRUE(first.count(slave) || own.count(slave)) << "rows of other particles do not wake";
      if (awake != last) shares.insert(share);
      last = awake;
    }
  }
  EXPECT_EQ(shares, (std::set<double>{0.27, 0.55})) << "rows wake at a quarter and at half of the bound";
}

TEST(SleepingRows, WakeByEachOfTheirParticles) {
  std::size_t woken = 0;
  for (double gap = 1.05; gap < 1.6; gap += 0.05) {
    const Rows rows(gap, 0, false, true);  // of one row
    const auto wakes = [&](Index i) {
      Rows now = rows;
      EXPECT_TRUE(now.watch(1, i, 0.55 * bound));
      return now.awake();
    };
    std::vector<std::set<Index>> by(rows.pile.x.size());
    for (const Index i : rows.organs.particle()) by[i] = wakes(i);
    const Index slave = rows.pile.block.bottom[5];
    for (const Index j : rows.pile.plate.upper)
      if (by[slave].count(slave) &&
          (rows.pile.x[slave] - rows.pile.x[j]).norm() < (Ball::radius + 0.25) * l0) {  // kept
        EXPECT_TRUE(by[j].count(slave)) << gap << ": " << slave << " by " << j;
        woken += rows.awake().count(slave) ? 0u : 1u;
      }
  }
  EXPECT_GT(woken, 0U);
}

TEST(SleepingRows, WakeOneAfterAnother) {
  std::size_t later = 0;
  for (double gap = 1.05; gap < 1.8; gap += 0.05) {
    Rows rows(gap);
    const Index i = rows.pile.block.bottom[5];
    std::size_t before = 0, after = 0, all = 0;
    (void)rows.awake(&before);
    Rows at_once = rows;
    ASSERT_TRUE(rows.watch(1, i, 0.3 * bound));
    const std::size_t woken = rows.sleeping.woken();
    ASSERT_TRUE(rows.watch(2, i, 0.6 * bound));
    ASSERT_TRUE(at_once.watch(2, i, 0.6 * bound));
    EXPECT_EQ(rows.awake(&after), at_once.awake(&all)) << gap;
    EXPECT_EQ(after, all);
    EXPECT_EQ(rows.sleeping.woken(), after - before) << "candidates of rows that woke";
    later += rows.sleeping.woken() > woken ? 1u : 0u;
    ASSERT_TRUE(rows.watch(3, i, 0.1 * bound));
    EXPECT_EQ(rows.sleeping.woken(), after - before) << "they stay awake";
    (void)rows.sleeping.put_to_sleep(rows.source(), {8, 8}, rows.loops);
    EXPECT_EQ(rows.sleeping.woken(), 0U);
    (void)rows.awake(&after);
    EXPECT_EQ(after, before);
  }
  EXPECT_GT(later, 0U);
}

TEST(SleepingRows, MayDriftAsLongAsTheyWill) {
  for (const double speed : {0., 0.02 * l0}) {
    Rows rows(1.3, speed);
    const auto first = rows.awake();
    for (std::size_t calls = 1; calls < 100; calls += 9) EXPECT_TRUE(rows.watch(calls, 0, 0));
    EXPECT_EQ(rows.awake(), first);
  }
}

TEST(SleepingRows, AskForACheckWhereABoundIsExceeded) {
  const Rows rows(1.8);
  const Index i = rows.pile.plate.top[44];
  Rows within = rows, beyond = rows, lost = rows;
  EXPECT_TRUE(within.watch(1, i, 0.99 * bound));
  EXPECT_FALSE(beyond.watch(1, i, 1.01 * bound));
  EXPECT_FALSE(lost.watch(1, i, std::numeric_limits<double>::quiet_NaN()));
}

TEST(SleepingRows, AreTheSameInAnyOrder) {
  for (const double gap : {1.1, 1.2, 1.3}) {
    Rows one(gap), other(gap, 0, true);
    EXPECT_EQ(one.awake(), other.awake());
    const Index i = one.pile.block.bottom[6];
    for (Rows* rows : {&one, &other}) ASSERT_TRUE(rows->watch(1, i, 0.6 * bound));
    std::size_t candidates = 0, of_other = 0;
    EXPECT_EQ(one.awake(&candidates), other.awake(&of_other));
    EXPECT_EQ(candidates, of_other);
  }
}

TEST(SleepingRows, AreLateIfAWallHasTurnedFurther) {
  std::size_t late = 0;
  for (const double angle : {0.1, 0.5}) {
    Rows rows(1.3);
    // Slaves that are long along the wall, so that they sleep only because of its normal.
    for (auto& F : rows.pile.F) F(0, 0) = 1.5;
    for (int k = 0; k < 8; ++k) rows.measure(false);
    EXPECT_FALSE(rows.sleeping.put_to_sleep(rows.source(), {8, 8}, rows.loops));
    hmps::Matrix<double, 3> turn = hmps::Matrix<double, 3>::Identity();
    turn(1, 1) = turn(2, 2) = std::cos(angle);
    turn(1, 2) = -(turn(2, 1) = std::sin(angle));
    const Point centre = rows.pile.x[rows.pile.block.bottom[5]];
    for (Point& x : rows.pile.x) x = centre + turn * (x - centre);
    for (auto& F : rows.pile.F) F = turn * F;
    rows.measure(false);
    rows.particles.limit_travel(0.1 * l0, 8);
    const bool is_late = rows.sleeping.put_to_sleep(rows.source(), {8, 8}, rows.loops);
    EXPECT_FALSE(is_late && angle < 0.2);
    late += is_late ? 1 : 0;
  }
  EXPECT_EQ(late, 1U);
}

}  // namespace sleeping_rows_test
