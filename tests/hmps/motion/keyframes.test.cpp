// SPDX-License-Identifier: MIT
#include "hmps/motion/keyframes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "../../reference/message_of.hpp"

namespace keyframes_test {

using hmps_test::message_of;

using hmps::Keyframe;
using hmps::Keyframes;
using hmps::Track;

const Track steps{{0.5, 0.0}, {1.0, 1.0}, {1.2, 4.0}, {1.5, 4.0}, {2.0, 3.5}, {2.05, 0.0}};

TEST(Keyframes, PassesThroughItsKeysAndIsConstantOutside) {
  for (const auto& key : steps.keys()) EXPECT_DOUBLE_EQ(steps.value(key.time), key.value);
  EXPECT_EQ(steps.value(-10), 0.0);
  EXPECT_EQ(steps.value(10), 0.0);
  EXPECT_EQ(steps(1.2), steps.value(1.2));
  EXPECT_EQ(steps.rate(-10), 0.0);
  EXPECT_EQ(steps.rate(10), 0.0);
}

TEST(Keyframes, NeverOvershootsAndHoldsPlateaus) {
  const auto& keys = steps.keys();
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const double low = std::min(keys[k].value, keys[k + 1].value), high = std::max(keys[k].value, keys[k + 1].value);
    double last = keys[k].value;
    for (int n = 0; n <= 100; ++n) {
      const double value = steps.value(keys[k].time + (keys[k + 1].time - keys[k].time) * n / 100);
      EXPECT_GE(value, low - 1e-14);
      EXPECT_LE(value, high + 1e-14);
      if (keys[k].value < keys[k + 1].value) {
        EXPECT_GE(value, last - 1e-14);
      } else {
        EXPECT_LE(value, last + 1e-14);
      }
      last = value;
    }
  }
  for (double t = 1.2; t <= 1.5; t += 0.01) EXPECT_EQ(steps.value(t), 4.0);
}

TEST(Keyframes, RateIsTheDerivativeAndContinuous) {
  const double h = 1e-6;
  for (double t = 0.403; t < 2.2; t += 0.0107) {
    // For a cubic, the error is its third derivative, below 1e6, times h^2 / 6, plus rounding.
    EXPECT_NEAR(steps.rate(t), (steps.value(t + h) - steps.value(t - h)) / (2 * h), 1e-5) << t;
  }
  for (const auto& key : steps.keys()) {
    // Across a key the rate changes by no more than the second derivative, below 1e4, times 2 h.
    EXPECT_NEAR(steps.rate(key.time - 1e-9), steps.rate(key.time + 1e-9), 1e-4) << key.time;
    if (key.time == 0.5 || key.time == 2.05) {
      EXPECT_EQ(steps.rate(key.time), 0.0);
    }
  }
}

TEST(Keyframes, KeepsStraightLinesStraightAwayFromTheEnds) {
  const Track line{{0.0, 0.0}, {1.0, 2.0}, {3.0, 6.0}, {4.0, 8.0}, {6.0, 12.0}};
  for (double t = 1; t <= 4; t += 0.125) {
    EXPECT_NEAR(line.value(t), 2 * t, 1e-13);
    EXPECT_NEAR(line.rate(t), 2, 1e-13);
  }
}

TEST(Keyframes, VectorsAreTracksSideBySide) {
  std::vector<Keyframe<3>> keys;
  for (const auto& key : steps.keys()) keys.push_back({key.time, {key.value, 0.0, -2 * key.value}});
  const Keyframes<3> vector(keys);
  for (double t = 0.4; t < 2.2; t += 0.013) {
    EXPECT_NEAR(vector.value(t)[0], steps.value(t), 1e-14);
    EXPECT_EQ(vector.value(t)[1], 0.0);
    EXPECT_NEAR(vector.rate(t)[2], -2 * steps.rate(t), 1e-10);
  }
}

TEST(Keyframes, OneKeyIsAConstant) {
  const Keyframes<2> fixed{{1.0, {3.0, 4.0}}};
  for (const double t : {-1.0, 1.0, 2.0}) {
    EXPECT_EQ(fixed.value(t)[1], 4.0);
    EXPECT_EQ(fixed.rate(t)[0], 0.0);
  }
}

TEST(Keyframes, RefusesDisorderAndNamesTheKey) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Track(std::vector<Keyframe<1>>{}), hmps::InputError);
  const auto twice = message_of([] { Track{{0.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}}; });
  EXPECT_NE(twice.find("keyframe 2 at 1 s follows one at 1 s"), std::string::npos) << twice;
  EXPECT_NE(message_of([] { Track{{0.0, 0.0}, {-1.0, 1.0}}; }).find("keyframe 1"), std::string::npos);
  EXPECT_NE(message_of([&] { Track{{nan, 0.0}}; }).find("keyframe 0"), std::string::npos);
  EXPECT_NE(message_of([&] { Keyframes<2>{{0.0, {0.0, nan}}}; }).find("component 1 of keyframe 0"), std::string::npos);
}

// Values and rates between them used to be NaN or infinite.
TEST(Keyframes, RefusesRatesBeyondTheRangeOfADouble) {
  for (const std::vector<Keyframe<1>>& keys : {std::vector<Keyframe<1>>{{0.0, 0.0}, {1.0, -1e306}, {2.0, 1e308}},
                                               {{0.0, 0.0}, {1.0, 0.0}, {1.5e308, 1.0}},
                                               {{-2.0, 0.0}, {0.0, 0.0}, {5e-324, 1.0}},
                                               {{-1.0, 0.0}, {0.0, 0.0}, {1e-300, 1e10}}}) {
    const std::string text = message_of([&] { Track{keys}; });
    EXPECT_NE(text.find("to keyframe 2 at"), std::string::npos) << text;
    EXPECT_NE(text.find("exceed the range of a double"), std::string::npos) << text;
  }
  const std::string rate = message_of([] { Track{{0.0, 0.0}, {1e-160, 1e10}, {2e-160, 2e10}}; });
  EXPECT_NE(rate.find("the rate of component 0 at keyframe 1"), std::string::npos) << rate;
  const std::string text = message_of([] { Keyframes<2>{{0.0, {0.0, -1e308}}, {1.0, {0.0, 1e308}}}; });
  EXPECT_NE(text.find("component 1 changes from -1e+308 to 1e+308"), std::string::npos) << text;

  const Track largest{{0.0, 0.0}, {1.0, 1e306}, {3.0, 2e306}, {1e307, 1e307}, {2e307, 3e307}};
  for (const double t : {0.5, 1.0, 2.0, 2.999, 1e306, 1.5e307}) {
    EXPECT_TRUE(std::isfinite(largest.value(t))) << t;
    EXPECT_TRUE(std::isfinite(largest.rate(t))) << t;
  }
}

TEST(Keyframes, RefusesATimeAfterAMove) {
  Track first{{0.0, 0.0}, {1.0, 1.0}};
  const Track second = std::move(first);
  EXPECT_EQ(second(0.5), 0.5);
  EXPECT_THROW((void)first(0.5), hmps::InputError);       // NOLINT(bugprone-use-after-move)
  EXPECT_THROW((void)first.rate(0.5), hmps::InputError);  // NOLINT(bugprone-use-after-move)
}

}  // namespace keyframes_test
