// SPDX-License-Identifier: MIT
#include "output/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace progress_test {

using swallowing::Progress;

TEST(Progress, WritesAPlainLineForEveryTwentieth) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, {.name = "X1", .until = 2.0, .particles = 1000}, [&] { return now; });
  for (int step = 1; step <= 2000; ++step) {
    now += 0.005;  // 1 s of simulated time in 5 s
    progress.update(1e-3 * step, static_cast<std::uint64_t>(step), 0.9);
  }
  progress.finish(2.0, 2000, 0.9);
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 20);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_NE(text.find("X1  50 %  1.000 s  200 kparticle-steps/s  5 s left  J > 0.900\n"), std::string::npos) << text;
}

TEST(Progress, DrawsOverOneLineOfATerminalAtTheMostTenTimesASecond) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, {.name = "Y3", .until = 2.0, .particles = 10, .terminal = true, .width = 100},
                    [&] { return now; });
  for (int step = 1; step <= 1000; ++step) {
    now += 0.001;
    progress.update(1e-3 * step, static_cast<std::uint64_t>(step), 0.95);
  }
  const std::string before = out.str();
  const auto lines = std::count(before.begin(), before.end(), '\r');
  EXPECT_GE(lines, 5);
  EXPECT_LE(lines, 10);
  EXPECT_EQ(before.find('\n'), std::string::npos);
  progress.finish(1.0, 1000, 0.95);
  EXPECT_EQ(out.str().back(), '\n');
}

TEST(Progress, TimeLeftOfAResumedRunCountsFromItsStart) {
  std::ostringstream out;
  double now = 100;
  Progress progress(out, {.name = "X1", .start = 1.0, .until = 2.0, .particles = 1}, [&] { return now; });
  now = 110;
  progress.update(1.5, 500, 1);
  EXPECT_NE(out.str().find(" 10 s left"), std::string::npos) << out.str();
}

TEST(Progress, FormatsDurationsAndNumbers) {
  EXPECT_EQ(swallowing::duration(0.4), "0 s");
  EXPECT_EQ(swallowing::duration(185), "3 min 05 s");
  EXPECT_EQ(swallowing::duration(2 * 3600 + 7 * 60), "2 h 07 min");
  EXPECT_EQ(swallowing::duration(1e300), "?");
  EXPECT_EQ(swallowing::with_prefix(12), "12 ");
  EXPECT_EQ(swallowing::with_prefix(1234567), "1.23 M");
  EXPECT_EQ(swallowing::with_prefix(22.4e6), "22.4 M");
}

}  // namespace progress_test
