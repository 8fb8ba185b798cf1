// SPDX-License-Identifier: MIT
#include "hmps/lanes/detail/pieces.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace pieces_test {

using hmps::Index;
using hmps::detail::DisjointSets;
using hmps::detail::no_index;
using hmps::detail::Pieces;

TEST(Pieces, AreWhatBondsJoinDirectlyOrThroughOthers) {
  DisjointSets joined(7);
  joined.join(5, 3);
  joined.join(3, 1);
  joined.join(1, 5);
  joined.join(0, 6);
  // In the order of the slots: 5, 6, 3, 2, 4, 1, 0, and an empty one.
  const Pieces pieces(joined, {5, 6, 3, 2, 4, 1, 0, no_index});
  EXPECT_EQ(pieces.middle(), (std::vector<Index>{3, 0, 2, 4}));
  for (const auto& [slot, piece] : std::vector<std::pair<std::size_t, Index>>{{0, 0}, {1, 1}, {2, 0}, {3, 2}, {6, 1}})
    EXPECT_EQ(pieces.of(slot), piece) << slot;
  EXPECT_GT(pieces.bytes(), 0U);
}

TEST(Pieces, StoreNothingIfThereIsOnlyOne) {
  DisjointSets joined(3);
  joined.join(0, 2);
  joined.join(2, 1);
  const Pieces pieces(joined, {2, 0, 1, no_index});
  EXPECT_TRUE(pieces.middle().empty());
  EXPECT_EQ(pieces.bytes(), 0U);
  DisjointSets none(0);
  EXPECT_TRUE(Pieces(none, std::vector<Index>()).middle().empty());
}

}  // namespace pieces_test
