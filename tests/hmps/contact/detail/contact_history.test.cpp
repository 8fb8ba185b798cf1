// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/contact_history.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace contact_history_test {

using History = hmps::detail::ContactHistory<3>;
const hmps::Vector<float, 3> up(0, 0, 1), down(0, 0, -1), aside(1, 0, 0);

TEST(ContactHistory, SeesThatAWallHasTurnedRound) {
  History history;
  history.resize(2);
  EXPECT_FALSE(history.turned_round(0, up, false));
  history.next_call();
  EXPECT_FALSE(history.turned_round(0, aside, true)) << "a quarter turn is not a reversal";
  history.next_call();
  EXPECT_TRUE(history.turned_round(0, down, true)) << "reversed since it was last not inside";
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
  EXPECT_FALSE(history.turned_round(0, down, true)) << "it has been on the other side since then";
}

TEST(ContactHistory, KeepsElasticSlipWhileTheSlaveTouches) {
  hmps::detail::ContactHistory<3, hmps::detail::ElasticSlip<double, 3>> history;
  history.resize(2);
  (void)history.turned_round(0, up, false);
  EXPECT_TRUE(history.slip(0).starts);
  history.slip(0) = {hmps::Vector<double, 3>(1, 2, 3), false};
  history.next_call();
  (void)history.turned_round(0, up, false);
  EXPECT_FALSE(history.slip(0).starts);
  EXPECT_EQ(history.slip(0).value, (hmps::Vector<double, 3>(1, 2, 3)));
  history.next_call();
  history.next_call();
  (void)history.turned_round(0, up, false);
  EXPECT_TRUE(history.slip(0).starts) << "it was off the wall for a call";
  EXPECT_EQ(history.slip(0).value, (hmps::Vector<double, 3>(0, 0, 0)));
}

static_assert(std::is_empty_v<hmps::detail::NoSlip>, "friction without a spring takes no memory");

}  // namespace contact_history_test
