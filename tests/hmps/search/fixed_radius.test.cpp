// SPDX-License-Identifier: MIT
#include "hmps/search/fixed_radius.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "../../reference/backwards.hpp"
#include "../../reference/scenes.hpp"
#include "../../reference/two_threads.hpp"

namespace fixed_radius_test {

using hmps_test::Backwards;

template <class Case>
class FixedRadius : public testing::Test {};
using Cases =
    testing::Types<std::tuple<float, std::integral_constant<int, 2>>, std::tuple<float, std::integral_constant<int, 3>>,
                   std::tuple<double, std::integral_constant<int, 2>>,
                   std::tuple<double, std::integral_constant<int, 3>>>;
TYPED_TEST_SUITE(FixedRadius, Cases);

template <class T, int D>
std::vector<hmps::Vector<T, D>> cloud(std::size_t n, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<hmps::Vector<T, D>> points(n);
  for (auto& p : points)
    for (int d = 0; d < D; ++d) p[d] = static_cast<T>(random(-1, 1));
  return points;
}

TYPED_TEST(FixedRadius, AgreesWithBruteForce) {
  using T = std::tuple_element_t<0, TypeParam>;
  constexpr int D = std::tuple_element_t<1, TypeParam>::value;
  const auto points = cloud<T, D>(700, 5);
  const T radius = D == 2 ? T(0.17) : T(0.4);
  const hmps::NeighbourList list = hmps::find_neighbours(hmps::vectors(points), radius);
  const hmps::NeighbourList backwards = hmps::find_neighbours(hmps::vectors(points), radius, Backwards{});
  EXPECT_EQ(list.neighbour, backwards.neighbour);
  ASSERT_EQ(list.size(), points.size());
  std::size_t total = 0;
  const double slack = 4 * std::numeric_limits<T>::epsilon();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto found = list[i];
    total += found.size();
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
    for (std::size_t j = 0; j < points.size(); ++j) {
      const bool listed = std::binary_search(found.begin(), found.end(), static_cast<hmps::Index>(j));
      const double distance = (points[j] - points[i]).template cast<double>().norm();
      if (i == j) {
        EXPECT_FALSE(listed) << i;
      } else if (std::abs(distance - radius) > slack * radius) {
        EXPECT_EQ(listed, distance < radius) << i << ' ' << j;
      }
      if (listed) {
        EXPECT_TRUE(std::binary_search(list[j].begin(), list[j].end(), static_cast<hmps::Index>(i))) << i << ' ' << j;
      }
    }
  }
  EXPECT_GT(total, 10 * points.size()) << "the test checks too few neighbours";

  const hmps::FixedRadiusSearch search(hmps::vectors(points));
  for (std::size_t i = 0; i < points.size(); i += 7) {
    EXPECT_EQ(search.count(points[i], radius), list[i].size() + 1);
    T nearest = std::numeric_limits<T>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i) nearest = std::min(nearest, (points[j] - points[i]).norm());
    EXPECT_NEAR(search.nearest(i), nearest, slack * nearest) << i;
  }
}

// Distances between integer points are exact in both scalars: 3-4-5 and the radius itself are in the ball.
TYPED_TEST(FixedRadius, IsAClosedBall) {
  using T = std::tuple_element_t<0, TypeParam>;
  constexpr int D = std::tuple_element_t<1, TypeParam>::value;
  std::vector<hmps::Vector<T, D>> points;
  for (int k = 0; k < (D == 2 ? 900 : 2744); ++k) {
    const int side = D == 2 ? 30 : 14;
    hmps::Vector<T, D> p;
    for (int d = 0, rest = k; d < D; ++d, rest /= side) p[d] = static_cast<T>(rest % side);
    points.push_back(p);
  }
  const hmps::FixedRadiusSearch search(hmps::vectors(points));
  std::vector<hmps::Index> found;
  for (const int radius : {1, 2, 5})
    for (std::size_t i = 0; i < points.size(); i += 7) {
      search(points[i], static_cast<T>(radius), found);
      std::vector<hmps::Index> expected;
      for (std::size_t j = 0; j < points.size(); ++j)
        if ((points[j] - points[i]).squaredNorm() <= static_cast<T>(radius * radius))
          expected.push_back(static_cast<hmps::Index>(j));
      EXPECT_EQ(found, expected) << "radius " << radius << " around " << i;
    }
}

