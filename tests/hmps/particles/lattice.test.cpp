// SPDX-License-Identifier: MIT
#include "hmps/particles/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "../../reference/two_threads.hpp"

namespace lattice_test {

using hmps::Box;
using hmps::Vector;

template <class S_, int D_>
struct Case {
  using S = S_;
  static constexpr int D = D_;
};
template <class T>
class Lattice : public testing::Test {};
using Cases = testing::Types<Case<float, 2>, Case<double, 2>, Case<float, 3>, Case<double, 3>>;
TYPED_TEST_SUITE(Lattice, Cases);

struct Everywhere {
  template <class V>
  typename V::Scalar operator()(const V&) const {
    return -1;
  }
};

/// Runs the loop backwards over three threads, one after another.
struct Shuffled {
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    for (std::size_t part = 0; part < 3; ++part)
      std::thread([&] {
        for (std::size_t i = n; i-- > 0;)
          if (i % 3 == part) body(i);
      }).join();
  }
};

TYPED_TEST(Lattice, HoldsEverySiteOfTheBoxOnceInOrder) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  V upper = V::Constant(S(0.3));
  upper[0] = S(0.5);
  // 0.3 / 0.1 is below 3 in both scalars; the site at the end belongs to the box nevertheless.
  const auto points = hmps::fill_lattice(Everywhere{}, Box<S, D>{V::Zero(), upper}, S(0.1));
  ASSERT_EQ(points.size(), D == 2 ? 6u * 4u : 6u * 4u * 4u);
  std::size_t n = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < (D == 2 ? 1 : 4); ++j)
      for (int k = 0; k < 4; ++k, ++n) {
        V site = V::Constant(S(j));
        site[0] = S(i);
        site[D - 1] = S(k);
        EXPECT_LE((points[n] - S(0.1) * site).norm(), S(4) * std::numeric_limits<S>::epsilon());
      }
}

TYPED_TEST(Lattice, HasTheVolumeOfTheShape) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  const double l0 = 0.02;
  const hmps::Ball<S, D> ball{.centre = V::Constant(S(0.013)), .radius = S(0.5)};
  const auto points = hmps::fill_lattice(ball, Box<S, D>{V::Constant(S(-1)), V::Constant(S(1))}, static_cast<S>(l0));
  const double expected = D == 2 ? std::numbers::pi / 4 : std::numbers::pi / 6;
  EXPECT_NEAR(static_cast<double>(points.size()) * std::pow(l0, D) / expected, 1.0, 0.01);
  for (const V& x : points) EXPECT_LT(ball(x), S(0));
}

// Sites on faces: those on the lower sides count, however origin, corners and spacing are rounded.
TYPED_TEST(Lattice, ABoxOfTenSpacingsHoldsTenSitesWhateverTheOrigin) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  for (const double l0 : {2e-3, 1.2e-3, 1e-3 / 3, 0.7, 1e-6}) {
    for (const double corner : {0.0, 1.0, -10.0, -5.0, 3.7, 0.1, -41.3}) {
      for (const double shift : {0.0, 0.5, 1.0 / 3, -7.0}) {
        const auto at = [&](double spacings) { return V(V::Constant(static_cast<S>(l0 * spacings))); };
        const Box<S, D> box{at(corner), at(corner + 10)};
        // Sites on the faces, and between them.
        for (const V& origin : {at(corner + shift), at(shift)})
          EXPECT_EQ(hmps::fill_lattice(box, static_cast<S>(l0), origin).size(), D == 2 ? 100u : 1000u)
              << l0 << " from " << corner << ", origin " << origin.transpose();
        EXPECT_EQ(hmps::fill_lattice(box, static_cast<S>(l0)), hmps::fill_lattice(box, box, static_cast<S>(l0)));
      }
    }
  }
}

