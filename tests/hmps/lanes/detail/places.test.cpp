// SPDX-License-Identifier: MIT
#include "hmps/lanes/detail/places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "../../../reference/scenes.hpp"
#include "hmps/core/view.hpp"

namespace places_test {

template <class K>
class Places : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Places, Scalars);

template <class K>
struct Ordered : hmps::Blocks<K, 2> {
  Ordered(const scenes::Points<2>& points, const std::vector<hmps::Index>& order)
      : hmps::Blocks<K, 2>(hmps::vectors(points), order) {}
};

// Pairs up to the radius apart in a body of a million radii, off the origin: r0 agrees with that of the positions in
// double to half a unit in the last place of K plus the rounding to whole numbers, also where these pass 2^32.
TYPED_TEST(Places, GiveR0ToTheRoundingOfTheKernelsAndOfOppositeSignFromBothEnds) {
  using K = TypeParam;
  constexpr std::size_t width = hmps::Blocks<K, 2>::width;
  scenes::Random random(8);
  for (const double radius : {2.1e-3, 1.0, 1.024}) {
    SCOPED_TRACE(radius);
    scenes::Points<2> points;
    for (int k = 0; k < 500; ++k) {
      const double extent = radius * std::pow(10.0, k % 7);
      const hmps::Vector<double, 2> at(random(-extent, extent), 0.3 * radius + random(-extent, extent));
      const double angle = random(0, 6.28), length = radius * (k % 5 == 0 ? 1.0 : random());
      points.push_back(at);
      points.push_back(at + length * hmps::Vector<double, 2>(std::cos(angle), std::sin(angle)));
    }
    std::vector<hmps::Index> order(points.size());
    std::iota(order.begin(), order.end(), hmps::Index{0});
    const Ordered<K> blocks(points, order);
    const hmps::detail::Places<K, 2> places(blocks, radius * (1 + 1e-9));
    for (std::size_t i = 0; i < points.size(); i += 2)
      for (int c = 0; c < 2; ++c) {
        const K* const slots = places.slots(blocks, c);
        const K there = places.offset(slots[i + 1], slots[i]), back = places.offset(slots[i], slots[i + 1]);
        const double r0 = points[i + 1][c] - points[i][c];
        // Both ends are rounded to whole numbers of at most 2^-29 of the radius.
        const double rounding = sizeof(K) == 4 ? std::ldexp(radius, -29) + std::ldexp(std::abs(r0), -24) : 0.0;
        EXPECT_NEAR(static_cast<double>(there), r0, rounding);
        EXPECT_EQ(there, -back);
        // A block of lanes at once.
        if (i % width != 0 || i + 1 + width > points.size()) continue;
        const hmps::Lanes<K> lanes = places.offset(hmps::detail::load(slots + i + 1), hmps::detail::load(slots + i));
        for (std::size_t l = 0; l < width; ++l)
          EXPECT_EQ(lanes.lane[l], places.offset(slots[i + 1 + l], slots[i + l])) << l;
      }
  }
}

}  // namespace places_test
