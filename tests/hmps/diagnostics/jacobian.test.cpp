// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/jacobian.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace jacobian_test {

using namespace hmps;

template <class T, int N>
struct Kind {
  using Scalar = T;
  static constexpr int D = N;
};
using Kinds = testing::Types<Kind<double, 2>, Kind<double, 3>, Kind<float, 2>, Kind<float, 3>>;
template <class K>
struct JacobianOf : testing::Test {};
TYPED_TEST_SUITE(JacobianOf, Kinds);

TYPED_TEST(JacobianOf, CountsTheSelectedParticles) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  // More particles than one chunk of the reduction holds; det F is 1 except for a few.
  std::vector<Matrix<T, D>> F(5000, Matrix<T, D>::Identity());
  const auto stretch = [&](std::size_t i, double J) { F[i](1, 1) = static_cast<T>(J); };
  stretch(10, 0.5);
  stretch(20, 0.25);
  stretch(4000, 0.25);
  stretch(30, 2);
  stretch(4500, 2);
  stretch(40, 0.98046875);  // exact in T, inside
  stretch(50, 1.03125);     // exact in T, outside
  const JacobianStatistics all = jacobian_statistics(matrices(F));
  EXPECT_EQ(all.count, 5000u);
  EXPECT_EQ(all.min, 0.25);
  EXPECT_EQ(all.smallest, 20u);
  EXPECT_EQ(all.max, 2.0);
  EXPECT_EQ(all.largest, 30u);
  EXPECT_DOUBLE_EQ(all.share_within, 4994.0 / 5000);
  EXPECT_NEAR(all.mean, (4993 + 0.5 + 0.25 + 0.25 + 2 + 2 + 0.98046875 + 1.03125) / 5000, 1e-12);

  const auto odd = [](std::size_t i) { return i % 2 == 1; };
  const JacobianStatistics none_stretched = jacobian_statistics(matrices(F), {.low = 1, .high = 1}, odd);
  EXPECT_EQ(none_stretched.count, 2500u);
  EXPECT_EQ(none_stretched.share_within, 1.0);
  EXPECT_EQ(none_stretched.smallest, 1u);

  const auto backwards = [](std::size_t n, auto&& body) {
    for (std::size_t i = n; i-- > 0;) body(i);
  };
  const JacobianStatistics again = jacobian_statistics(matrices(F), {}, EveryParticle{}, backwards);
  EXPECT_EQ(again.mean, all.mean);
  EXPECT_EQ(again.smallest, all.smallest);
  EXPECT_EQ(again.largest, all.largest);
}

TEST(Jacobian, RejectsStatisticsOfNoParticle) {
  std::vector<Matrix<double, 2>> F(3, Matrix<double, 2>::Identity()), empty;
  EXPECT_THROW((void)jacobian_statistics(matrices(F), {}, [](std::size_t) { return false; }), InputError);
  EXPECT_THROW((void)jacobian_statistics(matrices(empty)), InputError);
}

TEST(JacobianStatisticsMisuse, IsRefused) {
  const std::vector<Matrix<double, 3>> F(4, Matrix<double, 3>::Identity());
  EXPECT_THROW((void)jacobian_statistics(matrices(F), {.low = 1.02, .high = 0.98}), InputError);
  EXPECT_THROW((void)jacobian_statistics(matrices(F), {.low = 98, .high = 102}), InputError) << "per cent";
  const ParticleSet other(3, [](std::size_t) { return true; });
  EXPECT_THROW((void)jacobian_statistics(matrices(F), {}, other), InputError);
  const MatrixView<const double, 3> nowhere(View<const double, 9>({}, 4, 72));
  EXPECT_THROW((void)jacobian_statistics(nowhere), InputError);
}

}  // namespace jacobian_test
