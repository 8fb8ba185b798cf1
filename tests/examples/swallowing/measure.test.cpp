// SPDX-License-Identifier: MIT
#include "output/measure.hpp"

#include <gtest/gtest.h>

#include <array>

namespace measure_test {

using swallowing::angle_above_horizontal;
using swallowing::FoldTime;
using Point = std::array<double, 3>;

TEST(Measure, AngleIsThatOfTheSagittalPlane) {
  EXPECT_DOUBLE_EQ(angle_above_horizontal(Point{0, 0, 0}, Point{1, 0, 1}), 45);
  EXPECT_DOUBLE_EQ(angle_above_horizontal(Point{1, 2, 3}, Point{2, 7, 3}), 0);
  EXPECT_DOUBLE_EQ(angle_above_horizontal(Point{0, 0, 0}, Point{0, 0, 2}), 90);
  EXPECT_DOUBLE_EQ(angle_above_horizontal(Point{0, 0, 0}, Point{1, 0, -1}), -45);
  EXPECT_DOUBLE_EQ(angle_above_horizontal(Point{0, 0, 0}, Point{-1, 0, 1}), 135);
}

TEST(Measure, FoldTimeLiesWhereTheLinePassesZero) {
  FoldTime fold;
  fold.add(1.0, 60);
  fold.add(1.6, 3);
  EXPECT_FALSE(fold.time());
  fold.add(1.7, -1);
  ASSERT_TRUE(fold.time());
  EXPECT_DOUBLE_EQ(*fold.time(), 1.675);
  fold.add(1.8, -20);
  fold.add(1.9, 10);
  fold.add(2.0, -10);
  EXPECT_DOUBLE_EQ(*fold.time(), 1.675) << "the first time counts";
  EXPECT_EQ(fold.smallest(), -20);
}

TEST(Measure, TouchingTheHorizontalIsNotAFold) {
  FoldTime fold;
  for (const double angle : {30., 5., 0., 0., 12.}) fold.add(1 + angle / 100, angle);
  EXPECT_FALSE(fold.time());
  EXPECT_EQ(fold.smallest(), 0);
}

TEST(Measure, FoldFromTheHorizontalBeginsThere) {
  FoldTime fold;
  fold.add(1.0, 0);
  fold.add(1.1, -4);
  EXPECT_DOUBLE_EQ(fold.time().value(), 1.0);
  FoldTime folded_at_once;
  folded_at_once.add(0.5, -1);
  EXPECT_EQ(folded_at_once.time().value(), 0.5);
}

TEST(Measure, IsEmptyWithoutSamples) {
  EXPECT_FALSE(FoldTime().time());
  EXPECT_TRUE(std::isnan(FoldTime().smallest()));
}

}  // namespace measure_test
