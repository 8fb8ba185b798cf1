// SPDX-License-Identifier: MIT
#include "hmps/lanes/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace {

template <class T>
class LanesOf : public testing::Test {
 protected:
  /// Another number in every lane.
  static hmps::Lanes<T> ramp(double first, double step) {
    hmps::Lanes<T> a;
    for (int l = 0; l < hmps::Lanes<T>::width; ++l) a.lane[l] = static_cast<T>(first + step * l);
    return a;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(LanesOf, Scalars);

TYPED_TEST(LanesOf, AreSixtyFourBytesWhateverTheInstructionSet) {
  using L = hmps::Lanes<TypeParam>;
  EXPECT_EQ(sizeof(L), 64u);
  EXPECT_EQ(alignof(L), 64u);
  EXPECT_EQ(static_cast<std::size_t>(L::width) * sizeof(TypeParam), 64u);
  EXPECT_EQ(sizeof(hmps::LaneMask<TypeParam>), 64u);
  static_assert(std::is_trivially_default_constructible_v<L>);
  static_assert(std::is_trivially_destructible_v<L>);
}

TYPED_TEST(LanesOf, CopyEveryLaneWhereverItLies) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  const L a = this->ramp(-3.5, 0.75);
  const L copied = a;
  L assigned = this->ramp(1, 1);
  assigned = a;
  T around[L::width + 2] = {};
  hmps::detail::store(around + 1, a);
  const L loaded = hmps::detail::load(around + 1);
  for (int l = 0; l < L::width; ++l) {
    EXPECT_EQ(copied.lane[l], a.lane[l]);
    EXPECT_EQ(assigned.lane[l], a.lane[l]);
    EXPECT_EQ(loaded.lane[l], a.lane[l]);
  }
  EXPECT_EQ(around[0], T(0));
  EXPECT_EQ(around[L::width + 1], T(0));
}

TYPED_TEST(LanesOf, ComputeLikeNumbersLaneByLane) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  const L a = this->ramp(-3.5, 0.75), b = this->ramp(7.25, -1.5);
  for (int l = 0; l < L::width; ++l) {
    const T x = a.lane[l], y = b.lane[l];
    EXPECT_EQ((a + b).lane[l], x + y);
    EXPECT_EQ((a - b).lane[l], x - y);
    EXPECT_EQ((a * b).lane[l], x * y);
    EXPECT_EQ((a / b).lane[l], x / y);
    EXPECT_EQ((a + 2).lane[l], x + T(2));
    EXPECT_EQ((2.0 - a).lane[l], T(2) - x);
    EXPECT_EQ((a * T(3)).lane[l], x * T(3));
    EXPECT_EQ((1 / a).lane[l], T(1) / x);
    EXPECT_EQ((-a).lane[l], -x);
    EXPECT_EQ((+a).lane[l], x);
    L c = a;
    EXPECT_EQ((c += b).lane[l], x + y);
    EXPECT_EQ((c -= 1).lane[l], (x + y) - T(1));
    c = a;
    EXPECT_EQ((c *= b).lane[l], x * y);
    c = a;
    EXPECT_EQ((c /= b).lane[l], x / y);
    EXPECT_EQ(L(2.5).lane[l], T(2.5));
  }
}

TYPED_TEST(LanesOf, CompareAndSelectLaneByLane) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  const L a = this->ramp(-2, 1), b = this->ramp(2, -1), yes(1), no(0);
  L odd = a;
  odd.lane[1] = std::numeric_limits<T>::quiet_NaN();
  for (int l = 0; l < L::width; ++l) {
    const T x = a.lane[l], y = b.lane[l], z = odd.lane[l];
    EXPECT_EQ(select(a < b, yes, no).lane[l] != T(0), x < y);
    EXPECT_EQ(select(a <= b, yes, no).lane[l] != T(0), x <= y);
    EXPECT_EQ(select(a > b, yes, no).lane[l] != T(0), x > y);
    EXPECT_EQ(select(a >= b, yes, no).lane[l] != T(0), x >= y);
    EXPECT_EQ(select(a == b, yes, no).lane[l] != T(0), x == y);
    EXPECT_EQ(select(a != b, yes, no).lane[l] != T(0), x != y);
    EXPECT_EQ(select(a < T(0), yes, no).lane[l] != T(0), x < T(0));
    EXPECT_EQ(select(0 < a, yes, no).lane[l] != T(0), T(0) < x);
    EXPECT_EQ(select(odd == odd, yes, no).lane[l] != T(0), l != 1);
    EXPECT_EQ(select(odd >= T(0), yes, no).lane[l] != T(0), z >= T(0));
    EXPECT_EQ(select(a < b, a, b).lane[l], x < y ? x : y);
    // The lane that is not chosen may hold anything.
    EXPECT_EQ(select(odd == odd, a, b).lane[l], l == 1 ? y : x);
  }
}

TYPED_TEST(LanesOf, HaveTheFunctionsThatLawsCall) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  const L a = this->ramp(0.25, 0.5), signs = this->ramp(-3, 1);
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

TYPED_TEST(LanesOf, LoadAndStoreAnywhere) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  std::vector<T> memory(static_cast<std::size_t>(2 * L::width + 1));
  for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = static_cast<T>(i);
  const L a = hmps::detail::load(memory.data() + 1);
  for (int l = 0; l < L::width; ++l) EXPECT_EQ(a.lane[l], static_cast<T>(1 + l));
  hmps::detail::store(memory.data() + L::width + 1, a);
  EXPECT_EQ(memory[static_cast<std::size_t>(L::width)], static_cast<T>(L::width));
  EXPECT_EQ(memory[static_cast<std::size_t>(L::width) + 1], T(1));
  EXPECT_EQ(memory.back(), static_cast<T>(L::width));
}

TYPED_TEST(LanesOf, SpreadFollowsTheBits) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  for (const std::uint32_t bits : {0u, 1u, 0x8001u, 0x5555u, 0xaaaau, 0xffffu, 0x80u, 0x7fu}) {
    const L a = hmps::detail::spread(bits, T(1.75));
    for (int l = 0; l < L::width; ++l) EXPECT_EQ(a.lane[l], (bits >> l & 1u) != 0 ? T(1.75) : T(0)) << bits;
  }
}

// Against long double over sixty decades, at the ends of the mantissa and next to powers of eight.
TYPED_TEST(LanesOf, InverseCubeRootIsGoodToAFewUnitsInTheLastPlace) {
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

TYPED_TEST(LanesOf, InverseCubeRootOfWhatIsNotPositiveIsNotANumber) {
  using T = TypeParam;
  for (const T x :
       {T(0), T(-0.0), T(-1), T(-1e-20), -std::numeric_limits<T>::infinity(), std::numeric_limits<T>::quiet_NaN()})
    EXPECT_TRUE(std::isnan(inverse_cube_root(hmps::Lanes<T>(x)).lane[0])) << x;
}

TYPED_TEST(LanesOf, WorkInsideEigenMatrices) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  Eigen::Matrix<L, 2, 2, Eigen::DontAlign> m;
  m << L(1), this->ramp(0, 1), L(3), L(4);
  const Eigen::Matrix<L, 2, 2, Eigen::DontAlign> sum = m + m.transpose();
  const Eigen::Matrix<L, 2, 2, Eigen::DontAlign> square = m * m;
  for (int l = 0; l < L::width; ++l) {
    EXPECT_EQ(sum(0, 1).lane[l], static_cast<T>(l) + T(3));
    EXPECT_EQ(square(0, 0).lane[l], T(1) + static_cast<T>(l) * T(3));
  }
}

}  // namespace
