// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/check_schedule.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace check_schedule_test {

using hmps::detail::CheckInterval;
using hmps::detail::CheckSchedule;

/// The calls until a check is due, with `woken` candidates awake in each.
std::size_t calls_until_due(CheckSchedule& schedule, std::size_t woken, std::size_t cost) {
  for (std::size_t calls = 1; calls < 1000; ++calls) {
    const bool is_due = schedule.count_call(woken, cost);
    EXPECT_EQ(schedule.interval().since, calls);
    if (is_due) return calls;
  }
  return 0;
}

TEST(CheckInterval, ComparesWhatIsToComeWithWhatHasBeen) {
  EXPECT_EQ((CheckInterval{4, 10}.ratio<double>()), 2.5);
  EXPECT_EQ((CheckInterval{16, 4}.ratio<float>()), 0.25F);
  EXPECT_EQ((CheckInterval{0, 8}.ratio<double>()), 8) << "two checks in one call";
}

TEST(CheckSchedule, EndsAnIntervalAfterSoManyCalls) {
  CheckSchedule schedule;
  EXPECT_EQ(calls_until_due(schedule, 0, 100), CheckSchedule::longest);
  schedule.choose_interval(9, 25);  // 8 * 25 / 10
  EXPECT_EQ(schedule.interval().until, 20U);
  EXPECT_EQ(schedule.interval().since, CheckSchedule::longest);
  schedule.start_interval();
  EXPECT_EQ(schedule.interval().since, 0U);
  EXPECT_EQ(calls_until_due(schedule, 0, 100), 20U);
}

TEST(CheckSchedule, ChoosesAnIntervalWithinLimits) {
  CheckSchedule schedule;
  schedule.choose_interval(1000, 10);
  EXPECT_EQ(schedule.interval().until, CheckSchedule::shortest);
  schedule.choose_interval(0, 1000);
  EXPECT_EQ(schedule.interval().until, CheckSchedule::longest);
}

TEST(CheckSchedule, EndsAnIntervalWhenWokenRowsHaveCostMoreThanACheck) {
  CheckSchedule schedule;
  EXPECT_EQ(calls_until_due(schedule, 5, 10), 3U) << "10 after two calls is not more than 10";
  schedule.start_interval();
  EXPECT_EQ(calls_until_due(schedule, 5, 10), 3U) << "what earlier intervals cost does not count";
}

TEST(CheckSchedule, LimitsTravel) {
  CheckSchedule schedule;
  schedule.limit_travel(0., 1.);
  schedule.limit_travel(1. / CheckSchedule::longest, 1.);
  EXPECT_EQ(schedule.interval().until, CheckSchedule::longest);
  schedule.limit_travel(0.0625, 1.);
  EXPECT_EQ(schedule.interval().until, 16U);
  schedule.limit_travel(0.03125, 1.);
  EXPECT_EQ(schedule.interval().until, 16U) << "never longer";
  schedule.limit_travel(10., 1.);
  EXPECT_EQ(schedule.interval().until, CheckSchedule::shortest);
}

}  // namespace check_schedule_test
