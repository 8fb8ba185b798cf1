// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/active_rows.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace active_rows_test {

using hmps::Index;
using List = std::vector<Index>;

/// Two organs of the particles 10, 11, 12 and 20, 21, 22, which have the numbers 0 to 5.
hmps::detail::OrganPairs organs() {
  const List one{10, 11, 12}, other{20, 21, 22};
  hmps::detail::OrganPairs pairs;
  const auto a = pairs.add_organ({.name = "one", .slaves = one, .masters = one}, 1);
  pairs.add_pair(a, pairs.add_organ({.name = "other", .slaves = other, .masters = other}, 1), {});
  pairs.number_particles();
  return pairs;
}

TEST(ActiveRows, NumberWhatIsAwakeAndKnowTheRowsOfEach) {
  const auto pairs = organs();
  hmps::detail::ActiveRows<double> list;
  for (int time = 0; time < 2; ++time) {  // the second time reuses the memory
    list.clear();
    const List first{3, 4}, second{4}, third{2};
    list.add(0, 0, 7, 1.5, first.data(), first.data() + 2);
    list.add(2, 0, 8, 2.5, second.data(), second.data() + 1);
    list.add(4, 1, 9, 3.5, third.data(), third.data() + 1);
    list.finish(pairs);
    ASSERT_EQ(list.rows().size(), 4U);
    List particles, of_rows, masters;
    for (const auto& own : list.awake()) particles.push_back(own.particle);
    particles.pop_back();
    EXPECT_EQ(particles, (List{10, 12, 20, 21}));
    for (std::size_t r = 0; r < 3; ++r) of_rows.push_back(list.awake()[list.rows()[r].slave].particle);
    EXPECT_EQ(of_rows, (List{10, 12, 21}));
    for (const Index j : list.master_of()) masters.push_back(list.awake()[j].particle);
    EXPECT_EQ(masters, (List{20, 21, 21, 12}));
    EXPECT_EQ(list.rows()[1].slot, 8U);
    EXPECT_EQ(list.rows()[2].compression, 3.5);
    // Particle 21 is awake as number 3: slave of the last row, master of the first two.
    const auto &own = list.awake()[3], &next = list.awake()[4];
    ASSERT_EQ(next.rows - own.rows, 1U);
    EXPECT_EQ(list.slave_rows()[own.rows], 2U);
    ASSERT_EQ(next.entries - own.entries, 2U);
    EXPECT_EQ(list.entry_rows()[own.entries], 0U);
    EXPECT_EQ(list.entry_rows()[own.entries + 1], 1U);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& of = list.awake()[list.master_of()[k]];
      EXPECT_GE(list.entry_of()[k], of.entries);
    }
  }
}

TEST(ActiveRows, MayBeEmpty) {
  hmps::detail::ActiveRows<float> list;
  list.finish(organs());
  EXPECT_EQ(list.rows().size(), 1U);
  EXPECT_EQ(list.awake().size(), 1U);
}

}  // namespace active_rows_test