// Bodies that share a face have no sites of it in common, and none is lost between them.
TYPED_TEST(Lattice, NoSiteIsLostBetweenBodiesThatTouch) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  const Box<S, D> region{V::Constant(S(-0.1)), V::Constant(S(1.1))};
  V lower = V::Ones(), upper = V::Zero();
  lower[0] = upper[0] = S(0.3);
  const Box<S, D> left{V::Zero(), lower}, right{upper, V::Ones()};
  const std::size_t row = D == 2 ? 10 : 100;
  const auto count = [&](const auto& shape) { return hmps::fill_lattice(shape, region, S(0.1)).size(); };
  EXPECT_EQ(count(left), 3 * row);
  EXPECT_EQ(count(right), 7 * row);
  EXPECT_EQ(count([&](const V& x) { return std::min(left(x), right(x)); }), 10 * row);
  V diagonal = V::Zero();
  diagonal[0] = 1;
  diagonal[1] = -1;
  const hmps::HalfSpace<S, D> below{.point = V::Zero(), .outward = diagonal}, above{V::Zero(), -diagonal};
  const Box<S, D> unit{V::Zero(), V::Ones()};
  const auto part = [&](const auto& half) { return count([&](const V& x) { return std::max(unit(x), half(x)); }); };
  EXPECT_EQ(part(below), 45 * row / 10);
  EXPECT_EQ(part(above), 55 * row / 10);
}

// A site of each pair of opposite ones on the surface counts, so that the ball is symmetric only without such sites.
TYPED_TEST(Lattice, ABallAboutASiteIsSymmetricUnlessSitesLieOnIt) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  const auto off_centre = [](S radius, S origin) {
    const Box<S, D> box{V::Constant(S(-8)), V::Constant(S(8))};
    V sum = V::Zero();
    for (const V& x : hmps::fill_lattice(hmps::Ball<S, D>{.radius = radius}, box, S(1), V(V::Constant(origin))))
      sum += x;
    return sum.norm();
  };
  EXPECT_GT(off_centre(5, 0), 1);
  EXPECT_EQ(off_centre(S(5.2), 0), 0);
  EXPECT_EQ(off_centre(5, S(0.5)), 0);
}

TYPED_TEST(Lattice, StartsAtTheGivenOrigin) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  const V origin = V::Constant(S(0.25));
  const auto points =
      hmps::fill_lattice(Everywhere{}, Box<S, D>{V::Constant(S(-1)), V::Constant(S(1))}, S(0.5), origin);
  ASSERT_EQ(points.size(), D == 2 ? 16u : 64u);
  EXPECT_EQ(points.front(), V(V::Constant(S(-0.75))));
  EXPECT_EQ(points.back(), V(V::Constant(S(0.75))));
}

TYPED_TEST(Lattice, IsTheSameForEveryExecutor) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  const hmps::Ball<S, D> ball{.centre = V::Zero(), .radius = S(1)};
  const Box<S, D> box{V::Constant(S(-1)), V::Constant(S(1))};
  const auto serial = hmps::fill_lattice(ball, box, S(0.1));
  const auto other = hmps::fill_lattice(ball, box, S(0.1), V(V::Zero()), Shuffled{});
  EXPECT_EQ(serial, other);
}

TYPED_TEST(Lattice, IsEmptyOutsideTheShape) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  const auto nowhere = [](const V&) { return S(1); };
  EXPECT_TRUE(hmps::fill_lattice(nowhere, Box<S, D>{V::Zero(), V::Ones()}, S(0.25)).empty());
  EXPECT_TRUE(hmps::fill_lattice(Everywhere{}, Box<S, D>{V::Constant(S(0.1)), V::Constant(S(0.2))}, S(1)).empty());
}

