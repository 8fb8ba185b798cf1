// SPDX-License-Identifier: MIT
#include "hmps/core/detail/finite.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace finite_test {

using hmps::detail::is_finite, hmps::detail::is_nan, hmps::detail::all_finite;

template <class T>
class Finite : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(Finite, Scalars);

TYPED_TEST(Finite, DetectsNaNAndInfinity) {
  using L = std::numeric_limits<TypeParam>;
  for (const TypeParam x :
       {TypeParam(0), -TypeParam(0), TypeParam(1), L::max(), L::lowest(), L::min(), L::denorm_min()}) {
    EXPECT_TRUE(is_finite(x)) << x;
    EXPECT_FALSE(is_nan(x)) << x;
  }
  for (const TypeParam x : {L::infinity(), -L::infinity()}) {
    EXPECT_FALSE(is_finite(x)) << x;
    EXPECT_FALSE(is_nan(x)) << x;
  }
  for (const TypeParam x : {L::quiet_NaN(), -L::quiet_NaN()}) {
    EXPECT_FALSE(is_finite(x)) << x;
    EXPECT_TRUE(is_nan(x)) << x;
  }
}

static_assert(is_finite(1.0) && is_finite(7) && !is_nan(7));
static_assert(!is_finite(std::numeric_limits<float>::infinity()) && is_nan(std::numeric_limits<double>::quiet_NaN()));

TEST(Finite, ChecksEveryComponent) {
  for (int k = 0; k < 9; ++k) {
    hmps::Matrix<double, 3> m = hmps::Matrix<double, 3>::Identity();
    EXPECT_TRUE(all_finite(m));
    m(k % 3, k / 3) = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(all_finite(m)) << k;
    EXPECT_FALSE(all_finite(m.transpose())) << k;
  }
}

}  // namespace finite_test
