// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/facing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace facing_test {

using Facing = hmps::detail::Facing<double, 2>;

/// The unit vector at the angle whose chord from the x axis is `chord`.
hmps::Vector<double, 2> at(double chord) {
  const double angle = 2 * std::asin(0.5 * chord);
  return {std::cos(angle), std::sin(angle)};
}

TEST(Facing, AllowsAMultipleOfTheLatestTurn) {
  Facing facing;
  facing.update(at(0), 1);
  EXPECT_EQ(facing.turn(), Facing::first_turn);
  facing.update(at(0.1), 2);
  EXPECT_NEAR(facing.turn(), 0.8, 1e-12) << "four times the turn, as the next interval is twice as long";
  facing.update(at(0), 0.5);
  EXPECT_NEAR(facing.turn(), 0.4, 1e-12) << "half of what it was before, which is more";
}

TEST(Facing, AllowsALeastTurn) {
  Facing facing;
  for (const double turn : {0.2, 0.1, 0.05, Facing::least_turn, Facing::least_turn}) {
    facing.update(at(0), 1);
    EXPECT_DOUBLE_EQ(facing.turn(), turn);
  }
}

TEST(Facing, IsLateIfATrustedNormalHasTurnedFurther) {
  for (const bool trusted : {false, true})
    for (const double turn : {0.19, 0.21}) {
      Facing facing;
      facing.update(at(0), 1);
      facing.trust(trusted);
      EXPECT_FALSE(facing.is_late());
      facing.update(at(turn), 1);
      EXPECT_EQ(facing.is_late(), trusted && turn > Facing::first_turn) << turn;
      facing.update(at(turn), 1);
      EXPECT_FALSE(facing.is_late()) << "reported only once";
    }
}

TEST(Facing, StartsAnewWhereNoNormalWasAskedFor) {
  Facing facing;
  facing.update(at(0), 1);
  facing.trust(true);
  facing.update(at(0.5), 1);
  ASSERT_TRUE(facing.is_late());
  facing.forget();
  EXPECT_FALSE(facing.is_late());
  facing.update(at(1.5), 1);
  EXPECT_FALSE(facing.is_late()) << "its previous direction is not known";
  EXPECT_EQ(facing.turn(), Facing::first_turn);
}

}  // namespace facing_test
