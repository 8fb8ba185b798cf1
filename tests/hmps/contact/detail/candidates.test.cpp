// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "hmps/contact/bodies.hpp"
#include "hmps/core/executor.hpp"

namespace candidates_test {

using hmps::Index;
using Lists = hmps::detail::Candidates<double, 3, hmps::SmoothMetaball>;
using Pile = bodies::Pile<double, 3>;
using Pairs = std::vector<std::pair<Index, Index>>;

template <class L>
std::size_t declare(L& lists, const Pile& pile, const hmps::PairSettings& settings = {}) {
  const auto a =
      lists.add_organ({.name = "plate", .slaves = pile.plate.top, .masters = pile.plate.upper, .prescribed = {}});
  const auto b =
      lists.add_organ({.name = "block", .slaves = pile.block.bottom, .masters = pile.block.lower, .prescribed = {}});
  return lists.add_pair(a, b, settings);
}

template <class L>
Pairs listed(const L& lists) {
  Pairs pairs;
  for (std::size_t r = 0; r + 1 < lists.active().rows().size(); ++r)
    for (Index k = lists.active().rows()[r].begin; k < lists.active().rows()[r + 1].begin; ++k)
      pairs.emplace_back(lists.active().awake()[lists.active().rows()[r].slave].particle,
                         lists.active().awake()[lists.active().master_of()[k]].particle);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// The pairs with c > 0 of the slaves that touch, which no list may miss.
Pairs touching(const Pile& pile) {
  const hmps::NormalDensity<double, 3, hmps::SmoothMetaball> Z(pile.l0);
  Pairs pairs;
  const auto side = [&](const std::vector<Index>& slaves, const std::vector<Index>& masters) {
    for (const Index i : slaves) {
      double C = 0;
      Pairs mine;
      for (const Index j : masters) {
        const double s =
            (hmps::inverse<double, 3>(pile.F[j]) * (pile.x[j] - pile.x[i])).squaredNorm() / std::pow(2.5 * pile.l0, 2);
        if (s >= 1) continue;
        C += hmps::SmoothMetaball::value(s);
        mine.emplace_back(i, j);
      }
      // A touch needs R < l0 for particles that hardly deform.
      if (Z.inverse(C).reached && Z.inverse(C).value < 0.95 * pile.l0)
        pairs.insert(pairs.end(), mine.begin(), mine.end());
    }
  };
  side(pile.plate.top, pile.block.lower);
  side(pile.block.bottom, pile.plate.upper);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(Candidates, NeverMissATouchWhileBodiesMove) {
  Pile pile(3.5);
  Lists lists(1e-3, 0.5e-3);
  declare(lists, pile);
  pile.shake(0, 0.03, 1);
  const double dt = 1e-5;
  std::size_t met = 0, slept = 0;
  const hmps::Serial serial;
  for (int step = 0; step < 4000; ++step) {
    // Down, along and up again, at up to 0.5 m/s, with particles shaking on top.
    const hmps::Vector<double, 3> drive(0.2, 0.1, -0.5 * std::sin(2 * 3.14159265 * step / 4000));
    for (const Index i : pile.block.all) pile.v[i] = drive + 0.1 * std::sin(0.05 * step + i) * drive;
    for (std::size_t i = 0; i < pile.x.size(); ++i) pile.x[i] += pile.v[i] * dt;
    const bool chosen = lists.update(hmps::vectors(pile.x), hmps::matrices(pile.F), serial);
    if (step % 20 != 0) continue;
    const Pairs have = listed(lists), need = touching(pile);
    ASSERT_TRUE(std::includes(have.begin(), have.end(), need.begin(), need.end())) << "step " << step;
    met += need.size();
    slept += !chosen;
  }
  EXPECT_GT(met, 10000U) << "the bodies were meant to meet";
  EXPECT_GT(slept, 50U) << "most steps are meant to reuse the lists";
  EXPECT_EQ(lists.late(), 0U);
  EXPECT_LT(lists.checks(), 800U);
  EXPECT_LT(lists.rebuilds(), 100U);
}

/// The mean number of awake rows while both bodies move together at 0.5 m/s.
double awake_rows(Pile pile) {
  Lists lists(1e-3, 0.5e-3);
  declare(lists, pile);
  double rows = 0;
  constexpr int steps = 600;
  for (int step = 0; step < steps; ++step) {
    for (auto& x : pile.x) x[0] += 0.5 * 1e-5;
    lists.update(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{});
    if (step >= steps / 2) rows += static_cast<double>(lists.active().rows().size() - 1) / (steps - steps / 2);
  }
  EXPECT_EQ(lists.late(), 0U);
  return rows;
}

TEST(Candidates, SleepWhereOrgansMoveTogether) {
  // A tenth of a spacing from touching, and a tenth deep.
  EXPECT_EQ(awake_rows(Pile(1.1)), 0);
  EXPECT_GT(awake_rows(Pile(0.9)), 1);
}

TEST(Candidates, SleepBesideWhatIsStretchedAlongItsWall) {
  // 1.5 times as long both ways along the wall and thinner by as much: near only if stretched towards the other body.
  Pile pile(1.2);
  for (auto& F : pile.F) F.diagonal() << 1.5, 1.5, 1 / 2.25;
  EXPECT_EQ(awake_rows(pile), 0);
  for (auto& F : pile.F) F.diagonal() << 1 / 1.5, 1, 1.5;
  EXPECT_GT(awake_rows(pile), 1);
}

TEST(Candidates, AreOrderedAndTransposedConsistently) {
  Pile pile(0.8);
  Lists lists(1e-3, 0.5e-3);
  declare(lists, pile);
  lists.update(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{});
  ASSERT_GT(lists.active().rows().size(), 10U);
  for (std::size_t r = 0; r + 1 < lists.active().rows().size(); ++r)
    for (Index k = lists.active().rows()[r].begin + 1; k < lists.active().rows()[r + 1].begin; ++k)
      EXPECT_LT(lists.active().master_of()[k - 1], lists.active().master_of()[k]);
  std::size_t entries = 0, rows = 0;
  for (std::size_t t = 0; t + 1 < lists.active().awake().size(); ++t) {
    if (t > 0) {
      EXPECT_LT(lists.active().awake()[t - 1].particle, lists.active().awake()[t].particle);
    }
    for (Index e = lists.active().awake()[t].entries; e < lists.active().awake()[t + 1].entries; ++e, ++entries) {
      const auto& row = lists.active().rows()[lists.active().entry_rows()[e]];
      const Index end = lists.active().rows()[lists.active().entry_rows()[e] + 1].begin;
      std::size_t same = 0;
      for (Index k = row.begin; k < end; ++k)
        same += lists.active().entry_of()[k] == e && lists.active().master_of()[k] == t;
      EXPECT_EQ(same, 1U);
      if (e > lists.active().awake()[t].entries) {
        EXPECT_LT(lists.active().entry_rows()[e - 1], lists.active().entry_rows()[e]);
      }
    }
    for (Index q = lists.active().awake()[t].rows; q < lists.active().awake()[t + 1].rows; ++q, ++rows)
      EXPECT_EQ(lists.active().rows()[lists.active().slave_rows()[q]].slave, t);
  }
  EXPECT_EQ(entries, lists.active().master_of().size());
  EXPECT_EQ(rows, lists.active().rows().size() - 1);
}

TEST(Candidates, FollowTheStretchOfTheMaster) {
  Pile pile(2.2);
  bodies::Scene<double, 3>::Tensor tall = bodies::Scene<double, 3>::Tensor::Identity();
  tall(2, 2) = 2.5;
  Lists plain(1e-3, 0.1e-3), stretched(1e-3, 0.1e-3);
  declare(plain, pile);
  declare(stretched, pile);
  const hmps::Serial serial;
  plain.update(hmps::vectors(pile.x), hmps::matrices(pile.F), serial);
  EXPECT_TRUE(listed(plain).empty());
  for (const Index i : pile.plate.upper) pile.F[i] = tall;
  stretched.update(hmps::vectors(pile.x), hmps::matrices(pile.F), serial);
  EXPECT_FALSE(listed(stretched).empty());
  // The same if the stretch comes later, once both lists have seen that it stays.
  plain.check(hmps::vectors(pile.x), hmps::matrices(pile.F), serial);
  EXPECT_TRUE(std::ranges::includes(listed(plain), listed(stretched)));
  for (int k = 0; k < 20; ++k)
    for (Lists* lists : {&plain, &stretched}) lists->check(hmps::vectors(pile.x), hmps::matrices(pile.F), serial);
  EXPECT_EQ(listed(plain), listed(stretched));
}

TEST(Candidates, LeaveOutWhatIsExcluded) {
  Pile pile(0.8);
  const Index slave = pile.block.bottom[5];
  const std::vector<Index> out{slave};
  Lists by_slave(1e-3, 0.5e-3), by_pair(1e-3, 0.5e-3), one_way(1e-3, 0.5e-3);
  declare(by_slave, pile, {.roles = hmps::Roles::both, .excluded_slaves = out, .excluded = {}});
  declare(by_pair, pile,
          {.roles = hmps::Roles::both, .excluded_slaves = {}, .excluded = [&](Index, Index j) { return j == slave; }});
  declare(one_way, pile, {.roles = hmps::Roles::only_second_is_slave, .excluded_slaves = {}, .excluded = {}});
  for (Lists* lists : {&by_slave, &by_pair, &one_way})
    lists->update(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{});
  for (const auto& [i, j] : listed(by_slave)) EXPECT_NE(i, slave);
  bool is_slave = false;
  for (const auto& [i, j] : listed(by_pair)) {
    EXPECT_NE(j, slave);
    is_slave = is_slave || i == slave;
  }
  EXPECT_TRUE(is_slave);
  EXPECT_FALSE(listed(one_way).empty());
  for (const auto& [i, j] : listed(one_way)) EXPECT_GE(i, pile.plate.all.size());
}

TEST(Candidates, ReportWhatIsNotFinite) {
  Pile pile(0.8);
  Lists lists(1e-3, 0.5e-3);
  declare(lists, pile);
  const hmps::Serial serial;
  pile.x[pile.block.bottom[3]][1] = std::numeric_limits<double>::quiet_NaN();
  try {
    lists.update(hmps::vectors(pile.x), hmps::matrices(pile.F), serial);
    FAIL() << "a NaN went unseen";
  } catch (const hmps::StateError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(std::to_string(pile.block.bottom[3])), std::string::npos) << text;
    EXPECT_NE(text.find("block"), std::string::npos) << text;
  }
}

TEST(Candidates, StartAnewAfterWhatWasNotFinite) {
  Pile pile(0.8);
  Lists lists(1e-3, 0.5e-3), other(1e-3, 0.5e-3);
  declare(lists, pile);
  declare(other, pile);
  const auto x = pile.x;
  pile.x[pile.block.bottom[3]][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(lists.update(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{}), hmps::StateError);
  pile.x = x;
  for (Lists* each : {&lists, &other}) each->update(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{});
  EXPECT_EQ(listed(lists), listed(other));
  EXPECT_EQ(lists.rebuilds(), 1U);
}

TEST(Candidates, StartAnewAfterAStateInMidRunThatWasNotFinite) {
  Pile pile(0.8);
  Lists lists(1e-3, 0.5e-3), other(1e-3, 0.5e-3);
  declare(lists, pile);
  const auto update = [&](Lists& each) { each.update(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{}); };
  update(lists);
  update(lists);
  const auto x = pile.x;
  for (const hmps::Index i : pile.block.bottom) pile.x[i][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(lists.check(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{}), hmps::StateError);
  pile.x = x;
  declare(other, pile);
  for (int call = 0; call < 3; ++call) {
    update(lists);
    update(other);
    EXPECT_EQ(listed(lists), listed(other)) << call;
  }
}

TEST(Candidates, TakeInAnOrganThatIsAddedLater) {
  Pile pile(0.8);
  Lists lists(1e-3, 0.5e-3), other(1e-3, 0.5e-3);
  const auto update = [&](Lists& each) { each.update(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{}); };
  const auto a = lists.add_organ({.name = "plate", .slaves = pile.plate.top, .masters = pile.plate.upper});
  update(lists);
  EXPECT_TRUE(listed(lists).empty());
  lists.add_pair(a, lists.add_organ({.name = "block", .slaves = pile.block.bottom, .masters = pile.block.lower}), {});
  update(lists);
  declare(other, pile);
  update(other);
  EXPECT_EQ(listed(lists), listed(other));
}

TEST(Candidates, CountChecksThatCameLate) {
  Pile pile(0.8);
  Lists lists(1e-3, 0.5e-3);
  declare(lists, pile);
  const auto check = [&] { lists.check(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{}); };
  check();
  check();
  EXPECT_EQ(lists.late(), 0U);
  pile.F[pile.block.bottom[5]] *= 1.3;
  check();
  EXPECT_EQ(lists.late(), 1U);
  check();
  EXPECT_EQ(lists.late(), 1U);
}

TEST(Candidates, BuildTheBroadPhaseListAnewOnceItIsUsedUpOrRefreshed) {
  Pile pile(3);
  Lists lists(1e-3, 0.5e-3);
  declare(lists, pile);
  const auto check = [&](double by) {
    for (const Index i : pile.block.all) pile.x[i][0] += by;
    for (int k = 0; k < 2; ++k) lists.check(hmps::vectors(pile.x), hmps::matrices(pile.F), hmps::Serial{});
    return lists.rebuilds();
  };
  EXPECT_EQ(check(0), 1U);
  EXPECT_EQ(check(0.02e-3), 1U);
  EXPECT_EQ(check(0.5e-3), 2U);
  lists.refresh();
  EXPECT_EQ(check(0), 3U);
  EXPECT_EQ(lists.checks(), 8U);
}

}  // namespace candidates_test
