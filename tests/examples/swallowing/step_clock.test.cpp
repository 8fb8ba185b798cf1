// SPDX-License-Identifier: MIT
#include "simulation/step_clock.hpp"

#include <gtest/gtest.h>

namespace step_clock_test {

using swallowing::StepClock;

TEST(StepClock, StepsDivideTheBeat) {
  EXPECT_EQ(StepClock::dividing(3e-5), 1e-3 / 34);
  EXPECT_EQ(StepClock::dividing(2.5e-4), 2.5e-4);
  EXPECT_EQ(StepClock::dividing(1), 1e-3);
}

TEST(StepClock, ContinuesWhenTheStepChanges) {
  StepClock clock(StepClock::dividing(3e-5));
  for (int k = 0; k < 20 * 34; ++k) clock.advance();
  EXPECT_NEAR(clock.time(), 20e-3, 1e-15);
  clock.change(StepClock::dividing(2e-5));
  EXPECT_EQ(clock.time(), 20e-3) << "rounding is left behind";
  EXPECT_EQ(clock.step(), 2e-5);
  clock.advance();
  EXPECT_EQ(clock.time(), 20e-3 + 2e-5);
  EXPECT_EQ(clock.steps(), 20u * 34 + 1);
}

TEST(StepClock, CountsFromZeroWhileTheStepStays) {
  StepClock clock(3e-5);  // which divides no beat
  for (int k = 0; k < 100000; ++k) clock.advance();
  EXPECT_EQ(clock.time(), 100000 * 3e-5);
}

}  // namespace step_clock_test
