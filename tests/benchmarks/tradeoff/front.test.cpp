// SPDX-License-Identifier: MIT
#include "tradeoff/front.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

namespace front_test {

using tradeoff::pareto_front;
using tradeoff::Point;
using Numbers = std::vector<std::size_t>;

Numbers front(const std::vector<Point>& points) { return pareto_front(points); }

TEST(Front, OmitsDominatedPoints) {
  EXPECT_EQ(front({{1, 9}, {2, 5}, {3, 6}, {4, 1}}), (Numbers{0, 1, 3}));
  EXPECT_EQ(front({{4, 1}, {3, 6}, {2, 5}, {1, 9}}), (Numbers{3, 2, 0}));
}
TEST(Front, HandlesNoPointAndOnePoint) {
  EXPECT_TRUE(front({}).empty());
  EXPECT_EQ(front({{0, 0}}), Numbers{0});
}
TEST(Front, KeepsTheBetterOfTwoAtTheSameCost) { EXPECT_EQ(front({{1, 3}, {1, 2}, {2, 1}}), (Numbers{1, 2})); }
TEST(Front, KeepsTheCheaperOfTwoWithTheSameError) { EXPECT_EQ(front({{2, 3}, {1, 3}, {3, 1}}), (Numbers{1, 2})); }
TEST(Front, KeepsTheFirstOfEqualPoints) { EXPECT_EQ(front({{5, 5}, {1, 2}, {1, 2}, {1, 2}}), Numbers{1}); }

TEST(Front, HoldsExactlyTheNondominatedPoints) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> few(0, 12);  // so that there are ties and duplicates
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Point> points(40);
    for (Point& p : points) p = {static_cast<double>(few(random)), static_cast<double>(few(random))};
    const Numbers found = front(points);
    std::vector<bool> in(points.size(), false);
    for (std::size_t k = 0; k < found.size(); ++k) {
      in[found[k]] = true;
      if (k == 0) continue;
      EXPECT_GT(points[found[k]].cost, points[found[k - 1]].cost);
      EXPECT_LT(points[found[k]].error, points[found[k - 1]].error);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (std::size_t j = 0; j < points.size(); ++j)
        beaten = beaten || dominates(points[j], points[i]) ||
                 (j < i && points[j].cost == points[i].cost && points[j].error == points[i].error);
      EXPECT_EQ(in[i], !beaten) << "point " << i << " of trial " << trial;
    }
  }
}

TEST(Front, RejectsNegativeAndNonFiniteValues) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.}) {
    EXPECT_THROW((void)front({{1, 1}, {bad, 1}}), hmps::InputError);
    EXPECT_THROW((void)front({{1, 1}, {1, bad}}), hmps::InputError);
  }
  try {
    (void)front({{1, 1}, {2, std::numeric_limits<double>::quiet_NaN()}});
    FAIL();
  } catch (const hmps::InputError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("point 1 "), std::string::npos) << words;
    EXPECT_NE(words.find("nan"), std::string::npos) << words;
    EXPECT_NE(words.find("leave runs that failed out"), std::string::npos) << words;
  }
}

}  // namespace front_test
