// SPDX-License-Identifier: MIT
#include "hmps/search/nearest_spacing.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace nearest_spacing_test {

using V = hmps::Vector<double, 3>;

TEST(NearestSpacing, IsThatOfALatticeInAnyOrder) {
  std::vector<V> points;
  for (int i = 0; i < 1000; ++i) {
    const int k = i * 367 % 1000;  // a permutation
    points.push_back(1.2e-3 * V(k % 10, k / 10 % 10, k / 100));
  }
  EXPECT_NEAR(hmps::nearest_spacing(hmps::vectors(points)), 1.2e-3, 1e-15);
  points.push_back(V(7, 7, 7));      // one far away
  points.push_back(points.front());  // and one doubled
  EXPECT_NEAR(hmps::nearest_spacing(hmps::vectors(points)), 1.2e-3, 1e-15);
}

TEST(NearestSpacing, IsZeroWithoutNeighbours) {
  std::vector<V> points;
  EXPECT_EQ(hmps::nearest_spacing(hmps::vectors(points)), 0);
  points.assign(3, V::Ones());
  EXPECT_EQ(hmps::nearest_spacing(hmps::vectors(points)), 0);
}

TEST(NearestSpacing, IsNamedWhereAnotherWasGiven) {
  const std::vector<V> points{V(0, 0, 0), V(1, 0, 0), V(2, 0, 0)};
  EXPECT_EQ(hmps::detail::spacing_hint(hmps::vectors(points), 1.0), "");
  const std::string hint = hmps::detail::spacing_hint(hmps::vectors(points), 1000.0);
  EXPECT_NE(hint.find("is the spacing 1 m?"), std::string::npos) << hint;
  // Neighbours in a fitted cloud are a few per cent further apart than its spacing.
  EXPECT_NE(hmps::detail::spacing_hint(hmps::vectors(points), 0.98), "");
  EXPECT_EQ(hmps::detail::spacing_hint(hmps::vectors(points), 0.98, 0.15), "");
}

}  // namespace nearest_spacing_test
