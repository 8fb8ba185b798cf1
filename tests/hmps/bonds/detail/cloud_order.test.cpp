// SPDX-License-Identifier: MIT
#include "hmps/bonds/detail/cloud_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "../../../reference/scenes.hpp"
#include "hmps/core/view.hpp"

namespace cloud_order_test {

template <int D>
std::vector<hmps::Index> order_of(const scenes::Points<D>& points) {
  return hmps::detail::CloudOrder<D>(hmps::vectors(points), scenes::Scene<D>::spacing).order;
}

template <class Dimension>
class CloudOrder : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CloudOrder, Dimensions);

TYPED_TEST(CloudOrder, HoldsEveryParticleOnceInAnyInputOrder) {
  constexpr int D = TypeParam::value;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    const std::vector<hmps::Index> order = order_of<D>(scene.reference);
    std::vector<hmps::Index> sorted = order, all(scene.reference.size());
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), hmps::Index{0});
    ASSERT_EQ(sorted, all);

    scenes::Points<D> shuffled = scene.reference;
    scenes::Random(5).shuffle(shuffled);
    const std::vector<hmps::Index> other = order_of<D>(shuffled);
    for (std::size_t s = 0; s < order.size(); ++s)
      ASSERT_EQ(shuffled[other[s]], scene.reference[order[s]]) << "at place " << s;
  }
}

// The rods of a shuffled lattice with a jitter of a quarter of a spacing in all are its rows, along the direction that
// gives the fewest of them, which is not the last one here.
TYPED_TEST(CloudOrder, FollowsTheRowsOfALattice) {
  constexpr int D = TypeParam::value;
  constexpr double l0 = scenes::Scene<D>::spacing;
  const scenes::Points<D> lattice = scenes::box<D>(scenes::extent<D>(31, 5, 6));
  for (const double jitter : {0.0, 0.12}) {
    scenes::Random random(4);
    scenes::Points<D> points = lattice;
    random.shuffle(points);
    for (auto& p : points)
      for (int d = 0; d < D; ++d) p[d] += jitter * l0 * random(-1, 1);
    const std::vector<hmps::Index> order = order_of<D>(points);
    for (std::size_t s = 1; s < order.size(); ++s) {
      if (s % 31 == 0) continue;  // the next row
      const hmps::Vector<double, D> step = points[order[s]] - points[order[s - 1]];
      for (int d = 0; d < D; ++d) ASSERT_NEAR(step[d], d == 0 ? l0 : 0.0, (2 * jitter + 1e-9) * l0) << s;
    }
  }
}

// A cube whose first axis is the fastest in the user's arrays is left as it is.
TYPED_TEST(CloudOrder, KeepsBothUsualOrdersOfALattice) {
  constexpr int D = TypeParam::value;
  const scenes::Points<D> points = scenes::box<D>(scenes::extent<D>(7, 7, 7));
  scenes::Points<D> reversed = points;
  for (auto& p : reversed) p.reverseInPlace();
  std::vector<hmps::Index> all(points.size());
  std::iota(all.begin(), all.end(), hmps::Index{0});
  EXPECT_EQ(order_of<D>(points), all);
  EXPECT_EQ(order_of<D>(reversed), all);
}

TYPED_TEST(CloudOrder, IsEmptyWithoutParticles) { EXPECT_TRUE(order_of<TypeParam::value>({}).empty()); }

}  // namespace cloud_order_test
