// SPDX-License-Identifier: MIT
#include "hmps/shapes/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace sweep_test {

using hmps::Vector;

template <class S>
class Sweep : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Sweep, Scalars);

TYPED_TEST(Sweep, SuperellipseIsItsLevelSetAndFirstOrderBesideIt) {
  using S = TypeParam;
  const S a = S(2), b = S(1);
  for (const S n : {S(1), S(2), S(2.6), S(3.2), S(8)}) {
    EXPECT_NEAR(hmps::superellipse(S(0), S(0), a, b, n), -b, S(1e-6));
    for (int k = 1; k < 16; ++k) {
      const double angle = k * 0.4;
      const double c = std::cos(angle), s = std::sin(angle), e = 2 / static_cast<double>(n);
      const S u = static_cast<S>(std::copysign(2 * std::pow(std::abs(c), e), c));
      const S v = static_cast<S>(std::copysign(std::pow(std::abs(s), e), s));
      EXPECT_NEAR(hmps::superellipse(u, v, a, b, n), S(0), S(256) * std::numeric_limits<S>::epsilon());
      EXPECT_LT(hmps::superellipse(S(0.9) * u, S(0.9) * v, a, b, n), S(0));
      EXPECT_GT(hmps::superellipse(S(1.1) * u, S(1.1) * v, a, b, n), S(0));
    }
    // On the axes the level is linear, so that the distance is exact; a rhombus has corners there.
    if (n == S(1)) continue;
    EXPECT_NEAR(hmps::superellipse(S(2.5), S(0), a, b, n), S(0.5), S(1e-5));
    EXPECT_NEAR(hmps::superellipse(S(0), S(-0.25), a, b, n), S(-0.75), S(1e-5));
  }
  // Small sizes must not underflow: millimetres in metres, to a high power.
  EXPECT_NEAR(hmps::superellipse(S(1.5e-3), S(0), S(1e-3), S(2e-3), S(12)), S(0.5e-3), S(1e-8));
}

TYPED_TEST(Sweep, TubeFollowsItsRadii) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const hmps::Tube<S, 3> tube({{V(0, 0, 0), S(0.2)}, {V(1, 0, 0), S(0.2)}, {V(1, 1, 0), S(0.4)}});
  EXPECT_NEAR(tube(V(S(0.5), 0, 0)), S(-0.2), S(1e-6));
  EXPECT_NEAR(tube(V(S(0.5), 0, S(0.5))), S(0.3), S(1e-6));
  EXPECT_NEAR(tube(V(-1, 0, 0)), S(0.8), S(1e-6));
  EXPECT_NEAR(tube(V(1, 2, 0)), S(0.6), S(1e-6));
  const hmps::Tube<S, 2> ball({{Vector<S, 2>(1, 1), S(0.5)}});
  EXPECT_NEAR(ball(Vector<S, 2>(1, 3)), S(1.5), S(1e-6));
}

TYPED_TEST(Sweep, StackInterpolatesItsSectionsAlongAnyAxis) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  using V2 = Vector<S, 2>;
  const std::vector<hmps::StackRow<S>> rows{{S(2), V2(1, 0), V2(2, 1)}, {S(0), V2(0, 0), V2(1, 1)}};
  const hmps::Stack<S> stack(rows);
  const auto middle = stack.section(S(1));
  EXPECT_NEAR(middle.centre[0], S(0.5), S(1e-6));
  EXPECT_NEAR(middle.half_axes[0], S(1.5), S(1e-6));
  EXPECT_NEAR(stack(V(2, 0, 1)), S(0), S(1e-6));
  EXPECT_NEAR(stack(V(-1, 0, 1)), S(0), S(1e-6));
  EXPECT_NEAR(stack(V(S(0.5), S(0.5), 1)), S(-0.5), S(1e-6));
  EXPECT_NEAR(stack(V(0, 0, -3)), S(3), S(1e-6));
  EXPECT_NEAR(stack(V(1, 0, S(2.5))), S(0.5), S(1e-6));
  // The other coordinates keep the order x, y, z.
  const hmps::Stack<S> along_x(rows, S(2), 0);
  EXPECT_NEAR(along_x(V(1, 2, 0)), S(0), S(1e-6));
  const hmps::Stack<S> along_y(rows, S(2), 1);
  EXPECT_NEAR(along_y(V(2, 1, 0)), S(0), S(1e-6));
}

