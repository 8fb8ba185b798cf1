// SPDX-License-Identifier: MIT
#include "hmps/shapes/combine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace combine_test {

using hmps::Matrix;
using hmps::Vector;

template <class S_, int D_>
struct Case {
  using S = S_;
  static constexpr int D = D_;
};

template <class T>
class Combine : public testing::Test {
 public:
  using Scalar = typename T::S;
  static constexpr int dimension = T::D;
  using Position = Vector<Scalar, dimension>;
  const hmps::Ball<Scalar, dimension> left{.centre = Scalar(-0.5) * Position::Unit(0), .radius = Scalar(0.75)};
  const hmps::Ball<Scalar, dimension> right{.centre = Scalar(0.5) * Position::Unit(0), .radius = Scalar(0.5)};
  const hmps::Box<Scalar, dimension> box{Position::Constant(Scalar(-0.25)), Position::Constant(Scalar(1))};

  /// Calls `check` at positions that are the same in every run.
  template <class Check>
  void everywhere(Check&& check) const {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-2, 2);
    for (int k = 0; k < 300; ++k) {
      Position x;
      for (int c = 0; c < dimension; ++c) x[c] = static_cast<Scalar>(uniform(random));
      check(x);
    }
  }
};
using Cases = testing::Types<Case<float, 2>, Case<double, 2>, Case<float, 3>, Case<double, 3>>;
TYPED_TEST_SUITE(Combine, Cases);

TYPED_TEST(Combine, SetOperationsAgreeWithSetsOfPoints) {
  const auto& a = this->left;
  const auto& b = this->right;
  const auto& c = this->box;
  const auto any = hmps::unite(a, b, c);
  const auto all = hmps::intersect(a, b, c);
  const auto rest = hmps::subtract(a, b, c);
  const auto outside = hmps::complement(a);
  const auto list = hmps::unite_all(std::vector{a, b});
  using S = typename TypeParam::S;
  static_assert(hmps::Shape<decltype(any), S, TypeParam::D>);
  int counts[3] = {};
  this->everywhere([&](const auto& x) {
    const bool in_a = a(x) < 0, in_b = b(x) < 0, in_c = c(x) < 0;
    EXPECT_EQ(any(x) < 0, in_a || in_b || in_c);
    EXPECT_EQ(all(x) < 0, in_a && in_b && in_c);
    EXPECT_EQ(rest(x) < 0, in_a && !in_b && !in_c);
    EXPECT_EQ(outside(x) < 0, !in_a);
    EXPECT_EQ(list(x) < 0, in_a || in_b);
    counts[0] += any(x) < 0, counts[1] += rest(x) < 0, counts[2] += outside(x) < 0;
  });
  for (const int count : counts) EXPECT_GT(count, 0);
}

TYPED_TEST(Combine, OffsetLayerAndShellMeasureFromTheSurface) {
  using S = typename TypeParam::S;
  const auto& ball = this->left;
  const auto grown = hmps::offset(ball, 0.25);
  const auto wall = hmps::layer(ball, 0.0, 0.2);
  const auto sheet = hmps::shell(ball, 0.5);
  const S eps = S(16) * std::numeric_limits<S>::epsilon();
  this->everywhere([&](const auto& x) {
    const S d = ball(x);
    EXPECT_NEAR(grown(x), d - S(0.25), eps);
    EXPECT_EQ(wall(x) < 0, d > 0 && d < S(0.2));
    EXPECT_NEAR(sheet(x), std::abs(d) - S(0.25), eps);
  });
}

TYPED_TEST(Combine, SmoothOperationsAddAFilletOnlyWhereTheShapesMeet) {
  using S = typename TypeParam::S;
  const auto& a = this->left;
  const auto& b = this->right;
  const S width = S(0.5);
  const auto any = hmps::smooth_unite(a, b, width);
  const auto all = hmps::smooth_intersect(a, b, width);
  const auto rest = hmps::smooth_subtract(a, b, width);
  const S eps = S(16) * std::numeric_limits<S>::epsilon();
  bool added = false;
  this->everywhere([&](const auto& x) {
    const S least = std::min(a(x), b(x)), most = std::max(a(x), b(x)), cut = std::max(a(x), -b(x));
    EXPECT_LE(any(x), least + eps);
    EXPECT_GE(any(x), least - width / 4 - eps);
    EXPECT_GE(all(x), most - eps);
    EXPECT_LE(all(x), most + width / 4 + eps);
    EXPECT_GE(rest(x), cut - eps);
    if (std::abs(a(x) - b(x)) >= width) {
      EXPECT_NEAR(any(x), least, eps);
    } else {
      added = added || any(x) < least - width / 100;
    }
    EXPECT_NEAR(hmps::smooth_unite(a, b, S(0))(x), least, eps);
  });
  EXPECT_TRUE(added);
}

