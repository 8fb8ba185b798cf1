// SPDX-License-Identifier: MIT
#include "hmps/bonds/detail/lattice_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "reference/scenes.hpp"

namespace lattice_rows_test {

template <class K>
class LatticeRows : public testing::Test {
 public:
  using Rows = hmps::detail::LatticeRows<K, 3>;
  static constexpr std::size_t slots = 40 * Rows::width;

  /// For each offset, a random share of the slots has a neighbour: the next one of a rising sequence. The shorter the
  /// `longest` stretch without a gap, the more runs there are.
  static std::vector<typename Rows::Placed> random_runs(std::size_t longest) {
    scenes::Random random(11);
    std::vector<typename Rows::Placed> placed;
    for (std::uint16_t offset = 0; offset < 26; ++offset) {
      const unsigned direction = offset * Rows::directions / 26;
      std::size_t neighbour = 0, stretch = 0;
      for (std::size_t s = 0; s < slots && neighbour < slots; ++s, ++neighbour) {
        if (stretch-- == 0) {
          stretch = 1 + static_cast<std::size_t>(random() * static_cast<double>(longest));
          (random() < 0.5 ? s : neighbour) += static_cast<std::size_t>(random() * 4);
          if (s >= slots || neighbour >= slots) break;
        }
        const auto first = static_cast<std::int32_t>(neighbour) - static_cast<std::int32_t>(s % Rows::width);
        const std::size_t group = s / Rows::width * Rows::directions + direction;
        if (placed.empty() || placed.back().group != group || placed.back().run.first != first ||
            placed.back().run.offset != offset)
          placed.push_back({group, {first, 0, offset}});
        placed.back().run.lanes = static_cast<std::uint16_t>(placed.back().run.lanes | 1u << s % Rows::width);
      }
    }
    return placed;
  }

  /// The bonds of each slot in the order of the rows: offset and slot of the neighbour.
  static std::vector<std::vector<std::pair<std::uint16_t, std::size_t>>> bonds(const Rows& rows) {
    std::vector<std::vector<std::pair<std::uint16_t, std::size_t>>> all(slots);
    for (std::size_t block = 0; block < slots / Rows::width; ++block)
      for (std::size_t group = block * Rows::directions; group < (block + 1) * Rows::directions; ++group)
        for (const auto* row = rows.begin(group); row != rows.end(group); ++row)
          for (std::size_t l = 0; l < Rows::width; ++l)
            if ((row->lanes >> l & 1u) != 0)
              all[block * Rows::width + l].emplace_back(row->offset, rows.neighbour(block, row, l));
    return all;
  }

  static std::size_t count(const Rows& rows) {
    return static_cast<std::size_t>(rows.begin(slots / Rows::width * Rows::directions) - rows.begin(0));
  }
  static std::size_t windows(const Rows& rows) {
    std::size_t found = 0;
    for (std::size_t block = 0; block < slots / Rows::width; ++block) found += rows.has_windows(block) ? 1u : 0u;
    return found;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(LatticeRows, Scalars);

// The bits of a force depend on the order in which a particle meets its bonds, so windows must not change it.
TYPED_TEST(LatticeRows, WindowsHoldTheBondsOfTheRunsInTheirOrder) {
  using Held = typename TestFixture::Rows;
  for (const std::size_t longest : {2u, 4u, 40u}) {
    const auto placed = TestFixture::random_runs(longest);
    const Held runs(placed, TestFixture::slots / Held::width, false),
        mixed(placed, TestFixture::slots / Held::width, true);
    EXPECT_EQ(TestFixture::windows(runs), 0u);
    EXPECT_EQ(TestFixture::count(runs), placed.size());
    EXPECT_EQ(TestFixture::bonds(mixed), TestFixture::bonds(runs)) << longest;
  }
}

TYPED_TEST(LatticeRows, OnlyBlocksWithManyRunsHaveWindows) {
  using Held = typename TestFixture::Rows;
  constexpr std::size_t blocks = TestFixture::slots / Held::width;
  const auto shattered = TestFixture::random_runs(2);
  const Held windows(shattered, blocks, true);
  EXPECT_GT(TestFixture::windows(windows), blocks * 3 / 4);
  EXPECT_LT(TestFixture::count(windows), shattered.size() / 2);
  EXPECT_GT(windows.bytes(), Held({}, blocks, true).bytes() + TestFixture::count(windows) * sizeof(typename Held::Row));
  // One run for each offset: nothing to gain.
  std::vector<typename Held::Placed> whole;
  for (std::uint16_t offset = 0; offset < 20; ++offset)
    whole.push_back({offset % Held::directions, {offset - 3, 0xf0, offset}});
  const Held runs(whole, blocks, true);
  EXPECT_EQ(TestFixture::windows(runs), 0u);
  EXPECT_EQ(TestFixture::count(runs), whole.size());
}

}  // namespace lattice_rows_test
