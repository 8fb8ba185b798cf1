// SPDX-License-Identifier: MIT
#include "hmps/bonds/weight.hpp"

#include <gtest/gtest.h>

namespace weight_test {

// Eq. (8).
TEST(PaperWeight, IsTheRadiusOverTheDistanceLessOne) {
  constexpr hmps::PaperWeight w;
  static_assert(w(1.0, 1.75) == 0.75);
  static_assert(w(0.5f, 1.75f) == 2.5f);
  EXPECT_DOUBLE_EQ(w(1.4, 1.75), 0.25);
}

TEST(PaperWeight, VanishesAtTheRadiusBeyondItAndAtTheParticleItself) {
  constexpr hmps::PaperWeight w;
  EXPECT_EQ(w(1.75, 1.75), 0.0);
  EXPECT_EQ(w(1.7501, 1.75), 0.0);
  EXPECT_EQ(w(0.0, 1.75), 0.0);
}

static_assert(hmps::paper_radius_ratio == 1.75);

}  // namespace weight_test