TYPED_TEST(Combine, MovesAndTurnsAndMirrors) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  Matrix<S, D> quarter = Matrix<S, D>::Identity();
  quarter.template topLeftCorner<2, 2>() << S(0), S(-1), S(1), S(0);
  const auto moved = hmps::translated(this->box, V(V::Unit(1)));
  const auto turned = hmps::rotated(this->box, quarter);
  const V pivot = V::Unit(0);
  const auto about = hmps::rotated(this->box, quarter, pivot);
  const auto both = hmps::mirrored(this->right, 0);
  const auto seen = hmps::warped(this->box, [](const V& x) { return V(S(2) * x); });
  const S eps = S(32) * std::numeric_limits<S>::epsilon();
  this->everywhere([&](const V& x) {
    EXPECT_NEAR(moved(V(x + V::Unit(1))), this->box(x), eps);
    EXPECT_NEAR(turned(V(quarter * x)), this->box(x), eps);
    EXPECT_NEAR(about(V(pivot + quarter * (x - pivot))), this->box(x), eps);
    V other = x;
    other[0] = -x[0];
    EXPECT_EQ(both(x), both(other));
    if (x[0] >= 0) {
      EXPECT_EQ(both(x), this->right(x));
    }
    EXPECT_EQ(seen(x), this->box(V(S(2) * x)));
  });
}

TEST(CombineMisuse, IsRefused) {
  using V = Vector<double, 3>;
  auto ball = [](const V& x) { return x.norm() - 1; };
  EXPECT_THROW((void)hmps::unite_all(std::vector<decltype(ball)>{}), hmps::InputError);
  auto list = hmps::unite_all(std::vector{ball});
  const auto moved = std::move(list);
  EXPECT_FALSE(std::isnan(moved(V::Zero())));
  EXPECT_TRUE(std::isnan(list(V::Zero())));  // NOLINT(bugprone-use-after-move)
  EXPECT_THROW((void)hmps::layer(ball, 0.2, -0.2), hmps::InputError);
  EXPECT_THROW((void)hmps::shell(ball, -0.2), hmps::InputError);
  for (const double radius : {-0.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW((void)hmps::smooth_unite(ball, ball, radius), hmps::InputError);
  EXPECT_THROW((void)hmps::rotated(ball, Matrix<double, 3>(2 * Matrix<double, 3>::Identity())), hmps::InputError);
  Matrix<double, 3> mirror = Matrix<double, 3>::Identity();
  mirror(0, 0) = -1;
  EXPECT_THROW((void)hmps::rotated(ball, mirror), hmps::InputError);
  for (const double beyond : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW((void)hmps::translated(ball, V(beyond, 0, 0)), hmps::InputError);
  for (const int axis : {-1, 3}) EXPECT_THROW((void)hmps::mirrored(ball, axis), hmps::InputError);
  const auto in_the_plane = hmps::mirrored(hmps::Ball<double, 2>{.radius = 1}, 2);
  EXPECT_THROW((void)in_the_plane(Vector<double, 2>(0, 0)), hmps::InputError);
}

// `std::min` drops a NaN in second place.
TEST(Combinations, KeepAShapeThatDoesNotExist) {
  using V = Vector<double, 3>;
  const hmps::Ball<double, 3> ball{V(0, 0, 0), 1}, none{V(0, 0, 0), -1};
  const auto is_nan = [](const auto& shape) { return std::isnan(shape(V(0.5, 0, 0))); };
  EXPECT_FALSE(is_nan(hmps::unite(ball, ball)));
  EXPECT_TRUE(is_nan(hmps::unite(ball, none)));
  EXPECT_TRUE(is_nan(hmps::unite(none, ball)));
  EXPECT_TRUE(is_nan(hmps::unite(ball, none, ball)));
  EXPECT_TRUE(is_nan(hmps::unite_all(std::vector{ball, none, ball})));
  EXPECT_TRUE(is_nan(hmps::intersect(ball, none)));
  EXPECT_TRUE(is_nan(hmps::subtract(ball, none)));
  for (const double radius : {0.0, 0.1}) {
    EXPECT_TRUE(is_nan(hmps::smooth_unite(ball, none, radius)));
    EXPECT_TRUE(is_nan(hmps::smooth_subtract(ball, none, radius)));
  }
}

TEST(Combinations, ShellOfAnIntegerThicknessIsThatThick) {
  const auto wall = hmps::shell(hmps::Ball<double, 3>{.radius = 4}, 1);
  EXPECT_NEAR(wall(Vector<double, 3>(4.25, 0, 0)), -0.25, 1e-12);
  EXPECT_NEAR(wall(Vector<double, 3>(5, 0, 0)), 0.5, 1e-12);
}

// Once the fold was written to the caller's array.
TEST(Mirrored, LeavesTheArrayOfTheCallerAlone) {
  const auto lobes = hmps::mirrored(hmps::Ball<double, 3>{.centre = {0.2, 0, 0}, .radius = 0.1}, 0);
  Eigen::Matrix3Xd columns(3, 1);
  columns << -0.2, 0, 0;
  EXPECT_DOUBLE_EQ(lobes(columns.col(0)), -0.1);
  EXPECT_EQ(columns(0, 0), -0.2);
  double raw[] = {-0.25, 0, 0};
  EXPECT_NEAR(lobes(Eigen::Map<Eigen::Vector3d>(raw)), -0.05, 1e-15);
  EXPECT_EQ(raw[0], -0.25);
  const auto twice = hmps::warped(lobes, [](const hmps::Vector<double, 3>& x) { return 2 * x; });
  EXPECT_DOUBLE_EQ(twice(hmps::Vector<double, 3>(-0.1, 0, 0)), -0.1);
}

}  // namespace combine_test
