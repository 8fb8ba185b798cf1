// SPDX-License-Identifier: MIT
#include "hmps/contact/metaball.hpp"

#include <gtest/gtest.h>

namespace metaball_test {

template <class Ball>
class MetaballTest : public ::testing::Test {};
using Balls = ::testing::Types<hmps::PaperMetaball, hmps::SmoothMetaball>;
TYPED_TEST_SUITE(MetaballTest, Balls);

TYPED_TEST(MetaballTest, FallsFromOneToZero) {
  EXPECT_EQ(TypeParam::value(0.), 1.);
  EXPECT_EQ(TypeParam::value(1.), 0.);
  for (double s = 0.05; s <= 1; s += 0.05) EXPECT_LT(TypeParam::value(s), TypeParam::value(s - 0.05));
}

TYPED_TEST(MetaballTest, SlopeIsTheDerivative) {
  constexpr double h = 1e-5;
  for (double s = 0.05; s < 1; s += 0.1)
    // The kernels are at most cubic: the central difference errs by h^2 / 6 times a third derivative of 6.
    EXPECT_NEAR(TypeParam::slope(s), (TypeParam::value(s + h) - TypeParam::value(s - h)) / (2 * h), 2 * h * h + 1e-10);
}

TEST(PaperMetaball, IsEquation26) {
  EXPECT_EQ(hmps::PaperMetaball::radius, 1.75);
  const double r = 0.7, s = r * r / (1.75 * 1.75);
  EXPECT_DOUBLE_EQ(hmps::PaperMetaball::value(s), 1 - 0.16);
  EXPECT_FLOAT_EQ(hmps::PaperMetaball::value(0.16F), 0.84F);
}

struct NoRadius {
  template <class S>
  static S value(S s) {
    return s;
  }
  template <class S>
  static S slope(S s) {
    return s;
  }
};
static_assert(hmps::Metaball<hmps::PaperMetaball>);
static_assert(hmps::Metaball<hmps::SmoothMetaball>);
static_assert(!hmps::Metaball<NoRadius>);
static_assert(!hmps::Metaball<int>);

}  // namespace metaball_test
