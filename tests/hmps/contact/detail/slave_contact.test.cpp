// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/slave_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "../plain_contact.hpp"
#include "hmps/core/math.hpp"

namespace slave_contact_test {

using hmps::Index;
using Vector = hmps::Vector<double, 3>;
using Matrix = hmps::Matrix<double, 3>;
using Found = hmps::detail::SlaveContact<double, 3>;

constexpr double l0 = 1e-3;

/// A wall of two layers that fills z <= 0, shaken, and a slave `height` spacings above its upper layer.
struct Scene {
  std::vector<Vector> x, v;
  std::vector<Matrix> F;  // the slave is the last
  explicit Scene(double height, double speed = 1, double strain = 0.1) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = -4; i <= 4; ++i)
      for (int j = -4; j <= 4; ++j)
        for (int k = -1; k <= 0; ++k) x.emplace_back(i * l0, j * l0, k * l0);
    x.emplace_back(0.2 * l0, 0.3 * l0, height * l0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      v.emplace_back(speed * u(random), speed * u(random), speed * u(random));
      F.push_back(Matrix::Identity());
      for (int c = 0; c < 9; ++c) F.back()(c % 3, c / 3) += strain * u(random);
    }
  }

  struct Result {
    Found contact;
    Vector normal = Vector::Zero();
    std::vector<double> c;
  };
  template <class Ball>
  [[nodiscard]] Result operator()(double compression = 1e3) const {
    const hmps::NormalDensity<double, 3, Ball> Z(l0);
    const std::size_t slave = x.size() - 1;
    std::vector<hmps::detail::Master<double, 3>> masters(slave);
    std::vector<hmps::detail::MovingMaster<double, 3>> moving(slave);
    std::vector<Index> number;
    for (std::size_t j = 0; j < slave; ++j) {
      const Matrix B = hmps::inverse<double, 3>(F[j]), A = B.transpose() * B;
      hmps::detail::set_quad<double>(x[j], masters[j].x);
      hmps::detail::set_quad<double>(v[j], moving[j].v);
      for (int q = 0; q < 3; ++q) {
        hmps::detail::set_quad<double>(A.col(q), masters[j].A[q]);
        hmps::detail::set_quad<double>(B.col(q), moving[j].B[q]);
      }
      number.push_back(static_cast<Index>(j));
    }
    hmps::detail::Quad<double> place;
    hmps::detail::set_quad<double>(x[slave], place);
    Result result;
    result.c.resize(slave);
    result.contact = hmps::detail::slave_contact<double, 3, Ball>(
        Z, place, {masters.data(), moving.data(), number.data(), slave}, l0 / 2, compression, [&] { return F[slave]; },
        [&] { return v[slave]; }, result.normal, result.c.data());
    return result;
  }
};

/// Compares with the equations taken literally, one after the other.
template <class Ball>
void compare_with_plain(int power) {
  for (const double height : {0.95, 0.85, 0.7}) {
    const Scene scene(height);
    const auto found = scene.operator()<Ball>();
    ASSERT_GT(found.contact.penetration, 0) << height;
    // Forces of a wall of unit stiffness, without friction and with one that always sticks: k p n, and rho / dt v_tan.
    plain::Contact literal{l0, 1, 1, 0, 1, Ball::radius, power, false, {}};
    std::vector<std::size_t> masters;
    for (std::size_t j = 0; j + 1 < scene.x.size(); ++j) masters.push_back(j);
    literal.sides.push_back({{scene.x.size() - 1}, masters});
    const std::vector<plain::Vec> x(scene.x.begin(), scene.x.end()), v(scene.v.begin(), scene.v.end());
    const std::vector<plain::Mat> F(scene.F.begin(), scene.F.end());
    const auto pushed = literal(x, v, F);
    literal.friction = 1e9;
    const auto dragged = literal(x, v, F);
    ASSERT_EQ(pushed.contacts, 1U);
    // Z^-1 is accurate to 1e-6 l0; the error is multiplied by a stretch of 1.2.
    const Vector pn = found.contact.penetration * found.normal;
    EXPECT_LE((pushed.f.back() - pn).norm(), 2e-6 * l0) << height;
    const Vector& slip = found.contact.slip;
    const Vector along = slip - slip.dot(found.normal) * found.normal;
    EXPECT_LE((dragged.f.back() - pushed.f.back() - along).norm(), 1e-12) << height;
    // (41, 42): the share of each master in the reaction.
    for (const std::size_t j : masters)
      EXPECT_LE((pushed.f[j] + found.c[j] * found.contact.over_density * pn).norm(), 2e-6 * l0) << j;
  }
}

TEST(SlaveContact, IsTheEquationsTakenLiterally) {
  compare_with_plain<hmps::SmoothMetaball>(3);
  compare_with_plain<hmps::PaperMetaball>(1);
}

TEST(SlaveContact, NothingTouchesFurtherThanASpacing) {
  for (const double height : {1.1, 2., 3., 10.}) {
    const auto found = Scene(height, 1, 0).operator()<hmps::SmoothMetaball>();
    EXPECT_EQ(found.contact.penetration, 0) << height;
    EXPECT_FALSE(found.contact.lost) << height;
  }
}

/// A valid bound of the compression changes no result: it only saves the second pass.
TEST(SlaveContact, ABoundThatHoldsChangesNothing) {
  for (const double height : {1.3, 1., 0.9}) {
    const Scene scene(height);
    const auto free = scene.operator()<hmps::SmoothMetaball>(), bound = scene.operator()<hmps::SmoothMetaball>(1.5);
    EXPECT_EQ(free.contact.penetration, bound.contact.penetration) << height;
    EXPECT_EQ(free.normal, bound.normal);
  }
}

TEST(SlaveContact, SaysWhereTheWallDoesNotTellWhichWayIsOut) {
  EXPECT_FALSE(Scene(0.5, 1, 0).operator()<hmps::SmoothMetaball>().contact.lost);
  // In the middle of two layers there is no normal: the depth is that in an undeformed wall.
  Scene middle(-0.5, 1, 0);
  middle.x.back().head<2>().setZero();
  const auto found = middle.operator()<hmps::PaperMetaball>();
  EXPECT_TRUE(found.contact.lost);
  EXPECT_EQ(found.contact.penetration, 0);
  EXPECT_GT(found.contact.depth, l0);
  // A little to either side of it there is one, but the sum hardly falls.
  middle.x.back()[2] += 0.1 * l0;
  const auto beside = middle.operator()<hmps::PaperMetaball>();
  EXPECT_TRUE(beside.contact.lost);
  EXPECT_GT(beside.contact.penetration, 0);
  EXPECT_TRUE(beside.contact.inside);
}

}  // namespace slave_contact_test