// Lattices whose spacing is not a binary fraction: the search must decide by the rounded distance, not by a bound of
// the tree that is rounded in another way.
TYPED_TEST(FixedRadius, IsNotAffectedByTheRoundingOfTheTree) {
  using T = std::tuple_element_t<0, TypeParam>;
  constexpr int D = std::tuple_element_t<1, TypeParam>::value;
  scenes::Random random(9);
  std::vector<hmps::Vector<T, D>> points;
  for (int k = 0; k < (D == 2 ? 400 : 1000); ++k) {
    const int side = D == 2 ? 20 : 10;
    hmps::Vector<T, D> p;
    for (int d = 0, rest = k; d < D; ++d, rest /= side)
      p[d] = static_cast<T>(0.1) * static_cast<T>(rest % side) + static_cast<T>(0.03);
    points.push_back(p);
  }
  random.shuffle(points);
  const hmps::FixedRadiusSearch search(hmps::vectors(points));
  std::vector<hmps::Index> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // The radius is the distance to another particle, to the last bit.
    const std::size_t j = (i + 1 + random.bits() % (points.size() - 1)) % points.size();
    T squared = 0;
    for (int d = 0; d < D; ++d) squared += (points[i][d] - points[j][d]) * (points[i][d] - points[j][d]);
    T radius = std::sqrt(squared);
    while (radius * radius < squared) radius = std::nextafter(radius, std::numeric_limits<T>::infinity());
    search(points[i], radius, found);
    EXPECT_TRUE(std::binary_search(found.begin(), found.end(), static_cast<hmps::Index>(j))) << i << ' ' << j;
  }
}

TYPED_TEST(FixedRadius, HandlesNoParticleAndOneParticle) {
  using T = std::tuple_element_t<0, TypeParam>;
  constexpr int D = std::tuple_element_t<1, TypeParam>::value;
  std::vector<hmps::Vector<T, D>> points;
  EXPECT_EQ(hmps::find_neighbours(hmps::vectors(points), T(1)).size(), 0u);
  points.push_back(hmps::Vector<T, D>::Zero());
  const auto list = hmps::find_neighbours(hmps::vectors(points), T(1));
  ASSERT_EQ(list.size(), 1u);
  EXPECT_TRUE(list[0].empty());
}

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const hmps::InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(FixedRadiusErrors, NameTheParticles) {
  auto points = cloud<double, 3>(200, 6);
  const auto search = [&](double radius) {
    return error_of([&] { (void)hmps::find_neighbours(hmps::vectors(points), radius); });
  };
  EXPECT_TRUE(has(search(0), "search radius is 0")) << search(0);
  EXPECT_TRUE(has(search(-0.5), "search radius is -0.5")) << search(-0.5);
  EXPECT_TRUE(has(search(std::numeric_limits<double>::quiet_NaN()), "nan"));
  EXPECT_TRUE(has(search(std::numeric_limits<double>::infinity()), "inf"));
  points[150] = points[20];
  EXPECT_TRUE(has(search(0.3), "particles 20 and 150 lie at the same place")) << search(0.3);
  points[77][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(has(search(0.3), "component 2 of the position of particle 77 is nan")) << search(0.3);
}

TEST(FixedRadiusSearchMisuse, IsRefused) {
  using V = hmps::Vector<double, 3>;
  const std::vector<V> points{V(0, 0, 0), V(1, 0, 0)};
  const hmps::FixedRadiusSearch<const double, 3> search(hmps::vectors(points));
  std::vector<hmps::Index> found;
  for (const double radius : {-1.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(search(points[0], radius, found), hmps::InputError);
    EXPECT_THROW((void)search.count(points[0], radius), hmps::InputError);
  }
  EXPECT_THROW(search(V(NAN, 0, 0), 1.5, found), hmps::InputError);
  EXPECT_THROW((void)search.nearest(2), hmps::InputError);
}

/// All pairs of 20,000 particles would take gigabytes.
TEST(FindNeighbours, RefusesARadiusInAnotherUnit) {
  std::vector<hmps::Vector<double, 3>> points;
  for (int i = 0; i < 20000; ++i) points.emplace_back(1e-3 * i, 0, 0);
  EXPECT_THROW((void)hmps::find_neighbours(hmps::vectors(points), 100.0), hmps::InputError);
  EXPECT_EQ(hmps::find_neighbours(hmps::vectors(points), 1.5e-3).neighbour.size(), 2 * 19999U);
}

TEST(NeighbourList, RefusesAParticleThatDoesNotExist) {
  const std::vector<hmps::Vector<double, 2>> points{{0, 0}, {1, 0}};
  const auto list = hmps::find_neighbours(hmps::vectors(points), 1.5);
  EXPECT_EQ(list[1].size(), 1u);
  EXPECT_THROW((void)list[2], hmps::InputError);
}

TEST(NeighbourList, IsEmptyAfterAMove) {
  const std::vector<hmps::Vector<double, 2>> points{{0, 0}, {1, 0}};
  auto list = hmps::find_neighbours(hmps::vectors(points), 1.5);
  const auto moved = std::move(list);
  EXPECT_EQ(moved.size(), 2U);
  EXPECT_EQ(list.size(), 0U);                     // NOLINT(bugprone-use-after-move)
  EXPECT_THROW((void)list[0], hmps::InputError);  // NOLINT(bugprone-use-after-move)
}

TEST(FindNeighbours, KeepsTheErrorOfAParticleFromTheUsersThreads) {
  auto points = cloud<double, 3>(200, 7);
  points[150] = points[20];
  const std::string error = hmps_test::message_in_two_threads(
      [&](const auto& execute) { (void)hmps::find_neighbours(hmps::vectors(points), 0.3, execute); });
  EXPECT_NE(error.find("particles 20 and 150 lie at the same place"), std::string::npos) << error;
}

}  // namespace fixed_radius_test
