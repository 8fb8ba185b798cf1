// SPDX-License-Identifier: MIT
#include "hmps/contact/master_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "hmps/contact/normal_density.hpp"

namespace master_surface_test {

template <class S_, int D_, class Ball_>
struct Case {
  using S = S_;
  using Ball = Ball_;
  static constexpr int D = D_;
};

template <class C>
class MasterSurfaceTest : public ::testing::Test {
 public:
  using Real = typename C::S;
  using Ball = typename C::Ball;
  static constexpr int D = C::D;
  using Vec = hmps::Vector<Real, D>;
  using Mat = hmps::Matrix<Real, D>;
  using Surface = hmps::MasterSurface<Real, D, Ball>;
  static constexpr Real radius = Real(Ball::radius);

  std::vector<Vec> x, v;
  std::vector<Mat> B;

  /// A wall of three layers with unit spacing below y = 0 (last component), deformed by F about 0.
  void wall(const Mat& F) {
    x.clear();
    for (int i = -5; i <= 5; ++i)
      for (int j = D == 3 ? -5 : 0; j <= (D == 3 ? 5 : 0); ++j)
        for (int k = 0; k < 3; ++k) {
          Vec p = Vec::Zero();
          p[0] = Real(i);
          if (D == 3) p[1] = Real(j);
          p[D - 1] = Real(-k);
          x.push_back(F * p);
        }
    B.assign(x.size(), F.inverse());
    v.assign(x.size(), Vec::Zero());
  }

  Surface at(const Vec& place) const {
    Surface surface;
    for (std::size_t j = 0; j < x.size(); ++j) {
      const Real c = surface.reach(B[j].transpose() * B[j], x[j] - place, Real(1) / (radius * radius));
      surface.mean(c, B[j], v[j]);
    }
    return surface;
  }

  Vec above(Real y) const {
    Vec p = Vec::Constant(Real(0.21));
    p[D - 1] = y;
    return p;
  }
};
using Cases = ::testing::Types<Case<double, 3, hmps::PaperMetaball>, Case<double, 2, hmps::PaperMetaball>,
                               Case<double, 3, hmps::SmoothMetaball>, Case<float, 3, hmps::SmoothMetaball>,
                               Case<float, 2, hmps::SmoothMetaball>>;
TYPED_TEST_SUITE(MasterSurfaceTest, Cases);

TYPED_TEST(MasterSurfaceTest, SumIsEquation28AndNormalItsGradient) {
  using S = typename TypeParam::S;
  using Point = typename TestFixture::Vec;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-0.2, 0.2);
  this->wall(TestFixture::Mat::Identity());
  for (auto& inverse : this->B)
    for (int c = 0; c < TypeParam::D * TypeParam::D; ++c)
      inverse(c % TypeParam::D, c / TypeParam::D) += static_cast<S>(u(random));
  const auto sum = [&](const Point& place) {
    S total = 0;
    for (std::size_t j = 0; j < this->x.size(); ++j) {
      const S s = (this->B[j] * (this->x[j] - place)).squaredNorm() / (this->radius * this->radius);
      if (s < 1) total += TypeParam::Ball::value(s);
    }
    return total;
  };
  const Point place = this->above(S(0.8));
  const auto surface = this->at(place);
  const S epsilon = std::numeric_limits<S>::epsilon();
  EXPECT_NEAR(surface.density(), sum(place), S(100) * epsilon);
  // The rounding error of the central difference is epsilon C / h, its truncation error h^2 C''' / 6 (0.3 h^2 for the
  // smooth metaball; zero for the paper's).
  const S h = std::cbrt(epsilon);
  Point gradient;
  for (int c = 0; c < TypeParam::D; ++c) {
    Point step = Point::Zero();
    step[c] = h;
    gradient[c] = (sum(place + step) - sum(place - step)) / (S(2) * h);
  }
  const Point ours = surface.gradient(S(1) / (this->radius * this->radius));
  EXPECT_LT((ours - gradient).norm(), S(30) * h * h);
  Point n;
  ASSERT_TRUE(surface.normal(this->radius, n));
  EXPECT_NEAR(n.norm(), S(1), S(10) * epsilon);
  EXPECT_LT((n + gradient.normalized()).norm(), S(60) * h * h);
  EXPECT_GT(n[TypeParam::D - 1], S(0.5)) << "from the wall to the slave";
}

