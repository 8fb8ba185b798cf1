// SPDX-License-Identifier: MIT
#include "hmps/core/trial.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace trial_test {

using hmps::Trial, hmps::detail::present_trial;

TEST(Trial, IsOneWithThoseWithinIt) {
  EXPECT_EQ(present_trial, 0U);
  std::uint64_t first = 0;
  {
    const Trial outer;
    first = present_trial;
    EXPECT_NE(first, 0U);
    {
      const Trial inner;
      EXPECT_EQ(present_trial, first);
    }
    EXPECT_EQ(present_trial, first);
  }
  EXPECT_EQ(present_trial, 0U);
  const Trial next;
  EXPECT_NE(present_trial, first) << "one after the other are two";
}

TEST(Trial, IsOfItsThread) {
  const Trial trial;
  std::uint64_t other = 1;
  std::thread([&] { other = present_trial; }).join();
  EXPECT_EQ(other, 0U);
}

}  // namespace trial_test
