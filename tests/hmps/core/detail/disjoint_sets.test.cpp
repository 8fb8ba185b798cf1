// SPDX-License-Identifier: MIT
#include "hmps/core/detail/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace disjoint_sets_test {

using hmps::Index;
using hmps::detail::DisjointSets;

TEST(DisjointSets, AreWhatIsJoinedDirectlyOrThroughOthers) {
  DisjointSets sets(7);
  for (Index i = 0; i < 7; ++i) EXPECT_EQ(sets.lowest(i), i);
  sets.join(5, 3);
  sets.join(3, 1);
  sets.join(1, 5);
  sets.join(0, 6);
  sets.join(4, 4);
  const Index expected[] = {0, 1, 2, 1, 4, 1, 0};
  for (Index i = 0; i < 7; ++i) EXPECT_EQ(sets.lowest(i), expected[i]) << i;
}

// Labels that are replaced one by one, in any order of the joins.
TEST(DisjointSets, AreThoseOfLabels) {
  constexpr std::size_t n = 200;
  std::mt19937 random(7);
  std::vector<std::pair<Index, Index>> joins;
  for (int k = 0; k < 120; ++k) joins.emplace_back(static_cast<Index>(random() % n), static_cast<Index>(random() % n));
  std::vector<Index> label(n);
  for (Index i = 0; i < n; ++i) label[i] = i;
  for (const auto& [a, b] : joins) {
    const Index kept = std::min(label[a], label[b]), lost = std::max(label[a], label[b]);
    std::replace(label.begin(), label.end(), lost, kept);
  }
  for (int repeat = 0; repeat < 5; ++repeat) {
    std::shuffle(joins.begin(), joins.end(), random);
    DisjointSets sets(n);
    for (const auto& [a, b] : joins) sets.join(a, b);
    for (Index i = 0; i < n; ++i) ASSERT_EQ(sets.lowest(i), label[i]) << i;
  }
}

}  // namespace disjoint_sets_test
