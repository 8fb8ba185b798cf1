// SPDX-License-Identifier: MIT
#include "hmps/lanes/lane_math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace lane_math_test {

template <class T>
class LaneMath : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(LaneMath, Scalars);

TYPED_TEST(LaneMath, HaveTheFunctionsThatLawsCall) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  L a, signs;
  for (int l = 0; l < L::width; ++l) {
    a.lane[l] = static_cast<T>(0.25 + 0.5 * l);
    signs.lane[l] = static_cast<T>(l - 3);
  }
  for (int l = 0; l < L::width; ++l) {
    const T x = a.lane[l];
    EXPECT_EQ(sqrt(a).lane[l], std::sqrt(x));
    EXPECT_EQ(log(a).lane[l], std::log(x));
    EXPECT_EQ(exp(a).lane[l], std::exp(x));
    EXPECT_EQ(pow(a, 0.3).lane[l], std::pow(x, T(0.3)));
    EXPECT_EQ(pow(a, L(-2.0 / 3.0)).lane[l], std::pow(x, T(-2.0 / 3.0)));
    EXPECT_EQ(abs(signs).lane[l], std::abs(signs.lane[l]));
    EXPECT_EQ(min(a, signs).lane[l], std::min(x, signs.lane[l]));
    EXPECT_EQ(max(a, signs).lane[l], std::max(x, signs.lane[l]));
    EXPECT_EQ(hmps::detail::each(a, [](T y) { return y + y; }).lane[l], x + x);
  }
}

TYPED_TEST(LaneMath, TakeTheSameRootAsANumber) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  using Limits = std::numeric_limits<T>;
  const std::vector<T> numbers{T(0), Limits::denorm_min(), Limits::min(),      T(1) / T(3),
                               T(2), Limits::max(),        Limits::infinity(), T(-0.0)};
  for (std::size_t first = 0; first < numbers.size(); ++first) {
    L a;
    for (int l = 0; l < L::width; ++l) a.lane[l] = numbers[(first + static_cast<std::size_t>(l)) % numbers.size()];
    const L root = sqrt(a);
    for (int l = 0; l < L::width; ++l) EXPECT_EQ(root.lane[l], std::sqrt(a.lane[l])) << a.lane[l];
  }
  EXPECT_TRUE(std::isnan(sqrt(L(T(-1))).lane[L::width - 1]));
}

// Against long double over sixty decades, at the ends of the mantissa and next to powers of eight.
TYPED_TEST(LaneMath, InverseCubeRootIsAccurateToAFewUnitsInTheLastPlace) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  std::vector<T> numbers;
  for (double exponent = -30; exponent <= 30; exponent += 0.0137)
    numbers.push_back(static_cast<T>(std::pow(10, exponent)));
  for (int k = -30; k <= 30; ++k) {
    const T power = std::ldexp(T(1), 3 * k);
    numbers.insert(numbers.end(), {power, std::nextafter(power, T(0)), std::nextafter(power, T(2) * power)});
  }
  for (int k = 0; k < 4096; ++k) numbers.push_back(static_cast<T>(0.5 + k / 2048.0));
  while (numbers.size() % static_cast<std::size_t>(L::width) != 0) numbers.push_back(T(1));
  long double worst = 0;
  for (std::size_t i = 0; i < numbers.size(); i += static_cast<std::size_t>(L::width)) {
    const L root = inverse_cube_root(hmps::detail::load(numbers.data() + i));
    for (int l = 0; l < L::width; ++l) {
      const long double exact = 1 / std::cbrt(static_cast<long double>(numbers[i + static_cast<std::size_t>(l)]));
      worst = std::max(worst, std::abs(root.lane[l] - exact) / exact);
    }
  }
  EXPECT_LE(worst / std::numeric_limits<T>::epsilon(), 2.0L);
}

TYPED_TEST(LaneMath, InverseCubeRootOfWhatIsNotPositiveIsNotANumber) {
  using T = TypeParam;
  for (const T x :
       {T(0), T(-0.0), T(-1), T(-1e-20), -std::numeric_limits<T>::infinity(), std::numeric_limits<T>::quiet_NaN()})
    EXPECT_TRUE(std::isnan(inverse_cube_root(hmps::Lanes<T>(x)).lane[0])) << x;
}

}  // namespace lane_math_test