TYPED_TEST(MasterSurfaceTest, DistanceOfAFlatWallIsTheHeightLessHalfAParticle) {
  using S = typename TypeParam::S;
  using Point = typename TestFixture::Vec;
  this->wall(TestFixture::Mat::Identity());
  const hmps::NormalDensity<S, TypeParam::D, typename TypeParam::Ball> Z(S(1));
  for (const S y : {S(0.3), S(0.7), S(1)}) {
    const auto surface = this->at(this->above(y));
    Point n;
    ASSERT_TRUE(surface.normal(this->radius, n));
    const S distance = hmps::surface_distance(surface.stretch(n), Z.inverse(surface.density()).value, S(1));
    // The bumps of the paper's wall are 0.085 spacings high (2D: 0.2), those of the smooth one 0.01.
    constexpr bool paper = std::is_same_v<typename TypeParam::Ball, hmps::PaperMetaball>;
    EXPECT_NEAR(distance, y - S(0.5), paper ? 0.15 : 0.01);
  }
}

TYPED_TEST(MasterSurfaceTest, FollowsStretchAndRotationOfTheWall) {
  using S = typename TypeParam::S;
  using Point = typename TestFixture::Vec;
  using Tensor = typename TestFixture::Mat;
  const hmps::NormalDensity<S, TypeParam::D, typename TypeParam::Ball> Z(S(1));
  this->wall(Tensor::Identity());
  const Point place = this->above(S(0.9));
  const auto plain = this->at(place);
  Point n0;
  ASSERT_TRUE(plain.normal(this->radius, n0));

  // Stretched twice in all directions: the same sum at twice the height, twice the distance.
  this->wall(S(2) * Tensor::Identity());
  const auto stretched = this->at(S(2) * place);
  Point n;
  ASSERT_TRUE(stretched.normal(this->radius, n));
  EXPECT_NEAR(stretched.density(), plain.density(), S(1e-5));
  EXPECT_NEAR(stretched.stretch(n), S(2), S(1e-5));
  EXPECT_LT((n - n0).norm(), S(1e-5));

  // Stretched along the wall only: nothing changes across it.
  Tensor F = Tensor::Identity();
  F(0, 0) = S(2);
  this->wall(F);
  const auto along = this->at(F * place);
  ASSERT_TRUE(along.normal(this->radius, n));
  EXPECT_NEAR(along.density(), plain.density(), S(1e-5));

  Tensor R = Tensor::Identity();
  R(0, 0) = R(1, 1) = S(0.8);
  R(0, 1) = S(-0.6);
  R(1, 0) = S(0.6);
  this->wall(R);
  const auto turned = this->at(R * place);
  ASSERT_TRUE(turned.normal(this->radius, n));
  EXPECT_NEAR(turned.density(), plain.density(), S(1e-5));
  EXPECT_LT((n - R * n0).norm(), S(1e-5));
  EXPECT_NEAR(turned.stretch(n), S(1), S(1e-5));
}

TYPED_TEST(MasterSurfaceTest, VelocityIsThatOfTheWallRelativeToTheSlave) {
  using S = typename TypeParam::S;
  using Point = typename TestFixture::Vec;
  this->wall(TestFixture::Mat::Identity());
  this->v.assign(this->x.size(), Point::Constant(S(3)));
  const auto surface = this->at(this->above(S(0.8)));
  EXPECT_LT((surface.relative_velocity(Point::Constant(S(1))) - Point::Constant(S(2))).norm(), S(1e-5));
}

TYPED_TEST(MasterSurfaceTest, HasNoNormalInTheMiddleOfAWall) {
  using S = typename TypeParam::S;
  using Point = typename TestFixture::Vec;
  this->wall(TestFixture::Mat::Identity());
  Point middle = Point::Zero(), n = Point::Constant(S(7));
  middle[TypeParam::D - 1] = S(-1);
  EXPECT_FALSE(this->at(middle).normal(this->radius, n));
  EXPECT_EQ(n, Point::Zero());
  EXPECT_FALSE((typename TestFixture::Surface{}).normal(this->radius, n)) << "no master at all";
}

}  // namespace master_surface_test
