// SPDX-License-Identifier: MIT
#include "hmps/contact/penalty.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace penalty_test {

using hmps::PenaltyStiffness;
using Point = hmps::Vector<double, 3>;

TEST(PenaltyStiffness, RatioFollowsTheStepAndFixedDoesNot) {
  const auto ratio = PenaltyStiffness::ratio(0.3);
  EXPECT_DOUBLE_EQ(ratio.at(1000, 1e-5), 3e12);
  EXPECT_DOUBLE_EQ(ratio.at(1000, 0.5e-5), 12e12);
  const auto fixed = PenaltyStiffness::fixed(3e12);
  EXPECT_DOUBLE_EQ(fixed.at(1000, 1e-5), 3e12);
  EXPECT_DOUBLE_EQ(fixed.at(1000, 0.5e-5), 3e12);
  EXPECT_EQ(fixed.coefficient(1000, 2e-5), 3e12) << "beyond the limit of the linear law";
  EXPECT_EQ(ratio.coefficient(1000, 1e-5), ratio.at(1000, 1e-5));
}

TEST(PenaltyStiffness, RefusesWhatIsUnstable) {
  for (const double bad : {0., -1., 1., 2., std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW((void)PenaltyStiffness::ratio(bad), hmps::InputError) << bad;
  for (const double bad : {0., -1., std::numeric_limits<double>::infinity()})
    EXPECT_THROW((void)PenaltyStiffness::fixed(bad), hmps::InputError) << bad;
  EXPECT_THROW((void)PenaltyStiffness::fixed(3e12).at(1000, 2e-5), hmps::InputError);
}

TEST(NormalForce, PushesAndNeverPulls) {
  EXPECT_DOUBLE_EQ(hmps::normal_force(3., 2., 0., -5.), 6.);
  EXPECT_DOUBLE_EQ(hmps::normal_force(3., 2., 0.5, 4.), 8.);
  EXPECT_DOUBLE_EQ(hmps::normal_force(3., 2., 0.5, -4.), 4.);
  EXPECT_EQ(hmps::normal_force(3., 2., 10., -4.), 0.);
}

struct Quadratic {  // k p^2 / l0
  static double force(double k, double p, double l0) { return k * p * p / l0; }
  static double largest_stiffness(double k, double p, double l0) { return 2 * k * p / l0; }
};
struct NoStiffness {
  static double force(double k, double p, double) { return k * p; }
};
static_assert(hmps::PenaltyLaw<hmps::LinearPenalty> && hmps::PenaltyLaw<Quadratic>);
static_assert(!hmps::PenaltyLaw<NoStiffness> && !hmps::PenaltyLaw<Point>);

TEST(PenaltyLaw, GivesTheNormalForce) {
  EXPECT_EQ(hmps::normal_force(Quadratic{}, 3., 2., 4., 0., -5.), 3.);
  EXPECT_EQ(hmps::normal_force(Quadratic{}, 3., 2., 4., 0.5, -5.), 0.5);
  EXPECT_EQ(hmps::normal_force(Quadratic{}, 3., 2., 4., 0.5, -7.), 0.);
  EXPECT_EQ(hmps::normal_force(Quadratic{}, 3.F, 2.F, 4.F, 0.5F, 2.F), 4.F);
  // The linear law is (39), to the bit.
  EXPECT_EQ(hmps::normal_force(hmps::LinearPenalty{}, 0.3, 0.7, 4., 0.1, 0.9), hmps::normal_force(0.3, 0.7, 0.1, 0.9));
  EXPECT_EQ(hmps::LinearPenalty::force(3., 2., 4.), 6.);
  EXPECT_EQ(hmps::LinearPenalty::largest_stiffness(3., 2., 4.), 3.);
}

}  // namespace penalty_test
