// SPDX-License-Identifier: MIT
#include "hmps/analysis/lattice_shift.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lattice_shift_test {

using namespace hmps;

TEST(LatticeShift, ShiftsByHalfASpacingAlongEachAxis) {
  const auto space = lattice_shifts(0.5);
  ASSERT_EQ(space.size(), 4u);
  EXPECT_EQ(space[0], (Vector<double, 3>(0, 0, 0)));
  EXPECT_EQ(space[3], (Vector<double, 3>(0, 0, 0.25)));
  EXPECT_EQ(lattice_shifts<2>(0.5).size(), 3u);
  EXPECT_THROW((void)lattice_shifts(0), InputError);
}

TEST(LatticeShift, TheErrorBarContainsEveryResult) {
  const auto spread = lattice_spread(1, [](const auto& origin) { return 10 + 4 * origin[0] - 2 * origin[2]; });
  EXPECT_EQ(spread.values, (std::vector<double>{10, 12, 10, 9}));
  EXPECT_DOUBLE_EQ(spread.mean, 10.25);
  EXPECT_DOUBLE_EQ(spread.error, 1.75);
  const auto none = lattice_spread(1, [](const auto&) { return 0.1; });
  EXPECT_EQ(none.mean, 0.1);
  EXPECT_EQ(none.error, 0);
  EXPECT_THROW((void)lattice_spread<2>(1, [](const auto&) { return std::numeric_limits<double>::quiet_NaN(); }),
               InputError);
}

}  // namespace lattice_shift_test
