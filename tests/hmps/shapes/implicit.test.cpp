// SPDX-License-Identifier: MIT
#include "hmps/shapes/implicit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace implicit_test {

using hmps::Vector;

template <class S>
constexpr S tolerance = S(64) * std::numeric_limits<S>::epsilon();

/// Random positions in the cube from -2 to 2.
template <class S, int D>
Vector<S, D> random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-2, 2);
  Vector<S, D> x;
  for (int c = 0; c < D; ++c) x[c] = static_cast<S>(uniform(random));
  return x;
}

/// Distance to a union of balls along a segment, the definition of capsules and round cones.
template <class S, int D>
double swept_distance(const Vector<S, D>& x, const Vector<S, D>& from, const Vector<S, D>& to, double r0, double r1,
                      int steps) {
  double least = std::numeric_limits<double>::max();
  for (int k = 0; k <= steps; ++k) {
    const double s = static_cast<double>(k) / steps;
    const Vector<double, D> centre = (1 - s) * from.template cast<double>() + s * to.template cast<double>();
    least = std::min(least, (x.template cast<double>() - centre).norm() - ((1 - s) * r0 + s * r1));
  }
  return least;
}

template <class T>
class Implicit : public testing::Test {};
template <class S_, int D_>
struct Case {
  using S = S_;
  static constexpr int D = D_;
};
using Cases = testing::Types<Case<float, 2>, Case<double, 2>, Case<float, 3>, Case<double, 3>>;
TYPED_TEST_SUITE(Implicit, Cases);

TYPED_TEST(Implicit, SatisfiesTheConceptAndOthersDoNot) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  static_assert(hmps::Shape<hmps::Ball<S, D>, S, D>);
  static_assert(hmps::Shape<hmps::Box<S, D>, S, D>);
  const auto user = [](const Vector<S, D>& x) { return x.norm() - S(1); };
  static_assert(hmps::Shape<decltype(user), S, D>);
  static_assert(!hmps::Shape<int, S, D>);
  const auto mute = [](const Vector<S, D>&) {};
  static_assert(!hmps::Shape<decltype(mute), S, D>);
}

TYPED_TEST(Implicit, BallMeasuresDistance) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const hmps::Ball<S, D> ball{.centre = Vector<S, D>::Constant(S(1)), .radius = S(0.5)};
  EXPECT_NEAR(ball(Vector<S, D>::Constant(S(1))), S(-0.5), tolerance<S>);
  EXPECT_NEAR(ball(Vector<S, D>(ball.centre + S(2) * Vector<S, D>::Unit(1))), S(1.5), tolerance<S>);
}

TYPED_TEST(Implicit, BoxMeasuresDistanceToFacesEdgesAndFromInside) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const hmps::Box<S, D> box{Vector<S, D>::Constant(S(-1)), Vector<S, D>::Constant(S(2))};
  Vector<S, D> x = Vector<S, D>::Constant(S(0.5));
  EXPECT_NEAR(box(x), S(-1.5), tolerance<S>);
  x[1] = S(1.75);
  EXPECT_NEAR(box(x), S(-0.25), tolerance<S>);
  x[1] = S(5);
  EXPECT_NEAR(box(x), S(3), tolerance<S>);
  x[0] = S(-5);
  EXPECT_NEAR(box(x), S(5), tolerance<S>);
}

TYPED_TEST(Implicit, HalfSpaceTakesANormalOfAnyLength) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const hmps::HalfSpace<S, D> half{.point = Vector<S, D>::Unit(0), .outward = S(7) * Vector<S, D>::Unit(0)};
  EXPECT_NEAR(half(Vector<S, D>::Zero()), S(-1), tolerance<S>);
  EXPECT_NEAR(half(Vector<S, D>(S(3) * Vector<S, D>::Unit(0))), S(2), tolerance<S>);
  for (const S length : {std::numeric_limits<S>::denorm_min(), std::numeric_limits<S>::max()}) {
    const hmps::HalfSpace<S, D> same{.point = Vector<S, D>::Unit(0), .outward = length * Vector<S, D>::Unit(0)};
    EXPECT_EQ(same(Vector<S, D>::Zero()), S(-1)) << length;
  }
}

TYPED_TEST(Implicit, CapsuleAndRoundConeAreTheDistanceToTheirBalls) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  std::mt19937 random(7);
  const Vector<S, D> from = S(-0.75) * Vector<S, D>::Unit(0);
  const Vector<S, D> to = S(0.5) * Vector<S, D>::Unit(0) + S(0.25) * Vector<S, D>::Unit(1);
  constexpr int steps = 4000;
  // Sampling a minimum over a segment of length L in n steps overestimates it by at most L / 2n.
  const double bound = 1.3 / (2 * steps) + 32 * static_cast<double>(std::numeric_limits<S>::epsilon());
  for (int k = 0; k < 200; ++k) {
    const Vector<S, D> x = random_point<S, D>(random);
    const hmps::Capsule<S, D> capsule{.from = from, .to = to, .radius = S(0.3)};
    EXPECT_NEAR(capsule(x), swept_distance(x, from, to, 0.3, 0.3, steps), bound);
    const hmps::RoundCone<S, D> cone{.from = from, .to = to, .radius_from = S(0.5), .radius_to = S(0.125)};
    EXPECT_NEAR(cone(x), swept_distance(x, from, to, 0.5, 0.125, steps), 2 * bound);
    const hmps::RoundCone<S, D> swallowed{.from = from, .to = to, .radius_from = S(0.1), .radius_to = S(1.75)};
    EXPECT_NEAR(swallowed(x), static_cast<double>((x - to).norm()) - 1.75, 1e-6);
  }
  const hmps::Capsule<S, D> point{.from = to, .to = to, .radius = S(0.25)};
  EXPECT_NEAR(point(from), (from - to).norm() - S(0.25), tolerance<S>);
}

