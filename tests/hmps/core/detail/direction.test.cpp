// SPDX-License-Identifier: MIT
#include "hmps/core/detail/direction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace direction_test {

using namespace hmps;

template <class S>
void expect_measurable() {
  using V = Vector<S, 3>;
  const V usual(S(0.1), S(-3), S(0));
  EXPECT_EQ((detail::measurable<S, 3>(usual)), usual) << "to the bit";
  const S lowest = std::numeric_limits<S>::denorm_min(), largest = std::numeric_limits<S>::max();
  for (const S size : {lowest, std::numeric_limits<S>::min(), std::sqrt(lowest) / 2, std::sqrt(largest) * 2, largest}) {
    const V scaled = detail::measurable<S, 3>(V(size, -size, 0));
    EXPECT_GE(scaled.norm(), S(1)) << size;
    EXPECT_LT(scaled.norm(), S(3)) << size;
    EXPECT_EQ(scaled[1], -scaled[0]);
    EXPECT_EQ(scaled[2], S(0));
  }
  EXPECT_EQ((detail::measurable<S, 3>(V::Zero())), V::Zero());
  EXPECT_TRUE(std::isinf((detail::measurable<S, 3>(V(0, std::numeric_limits<S>::infinity(), 1))[1])));
  EXPECT_TRUE(std::isnan((detail::measurable<S, 3>(V(0, 1, std::numeric_limits<S>::quiet_NaN())).sum())));
}

TEST(Direction, IsIndependentOfTheLength) {
  expect_measurable<double>();
  expect_measurable<float>();
}

}  // namespace direction_test
