// SPDX-License-Identifier: MIT
#include "hmps/contact/normal_density.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace normal_density_test {

using hmps::PaperMetaball;
using hmps::SmoothMetaball;

template <class S_, int D_, class Ball_>
struct Case {
  using S = S_;
  using Ball = Ball_;
  static constexpr int D = D_;
};

template <class C>
class NormalDensityTest : public ::testing::Test {};
using Cases =
    ::testing::Types<Case<double, 3, PaperMetaball>, Case<double, 2, PaperMetaball>, Case<double, 3, SmoothMetaball>,
                     Case<double, 2, SmoothMetaball>, Case<float, 3, PaperMetaball>, Case<float, 2, SmoothMetaball>>;
TYPED_TEST_SUITE(NormalDensityTest, Cases);

/// Eq. (27) as printed: the sum at a slave above a lattice wall, averaged over its places along the wall.
template <int D, class Ball>
double lattice_sum(double y) {
  constexpr int places = 40, n = 4;
  double sum = 0;
  for (int a = 0; a < places; ++a)
    for (int b = 0; b < (D == 3 ? places : 1); ++b)
      for (int i = -n; i <= n; ++i)
        for (int j = D == 3 ? -n : 0; j <= (D == 3 ? n : 0); ++j)
          for (int k = 0; k <= 6; ++k) {
            const double dx = i - (a + 0.5) / places, dz = D == 3 ? j - (b + 0.5) / places : 0., dy = y + k;
            const double s = (dx * dx + dy * dy + dz * dz) / (Ball::radius * Ball::radius);
            if (s < 1) sum += Ball::value(s);
          }
  return sum / (D == 3 ? places * places : places);
}

TYPED_TEST(NormalDensityTest, IsTheAverageOverALatticeWall) {
  using C = TypeParam;
  using S = typename C::S;
  const hmps::NormalDensity<S, C::D, typename C::Ball> Z(S(1.2e-3));
  for (const double y : {-0.7, -0.2, 0.3, 0.8, 1.3, 1.7})
    // The midpoint rule over places leaves an error of about (1/40)^2 where a kernel ends in a kink.
    EXPECT_NEAR(static_cast<double>(Z(S(y * 1.2e-3))), (lattice_sum<C::D, typename C::Ball>(y)), 2e-3) << y;
}

TYPED_TEST(NormalDensityTest, InverseIsInverseFromDeepestToReach) {
  using C = TypeParam;
  using S = typename C::S;
  const S l0 = S(1.2e-3);
  const hmps::NormalDensity<S, C::D, typename C::Ball> Z(l0);
  // The interpolation error is 2e-4 at the kinks of Z; in float, the flat foot of Z near the reach loses the fourth
  // root of the rounding error.
  const S tolerance = l0 * (std::is_same_v<S, float> ? S(2e-3) : S(2e-4));
  S last = std::numeric_limits<S>::max();
  for (S y = Z.deepest() + l0 * S(0.01); y < l0 * S(C::Ball::radius - 0.1); y += l0 * S(0.013)) {
    const auto distance = Z.inverse(Z(y));
    EXPECT_TRUE(distance.reached);
    EXPECT_FALSE(distance.deep);
    EXPECT_NEAR(distance.value, y, tolerance);
  }
  for (S density = S(0.01); density < Z(Z.deepest()); density += S(0.01)) {
    EXPECT_LT(Z.inverse(density).value, last);
    last = Z.inverse(density).value;
  }
}

TYPED_TEST(NormalDensityTest, SaysWhatItCannotTell) {
  using C = TypeParam;
  using S = typename C::S;
  const hmps::NormalDensity<S, C::D, typename C::Ball> Z(S(1));
  for (const S density : {S(0), S(-1), std::numeric_limits<S>::quiet_NaN()}) {
    EXPECT_FALSE(Z.inverse(density).reached);
    EXPECT_EQ(Z.inverse(density).value, S(C::Ball::radius));
  }
  for (const S density : {S(100), std::numeric_limits<S>::infinity(), Z(Z.deepest()) * S(1.001)}) {
    EXPECT_TRUE(Z.inverse(density).deep);
    EXPECT_EQ(Z.inverse(density).value, Z.deepest());
  }
  EXPECT_TRUE(std::isfinite(Z.inverse(std::numeric_limits<S>::min()).value));
  EXPECT_LT(Z.deepest(), S(-0.7));
  EXPECT_GT(Z.deepest(), S(-0.9));
}

TEST(NormalDensity, HasTheFiguresOfTheWallOfThePaper) {
  const hmps::NormalDensity<double, 3, hmps::PaperMetaball> Z(1.);
  // In closed form: layer h has (pi / 2) re^2 (1 - (h / re)^2)^2.
  for (const auto& [y, value] :
       {std::pair{-1., 9.175}, {0., 6.993}, {0.5, 4.396}, {1., 2.182}, {1.5, 0.339}, {1.75, 0.}, {3., 0.}})
    EXPECT_NEAR(Z(y), value, 1e-3) << y;
}

TEST(NormalDensity, RefusesBadSpacing) {
  using Z = hmps::NormalDensity<double, 3, hmps::PaperMetaball>;
  EXPECT_THROW(Z(0.), hmps::InputError);
  EXPECT_THROW(Z(-1.), hmps::InputError);
  EXPECT_THROW(static_cast<void>(Z(std::numeric_limits<double>::quiet_NaN())), hmps::InputError);
}

struct NoKernel {
  static constexpr double radius = 2;
  template <class S>
  [[nodiscard]] static constexpr S value(S) {
    return std::numeric_limits<S>::quiet_NaN();
  }
  template <class S>
  [[nodiscard]] static constexpr S slope(S) {
    return S(0);
  }
};

TEST(NormalDensity, RefusesAKernelThatFormsNoWall) {
  EXPECT_THROW((void)(hmps::NormalDensity<double, 3, NoKernel>(1e-3)), hmps::InputError);
}

template <int Kind>
struct WrongSlope : SmoothMetaball {
  template <class S>
  [[nodiscard]] static S slope(S s) {
    const S own = SmoothMetaball::slope(s);
    return Kind == 0 ? -own : own * S(2) * std::sqrt(s);  // with the wrong sign, or dc/dr
  }
};

TEST(NormalDensity, RefusesAKernelWhoseSlopeIsNotThatOfItsValue) {
  EXPECT_NO_THROW((void)(hmps::NormalDensity<double, 3, SmoothMetaball>(1e-3)));
  EXPECT_THROW((void)(hmps::NormalDensity<double, 3, WrongSlope<0>>(1e-3)), hmps::InputError);
  EXPECT_THROW((void)(hmps::NormalDensity<float, 2, WrongSlope<1>>(1e-3F)), hmps::InputError);
}

}  // namespace normal_density_test