TYPED_TEST(Implicit, CylinderHasFlatEnds) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const hmps::Cylinder<S, D> cylinder{
      .from = Vector<S, D>::Zero(), .to = S(2) * Vector<S, D>::Unit(1), .radius = S(0.5)};
  const auto at = [](double side, double axial) {
    return Vector<S, D>(static_cast<S>(side) * Vector<S, D>::Unit(0) + static_cast<S>(axial) * Vector<S, D>::Unit(1));
  };
  EXPECT_NEAR(cylinder(at(0, 1)), S(-0.5), tolerance<S>);
  EXPECT_NEAR(cylinder(at(0, 1.75)), S(-0.25), tolerance<S>);
  EXPECT_NEAR(cylinder(at(2, 1)), S(1.5), tolerance<S>);
  EXPECT_NEAR(cylinder(at(0.25, -1)), S(1), tolerance<S>);
  EXPECT_NEAR(cylinder(at(3.5, 6)), S(5), tolerance<S>);
}

TYPED_TEST(Implicit, EllipsoidIsRightInSignAndToFirstOrderInDistance) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  Vector<S, D> half_axes = Vector<S, D>::Constant(S(0.5));
  half_axes[0] = S(1);
  const hmps::Ellipsoid<S, D> ellipsoid{.centre = Vector<S, D>::Unit(1), .half_axes = half_axes};
  EXPECT_NEAR(ellipsoid(ellipsoid.centre), S(-0.5), tolerance<S>);
  std::mt19937 random(11);
  for (int k = 0; k < 200; ++k) {
    // A point of the surface, and steps of +-h along its normal: the error is of the order of h^2
    // times the largest curvature, 1 / (0.5^2 / 1) = 4.
    const Vector<S, D> unit = random_point<S, D>(random).normalized();
    const Vector<S, D> surface = ellipsoid.centre + half_axes.cwiseProduct(unit);
    const Vector<S, D> normal = unit.cwiseQuotient(half_axes).normalized();
    for (const double h : {-0.02, 0.02}) {
      const Vector<S, D> x = surface + static_cast<S>(h) * normal;
      EXPECT_NEAR(ellipsoid(x), h, 4 * h * h);
    }
  }
}

TEST(Torus, MeasuresDistance) {
  const hmps::Torus<double> torus{.ring = 2, .radius = 0.5};
  EXPECT_NEAR(torus(Vector<double, 3>(0, 2, 0)), -0.5, 1e-15);
  EXPECT_NEAR(torus(Vector<double, 3>(0, 0, 0)), 1.5, 1e-15);
  EXPECT_NEAR(torus(Vector<double, 3>(5, 0, 4)), 4.5, 1e-15);
}

// A shape that does not exist would silently leave a hole in a body.
TEST(Shapes, OfNegativeSizeAreNaN) {
  using V = Vector<double, 3>;
  const V origin = V::Zero(), one = V::Ones();
  for (const V& x : {origin, one, V(3, -2, 5)}) {
    EXPECT_TRUE(std::isnan((hmps::Ball<double, 3>{origin, -1}(x))));
    EXPECT_TRUE(std::isnan((hmps::Box<double, 3>{V(2, 0, 0), one}(x))));
    EXPECT_TRUE(std::isnan((hmps::Capsule<double, 3>{origin, one, -1}(x))));
    EXPECT_TRUE(std::isnan((hmps::RoundCone<double, 3>{origin, one, 1, -1}(x))));
    EXPECT_TRUE(std::isnan((hmps::Cylinder<double, 3>{origin, one, -1}(x))));
    EXPECT_TRUE(std::isnan((hmps::Cylinder<double, 3>{one, one, 1}(x)))) << "without a direction";
    EXPECT_TRUE(std::isnan((hmps::HalfSpace<double, 3>{origin, origin}(x)))) << "without a direction";
    EXPECT_TRUE(std::isnan((hmps::Torus<double>{origin, 1, -1}(x))));
    EXPECT_TRUE(std::isnan((hmps::Ellipsoid<double, 3>{origin, V(1, 1, -1)}(x))));
  }
  EXPECT_EQ((hmps::Ball<double, 3>{origin, 0}(one)), std::sqrt(3.0));
}

}  // namespace implicit_test
