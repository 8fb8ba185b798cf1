// SPDX-License-Identifier: MIT
#include "hmps/contact/surface_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hmps/shapes/implicit.hpp"

namespace surface_correction_test {

using hmps::Index;

template <class Case>
class SurfaceCorrectionTest : public ::testing::Test {};
template <class S_, int D_>
struct Kind {
  using S = S_;
  static constexpr int D = D_;
};
using Kinds = ::testing::Types<Kind<double, 3>, Kind<double, 2>, Kind<float, 3>>;
TYPED_TEST_SUITE(SurfaceCorrectionTest, Kinds);

/// The particles of a square or cubic lattice in a ball about the origin, and the outermost of them.
template <class S, int D>
struct Lattice {
  using Point = hmps::Vector<S, D>;
  static constexpr S l0 = S(1e-3), radius = S(6.3e-3);
  hmps::Ball<S, D> ball{Point::Zero(), radius};
  std::vector<Point> x;
  std::vector<Index> skin;
  Lattice() {
    for (int i = -7; i <= 7; ++i)
      for (int j = -7; j <= 7; ++j)
        for (int k = D == 3 ? -7 : 0; k <= (D == 3 ? 7 : 0); ++k) {
          Point p;
          p[0] = S(i) * l0;
          p[1] = S(j) * l0;
          if constexpr (D == 3) p[2] = S(k) * l0;
          if (ball(p) > S(0)) continue;
          bool outermost = false;
          for (int c = 0; c < D; ++c)
            for (const S step : {l0, -l0}) outermost = outermost || ball(p + step * Point::Unit(c)) > S(0);
          if (outermost) skin.push_back(static_cast<Index>(x.size()));
          x.push_back(p);
        }
  }
};

TYPED_TEST(SurfaceCorrectionTest, LiesHalfASpacingBelowTheSurfaceAndTheRestStays) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const Lattice<S, D> body;
  const hmps::SurfaceCorrection<S, D> raised(hmps::vectors(body.x), body.skin, body.ball, body.l0);
  const std::vector<hmps::Matrix<S, D>> F(body.x.size(), hmps::Matrix<S, D>::Identity());
  auto places = body.x;
  raised(hmps::vectors(body.x), hmps::matrices(F), hmps::vectors(places));
  std::vector<bool> in_skin(body.x.size(), false);
  for (const Index i : body.skin) in_skin[i] = true;
  // The gradient of the shape is a central difference over 2e-3 spacings: the rounding of distances over that.
  const S tolerance = S(0.5) * body.l0 * std::numeric_limits<S>::epsilon() * S(1e4);
  double furthest = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (in_skin[i])
      EXPECT_NEAR(body.ball(places[i]), S(-0.5) * body.l0, tolerance) << i;
    else
      EXPECT_EQ(places[i], body.x[i]);
    furthest = std::max(furthest, static_cast<double>((places[i] - body.x[i]).norm() / body.l0));
  }
  EXPECT_GT(furthest, 0.3) << "the ball is no staircase, so this test proves nothing";
}

/// If the body is turned and stretched, the raised places turn and stretch with it: they are material points.
TYPED_TEST(SurfaceCorrectionTest, FollowsTheBody) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const Lattice<S, D> body;
  const hmps::SurfaceCorrection<S, D> raised(hmps::vectors(body.x), body.skin, body.ball, body.l0);
  hmps::Matrix<S, D> A = hmps::Matrix<S, D>::Identity();
  A(0, 0) = S(0.6);
  A(0, 1) = S(-1.6);
  A(1, 0) = S(0.8);
  A(1, 1) = S(1.2);
  std::vector<hmps::Matrix<S, D>> F(body.x.size(), hmps::Matrix<S, D>::Identity());
  auto before = body.x, x = body.x, after = body.x;
  raised(hmps::vectors(x), hmps::matrices(F), hmps::vectors(before));
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = A * x[i], F[i] = A;
  raised(hmps::vectors(x), hmps::matrices(F), hmps::vectors(after));
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_LT((after[i] - A * before[i]).norm(), S(20) * body.radius * std::numeric_limits<S>::epsilon());
}

TEST(SurfaceCorrection, WritesNowhereElseThanInTheViews) {
  const Lattice<double, 3> body;
  const hmps::SurfaceCorrection<double, 3> raised(hmps::vectors(body.x), body.skin, body.ball, body.l0);
  std::vector<hmps::Matrix<double, 3>> F(body.x.size(), hmps::Matrix<double, 3>::Identity());
  auto places = body.x;
  const auto x = hmps::vectors(body.x);
  const std::size_t few = body.skin.back();  // all particles before the last one of the skin
  EXPECT_THROW(raised(x.part(0, few), hmps::matrices(F).part(0, few), hmps::vectors(places).part(0, few)),
               hmps::InputError);
  EXPECT_EQ(places, body.x) << "something was written before the error";
  EXPECT_THROW(raised(x, hmps::matrices(F).part(0, few), hmps::vectors(places)), hmps::InputError);
  EXPECT_THROW(raised(x, hmps::matrices(F), hmps::vectors(places).part(0, few)), hmps::InputError);
  EXPECT_NO_THROW(
      raised(x.part(0, few + 1), hmps::matrices(F).part(0, few + 1), hmps::vectors(places).part(0, few + 1)));
}

TEST(SurfaceCorrection, SaysWhatIsWrong) {
  const Lattice<double, 3> body;
  const auto make = [&](std::vector<Index> skin, auto shape, double spacing) {
    (void)hmps::SurfaceCorrection<double, 3>(hmps::vectors(body.x), skin, shape, spacing);
  };
  EXPECT_NO_THROW(make(body.skin, body.ball, body.l0));
  EXPECT_THROW(make(body.skin, body.ball, 0), hmps::InputError);
  EXPECT_THROW(make({static_cast<Index>(body.x.size())}, body.ball, body.l0), hmps::InputError) << "no such particle";
  const Index deep = static_cast<Index>(body.x.size() / 2 + 1);  // next to the middle
  EXPECT_THROW(make({deep}, body.ball, body.l0), hmps::InputError) << "an inner particle";
  EXPECT_THROW(make(
                   body.skin, [](const auto&) { return -1e-3; }, body.l0),
               hmps::InputError)
      << "no direction";
}

TEST(SurfaceCorrection, RefusesAShapeThatIsInsideOut) {
  using V = hmps::Vector<double, 3>;
  const std::vector<V> points{V(0, 0, -0.5), V(1, 0, -0.5)};
  const std::vector<Index> skin{0, 1};
  using Correction = hmps::SurfaceCorrection<double, 3>;
  EXPECT_NO_THROW(Correction(
      hmps::vectors(points), skin, [](const V& x) { return x[2]; }, 1.0));
  EXPECT_THROW(Correction(
                   hmps::vectors(points), skin, [](const V& x) { return -x[2]; }, 1.0),
               hmps::InputError);
}

TEST(SurfaceCorrection, RefusesASpacingThatIsNotThatOfTheSkin) {
  const Lattice<double, 3> body;
  for (const double factor : {1e-3, 0.5, 2.0, 1e3})
    EXPECT_THROW((hmps::SurfaceCorrection<double, 3>(hmps::vectors(body.x), body.skin, body.ball, factor * body.l0)),
                 hmps::InputError)
        << factor;
}

}  // namespace surface_correction_test