TYPED_TEST(Sweep, PlateIsWideThickBentAndBowed) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  // Along z, wide in y, thick in x: across x tangent = y x z = +x.
  const hmps::Plate<S> plate({{V(0, 0, 0), S(1), S(0.1), S(0)}, {V(0, 0, 4), S(2), S(0.2), S(0.5)}});
  EXPECT_NEAR(plate(V(0, 0, 2)), S(-0.15), S(1e-5));
  EXPECT_NEAR(plate(V(S(0.15), 0, 2)), S(0), S(1e-5));
  EXPECT_NEAR(plate(V(S(-0.15), 0, 2)), S(0), S(1e-5));
  // Half width 1.5 and bow 0.25 at half length: the edge stands 0.25 ahead along +x.
  EXPECT_NEAR(plate(V(S(0.25), S(1.5), 2)), S(0), S(1e-5));
  EXPECT_GT(plate(V(S(-0.25), S(1.5), 2)), S(0));
  EXPECT_NEAR(plate(V(0, 0, -1)), S(1), S(1e-5));
  EXPECT_NEAR(plate(V(0, 0, S(4.5))), S(0.5), S(1e-5));
  EXPECT_NEAR(plate.arc(V(S(0.1), 1, 3)), S(3), S(1e-5));
  // A corner: beyond it the section turns around the corner, without a gap outside of the bend.
  const hmps::Plate<S> bent(
      {{V(0, 0, 0), S(1), S(0.2), 0}, {V(0, 0, 2), S(1), S(0.2), 0}, {V(2, 0, 2), S(1), S(0.2), 0}});
  const S outside = S(0.19) / std::sqrt(S(2));
  EXPECT_LT(bent(V(-outside, 0, 2 + outside)), S(0));
  EXPECT_GT(bent(V(-outside * S(1.2), 0, 2 + outside * S(1.2))), S(0));
  EXPECT_NEAR(bent.arc(V(1, 0, S(2.1))), S(3), S(1e-5));
}

TYPED_TEST(Sweep, RejectsInvalidRows) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  using V2 = Vector<S, 2>;
  EXPECT_THROW((hmps::Tube<S, 3>({})), hmps::InputError);
  EXPECT_THROW((hmps::Tube<S, 3>({{V(0, 0, 0), S(0)}})), hmps::InputError);
  EXPECT_THROW(hmps::Stack<S>({{S(0), V2(0, 0), V2(1, 1)}}), hmps::InputError);
  EXPECT_THROW(hmps::Stack<S>({{S(0), V2(0, 0), V2(1, 1)}, {S(0), V2(0, 0), V2(1, 1)}}), hmps::InputError);
  EXPECT_THROW(hmps::Stack<S>({{S(0), V2(0, 0), V2(1, 1)}, {S(1), V2(0, 0), V2(1, -1)}}), hmps::InputError);
  EXPECT_THROW(hmps::Stack<S>({{S(0), V2(0, 0), V2(1, 1)}, {S(1), V2(0, 0), V2(1, 1)}}, S(0.5)), hmps::InputError);
  EXPECT_THROW(hmps::Stack<S>({{S(0), V2(0, 0), V2(1, 1)}, {S(1), V2(0, 0), V2(1, 1)}}, S(2), 3), hmps::InputError);
  const hmps::PlateRow<S> row{V(0, 0, 0), S(1), S(0.1), S(0)};
  EXPECT_THROW(hmps::Plate<S>({row}), hmps::InputError);
  EXPECT_THROW(hmps::Plate<S>({row, row}), hmps::InputError);
  EXPECT_THROW(hmps::Plate<S>({row, {V(0, 1, 1), S(1), S(0.1), S(0)}}), hmps::InputError);
  EXPECT_THROW(hmps::Plate<S>({row, {V(0, 0, 1), S(1), S(0), S(0)}}), hmps::InputError);
  EXPECT_THROW(hmps::Plate<S>({row, {V(0, 0, 1), S(1), S(1), S(0)}}, V(0, 0, 0)), hmps::InputError);
  for (const S length : {std::numeric_limits<S>::denorm_min(), std::numeric_limits<S>::max()})
    EXPECT_NO_THROW(hmps::Plate<S>({row, {V(0, 0, 1), S(1), S(1), S(0)}}, V(0, length, 0))) << length;
}

TEST(Superellipse, IsNotANumberWithoutPositiveAxesAndAnExponentOfOne) {
  EXPECT_FALSE(std::isnan(hmps::superellipse(1.0, 0.0, 4.0, 2.0, 1.0)));
  EXPECT_TRUE(std::isnan(hmps::superellipse(1.0, 0.0, -4.0, 2.0, 2.0)));
  EXPECT_TRUE(std::isnan(hmps::superellipse(1.0, 0.0, 4.0, 0.0, 2.0)));
  EXPECT_TRUE(std::isnan(hmps::superellipse(1.0, 0.0, 4.0, 2.0, 0.5)));
}

TYPED_TEST(Sweep, IsNotANumberAfterAMove) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  using V2 = Vector<S, 2>;
  hmps::Tube<S, 3> tube({{V(0, 0, 0), S(1)}});
  hmps::Stack<S> stack({{S(0), V2(0, 0), V2(1, 1)}, {S(1), V2(0, 0), V2(1, 1)}});
  hmps::Plate<S> plate({{V(0, 0, 0), S(1), S(0.1), S(0)}, {V(0, 0, 1), S(1), S(0.1), S(0)}});
  const V x(0, 0, S(0.5));
  const auto expect_usable_only_where_it_went = [&](auto& shape) {
    const auto moved = std::move(shape);
    EXPECT_LT(moved(x), S(0));
    EXPECT_TRUE(std::isnan(shape(x)));  // NOLINT(bugprone-use-after-move)
  };
  expect_usable_only_where_it_went(tube);
  expect_usable_only_where_it_went(stack);
  expect_usable_only_where_it_went(plate);
  EXPECT_THROW((void)stack.section(S(0)), hmps::InputError);  // NOLINT(bugprone-use-after-move)
  EXPECT_THROW((void)plate.arc(x), hmps::InputError);         // NOLINT(bugprone-use-after-move)
}

}  // namespace sweep_test