TYPED_TEST(Lattice, RefusesWhatCannotBeFilled) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  using V = Vector<S, D>;
  const Box<S, D> unit{V::Zero(), V::Ones()};
  const S infinity = std::numeric_limits<S>::infinity();
  for (const S spacing : {S(0), S(-1), std::numeric_limits<S>::quiet_NaN(), infinity})
    EXPECT_THROW((void)hmps::fill_lattice(Everywhere{}, unit, spacing), hmps::InputError);
  EXPECT_THROW((void)hmps::fill_lattice(Everywhere{}, Box<S, D>{V::Ones(), V::Zero()}, S(0.1)), hmps::InputError);
  EXPECT_THROW((void)hmps::fill_lattice(Everywhere{}, Box<S, D>{V::Zero(), V::Constant(infinity)}, S(0.1)),
               hmps::InputError);
  EXPECT_THROW((void)hmps::fill_lattice(Everywhere{}, unit, S(0.1), V(V::Constant(infinity))), hmps::InputError);
  const auto nan = [](const V&) { return std::numeric_limits<S>::quiet_NaN(); };
  EXPECT_THROW((void)hmps::fill_lattice(nan, unit, S(0.5)), hmps::InputError);
  const V most = V::Constant(std::numeric_limits<S>::max());
  EXPECT_THROW((void)hmps::fill_lattice(Everywhere{}, Box<S, D>{-most, most}, S(1)), hmps::InputError);
  EXPECT_THROW((void)hmps::fill_lattice(Everywhere{}, Box<S, D>{most, most}, S(1), V(-most)), hmps::InputError);
  EXPECT_THROW((void)hmps::fill_lattice(Everywhere{}, unit, std::numeric_limits<S>::denorm_min()), hmps::InputError);
  try {
    (void)hmps::fill_lattice(Everywhere{}, unit, S(1e-7));
    ADD_FAILURE() << "1e14 sites or more were accepted";
  } catch (const hmps::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("sites"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("larger spacing"), std::string::npos) << error.what();
  }
}

/// The number of sites of a box of 10 mm with a corner at `corner` (m) in every direction; 0 if it is refused.
template <class S>
std::size_t sites_at(double corner) {
  using V = Vector<S, 3>;
  const V lower = V::Constant(static_cast<S>(corner));
  try {
    return hmps::fill_lattice(Box<S, 3>{lower, V(lower + V::Constant(S(0.01)))}, S(1e-3), lower).size();
  } catch (const hmps::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("do not resolve 0.01 of the spacing of"), std::string::npos)
        << error.what();
    return 0;
  }
}

TEST(LatticeMisuse, IsRefusedWhereItsScalarDoesNotResolveTheSpacing) {
  for (const double corner : {0.0, 10.0, -50.0, 80.0}) EXPECT_EQ(sites_at<float>(corner), 1000U) << corner;
  for (const double corner : {90.0, 1e3, -1e3, 1e4, 1e6, 1e9}) EXPECT_EQ(sites_at<float>(corner), 0U) << corner;
  for (const double corner : {1e3, 1e6}) EXPECT_EQ(sites_at<double>(corner), 1000U) << corner;
  // The origin of the lattice too is given in that scalar.
  const Box<float, 2> box{Vector<float, 2>(0, 0), Vector<float, 2>(0.01f, 0.01f)};
  EXPECT_THROW((void)hmps::fill_lattice(box, 1e-3f, Vector<float, 2>(1e4f, 0)), hmps::InputError);
}

TEST(FillLattice, KeepsTheErrorOfTheShapeFromTheUsersThreads) {
  using V = Vector<double, 3>;
  const auto broken = [](const V& x) { return x[0] < 0.2 ? std::numeric_limits<double>::quiet_NaN() : x[0] - 0.5; };
  const std::string error = hmps_test::message_in_two_threads([&](const auto& execute) {
    (void)hmps::fill_lattice(broken, Box<double, 3>{V::Zero(), V::Ones()}, 0.1, V(V::Zero()), execute);
  });
  EXPECT_NE(error.find("NaN"), std::string::npos) << error;
}

}  // namespace lattice_test
