// SPDX-License-Identifier: MIT
#include "hmps/contact/contact_history.hpp"

#include <gtest/gtest.h>

namespace {

using History = hmps::detail::ContactHistory<3>;
const hmps::Vector<float, 3> up(0, 0, 1), down(0, 0, -1), aside(1, 0, 0);

TEST(ContactHistory, SeesThatAWallHasTurnedRound) {
  History history;
  history.resize(2);
  EXPECT_FALSE(history.turned_round(0, up, false));
  history.next_call();
  EXPECT_FALSE(history.turned_round(0, aside, true)) << "a quarter is not round";
  history.next_call();
  EXPECT_TRUE(history.turned_round(0, down, true)) << "since it was last not inside";
  EXPECT_FALSE(history.turned_round(1, down, true)) << "another slave";
}

TEST(ContactHistory, ForgetsWhatDidNotTouchInTheCallBefore) {
  History history;
  history.resize(1);
  EXPECT_FALSE(history.turned_round(0, up, false));
  history.next_call();
  history.next_call();
  EXPECT_FALSE(history.turned_round(0, down, true));
}

TEST(ContactHistory, TakesTheSideOfASlaveThatIsNotInside) {
  History history;
  history.resize(1);
  EXPECT_FALSE(history.turned_round(0, up, false));
  history.next_call();
  EXPECT_TRUE(history.turned_round(0, down, false));
  history.next_call();
  EXPECT_FALSE(history.turned_round(0, down, true)) << "its side is the other one since";
}

}  // namespace
