// SPDX-License-Identifier: MIT
// The results of a restricted force are tested in internal_force.use.test.cpp.
#include "hmps/force/detail/restricted_blocks.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <vector>

#include "../../../reference/scenes.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/executor.hpp"

namespace restricted_blocks_test {

using Bonds = hmps::LatticeBonds<double, 2>;

// The sum needs the blocks of the particles that move, the coupling also those of their neighbours, the dilatation
// those of three rings of neighbours.
TEST(RestrictedBlocks, GrowByTheNeighboursThatEachSweepReads) {
  const auto points = scenes::box<2>({64, 9});
  const Bonds bonds(hmps::vectors(points), {.spacing = scenes::Scene<2>::spacing});
  hmps::detail::RestrictedBlocks<Bonds> blocks;
  const hmps::Serial execute;
  const auto visited = [&](auto sweep) {
    std::set<std::size_t> found;
    sweep([&](std::size_t block) { EXPECT_TRUE(found.insert(block).second); });
    return found;
  };
  const auto summed = [&](auto visit) { blocks.summed(bonds, execute, visit); };
  const auto coupled = [&](auto visit) { blocks.coupled(bonds, execute, visit); };
  const auto dilated = [&](auto visit) { blocks.dilated(bonds, execute, visit); };
  EXPECT_EQ(visited(summed).size(), bonds.block_count());
  EXPECT_EQ(visited(dilated).size(), bonds.block_count());
  EXPECT_EQ(blocks.bytes(), 0u);

  std::set<std::size_t> moving{7};
  blocks.restrict_to(
      bonds, [](std::size_t i) { return i == 7; }, 1);
  const auto of = [&](const std::set<std::size_t>& particles) {
    std::set<std::size_t> found;
    for (const std::size_t i : particles) found.insert(bonds.slot(i) / Bonds::width);
    return found;
  };
  const auto grow = [&] {
    for (const std::size_t i : std::set<std::size_t>(moving))
      bonds.for_each_bond(i, [&](std::size_t j, const auto&, double) { moving.insert(j); });
  };
  EXPECT_EQ(visited(summed), of(moving));
  grow();
  EXPECT_EQ(visited(coupled), of(moving));
  grow();
  grow();
  EXPECT_EQ(visited(dilated), of(moving));
  EXPECT_LT(visited(dilated).size(), bonds.block_count());
  blocks.restrict_to(
      bonds, [](std::size_t i) { return i == 7; }, 2);
  grow();
  grow();
  EXPECT_EQ(visited(dilated), of(moving)) << "a second mean needs two rings more";
  EXPECT_LT(visited(dilated).size(), bonds.block_count());
  EXPECT_GT(blocks.bytes(), 0u);
}

}  // namespace restricted_blocks_test
