// SPDX-License-Identifier: MIT
#include "hmps/lanes/lanes.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace lanes_test {

template <class T>
class LanesOf : public testing::Test {
 protected:
  /// A different number in every lane.
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

TYPED_TEST(LanesOf, AreMultipliedByPlainNumbersInsideEigenMatrices) {
  using T = TypeParam;
  using L = hmps::Lanes<T>;
  using M = Eigen::Matrix<L, 2, 2, Eigen::DontAlign>;
  M m;
  m << L(1), this->ramp(0, 1), L(3), L(4);
  const double number = 1.1;
  M by = m;
  by *= number;
  for (const M& product : {M(number * m), M(m * number), M(11 * m / 10.0 * 1.0F), by})
    for (int l = 0; l < L::width; ++l)
      EXPECT_NEAR(product(0, 1).lane[l], T(1.1) * static_cast<T>(l), 4 * std::numeric_limits<T>::epsilon() * T(32));
  const M quotient = m / 2;
  for (int l = 0; l < L::width; ++l) EXPECT_EQ(quotient(0, 1).lane[l], static_cast<T>(l) / 2);
}

}  // namespace lanes_test
