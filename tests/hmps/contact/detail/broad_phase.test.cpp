// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/broad_phase.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace broad_phase_test {

using hmps::Index;
using hmps::detail::BroadPhase;
using Point = hmps::Vector<double, 3>;
using Pairs = std::vector<std::pair<Index, Index>>;

constexpr double radius = 1, margin = 0.5;

/// Two clouds of particles side by side that overlap a little.
struct Clouds {
  hmps::detail::OrganPairs organs;
  std::vector<Point> place;
  std::vector<double> reach, compression;
  explicit Clouds(double apart, const hmps::PairSettings& settings = {}) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(0, 4);
    std::vector<Index> lists[2];
    for (int cloud = 0; cloud < 2; ++cloud)
      for (int k = 0; k < 150; ++k) {
        lists[cloud].push_back(static_cast<Index>(place.size()));
        place.emplace_back(u(random) + cloud * (4 + apart), u(random), u(random));
        reach.push_back(radius * (0.5 + 0.25 * u(random)));
        compression.push_back(k % 10 == 0 ? -1 : 1);  // some form no wall
      }
    const auto a = organs.add_organ({.name = "a", .slaves = lists[0], .masters = lists[0]}, 1);
    organs.add_pair(a, organs.add_organ({.name = "b", .slaves = lists[1], .masters = lists[1]}, 1), settings);
    organs.number_particles();
  }
  [[nodiscard]] BroadPhase<double, 3> build(bool backwards = false) const {
    BroadPhase<double, 3> list;
    list.build({organs, place, reach, compression, radius, margin}, [&](std::size_t n, const auto& body) {
      for (std::size_t k = 0; k < n; ++k) body(backwards ? n - 1 - k : k);
    });
    return list;
  }
};

Pairs listed(const BroadPhase<double, 3>& list) {
  Pairs pairs;
  for (std::size_t r = 0; r + 1 < list.rows().size(); ++r)
    for (Index k = list.rows()[r].begin; k < list.rows()[r + 1].begin; ++k)
      pairs.emplace_back(list.rows()[r].slave, list.masters()[k]);
  return pairs;
}

TEST(BroadPhase, ListsAllWithinReachAndMarginAndNoMore) {
  const Clouds clouds(-1);
  Pairs expected;
  for (Index i = 0; i < 300; ++i)
    for (Index j = 0; j < 300; ++j)
      if ((i < 150) != (j < 150) && clouds.compression[j] > 0 &&
          (clouds.place[i] - clouds.place[j]).norm() <= clouds.reach[j] + margin)
        expected.emplace_back(i, j);
  EXPECT_GT(expected.size(), 200U);
  // In the order of sides, slaves and masters, whatever the executor.
  EXPECT_EQ(listed(clouds.build()), expected);
  EXPECT_EQ(listed(clouds.build(true)), expected);
}

TEST(BroadPhase, KnowsTheRowsThatEachParticleIsIn) {
  const auto list = Clouds(-1).build();
  for (Index i = 0; i < 300; ++i) {
    std::vector<Index> rows;
    for (std::size_t r = 0; r + 1 < list.rows().size(); ++r) {
      const auto first = list.masters().begin() + list.rows()[r].begin,
                 last = list.masters().begin() + list.rows()[r + 1].begin;
      if (list.rows()[r].slave == i || std::find(first, last, i) != last) rows.push_back(static_cast<Index>(r));
    }
    const std::vector<Index> have(list.rows_of().begin() + list.rows_of_begin(i),
                                  list.rows_of().begin() + list.rows_of_begin(i + 1));
    EXPECT_EQ(have, rows) << i;
  }
}

TEST(BroadPhase, BearsAsMuchMotionAsLiesBetweenTheOrgans) {
  for (const double apart : {-1., 1., 20.}) {
    const auto list = Clouds(apart).build();
    for (std::size_t side = 0; side < 2; ++side) {
      EXPECT_GE(list.limit(side), 0.99 * margin) << apart;
      EXPECT_LE(list.limit(side), std::max(margin, apart)) << apart;
      if (apart > 10) {
        EXPECT_GE(list.limit(side), apart - 2 * radius) << apart;
      }
    }
  }
}

TEST(BroadPhase, LeavesOutWhatIsExcluded) {
  std::vector<Index> out;
  for (Index i = 0; i < 150; i += 2) out.push_back(i);
  const auto odd = [](Index, Index j) { return j % 2 == 1; };
  const Clouds clouds(-1, {.excluded_slaves = out, .excluded = odd});
  const Pairs pairs = listed(clouds.build());
  EXPECT_GT(pairs.size(), 50U);
  for (const auto& [i, j] : pairs) {
    EXPECT_TRUE(i >= 150 || i % 2 == 1) << i;
    EXPECT_EQ(j % 2, 0U);
  }
}

}  // namespace broad_phase_test
