// SPDX-License-Identifier: MIT
#include "hmps/lanes/blocks.hpp"
#include "hmps/bonds/shape_tensor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace blocks_test {

template <class K>
class BlocksOf : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BlocksOf, Scalars);

/// Blocks in an order that the test chooses.
template <class K>
struct Ordered : hmps::Blocks<K, 2> {
  Ordered(const std::vector<std::array<float, 2>>& points, const std::vector<hmps::Index>& order)
      : hmps::Blocks<K, 2>(hmps::vectors(points), order) {
    hmps::ShapeTensor<2> shape;
    shape.add({1, 0}, 0.5);
    shape.add({0.5, 2}, 0.25);
    for (std::size_t i = 0; i < points.size(); ++i)
      this->set_shape(i, shape.inverse(i), shape.asymmetry, shape.A.trace());
    this->set_standard(shape.weight, shape.A.trace() / shape.weight);
  }
};

TYPED_TEST(BlocksOf, KeepTheReferenceConfigurationInTheOrderOfTheSweep) {
  using K = TypeParam;
  constexpr std::size_t width = hmps::Blocks<K, 2>::width;
  const std::size_t n = 2 * width + 3;
  std::vector<std::array<float, 2>> points(n);
  std::vector<hmps::Index> order(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = {static_cast<float>(i), -static_cast<float>(i)};
    // The first block holds the last particles in a row, the second jumps.
    order[i] = static_cast<hmps::Index>(i < width ? n - width + i : i - width);
  }
  std::swap(order[width + 1], order[width + 2]);
  const Ordered<K> blocks(points, order);
  EXPECT_EQ(blocks.size(), n);
  EXPECT_EQ(blocks.block_count(), 3u);
  EXPECT_EQ(blocks.slot_count(), 3 * width);
  for (std::size_t s = 0; s < 3 * width; ++s) {
    if (s >= n) {
      EXPECT_EQ(blocks.particle(s), Ordered<K>::none);
      continue;
    }
    EXPECT_EQ(blocks.particle(s), order[s]);
    EXPECT_EQ(blocks.slot(order[s]), s);
  }
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(blocks.reference(i), (hmps::Vector<double, 2>(points[i][0], points[i][1])));
    EXPECT_EQ(blocks.reference(i, 1), points[i][1]);
  }
  EXPECT_TRUE(blocks.consecutive(0));
  EXPECT_FALSE(blocks.consecutive(1));
  EXPECT_FALSE(blocks.consecutive(2)) << "the last block is not full";
  EXPECT_GT(blocks.bytes(), n * 2 * sizeof(double));
}

/// Blocks in which the particles with `other(i)` have a different neighbourhood.
template <class K>
struct Shared : hmps::Blocks<K, 2> {
  template <class Other>
  Shared(const std::vector<std::array<float, 2>>& points, const std::vector<hmps::Index>& order, Other&& other)
      : hmps::Blocks<K, 2>(hmps::vectors(points), order) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      hmps::ShapeTensor<2> shape;
      shape.add({1, 0}, 0.5);
      shape.add({0.5, 2}, other(i) ? 0.5 : 0.25);
      this->set_shape(i, shape.inverse(i), shape.asymmetry, shape.A.trace());
    }
  }
  using hmps::Blocks<K, 2>::share_shapes;
};

TYPED_TEST(BlocksOf, ShareTheShapesOfBlocksThatAreAlike) {
  using K = TypeParam;
  constexpr std::size_t width = hmps::Blocks<K, 2>::width;
  const std::size_t n = 6 * width - 1;
  const std::vector<std::array<float, 2>> points(n);
  std::vector<hmps::Index> order(n);
  std::iota(order.begin(), order.end(), hmps::Index{0});
  // Blocks 0 and 2 are alike, 3 and 4 too; block 1 is mixed and the last not full.
  const auto other = [&](std::size_t i) { return i == width + 3 || (i >= 3 * width && i < 5 * width); };
  const Shared<K> apart(points, order, other);
  Shared<K> shared = apart;
  shared.share_shapes();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(shared.shape_inverse(i), apart.shape_inverse(i));
    EXPECT_EQ(shared.shape_trace(i), apart.shape_trace(i));
  }
  for (std::size_t b = 0; b < 6; ++b)
    for (std::size_t l = 0; l < width; ++l) {
      EXPECT_EQ(shared.shape_inverse_lanes(b)(0, 1).lane[l], apart.shape_inverse_lanes(b)(0, 1).lane[l]);
      EXPECT_EQ(shared.asymmetry_lanes(b, 1).lane[l], apart.asymmetry_lanes(b, 1).lane[l]);
      EXPECT_EQ(shared.inverse_trace_lanes(b).lane[l], apart.inverse_trace_lanes(b).lane[l]);
    }
  EXPECT_EQ(apart.bytes() - shared.bytes(), 2 * 6 * width * sizeof(K)) << "two blocks of 3 + 2 + 1 numbers";
}

// A = 0.5 (1, 0)(1, 0)^T + 0.25 (0.5, 2)(0.5, 2)^T, by hand.
TYPED_TEST(BlocksOf, KeepTheShapeTensor) {
  using K = TypeParam;
  const Ordered<K> blocks({{0, 0}, {1, 1}}, {0, 1});
  const K a = K(0.5) + K(0.0625), b = K(0.25), d = K(1), det = a * d - b * b;
  const auto inverse = blocks.shape_inverse(1);
  EXPECT_NEAR(inverse(0, 0), d / det, 4 * std::numeric_limits<K>::epsilon() * d / det);
  EXPECT_NEAR(inverse(0, 1), -b / det, 4 * std::numeric_limits<K>::epsilon() * d / det);
  EXPECT_EQ(inverse(0, 1), inverse(1, 0));
  EXPECT_NEAR(inverse(1, 1), a / det, 4 * std::numeric_limits<K>::epsilon() * d / det);
  EXPECT_NEAR(blocks.shape_trace(0), a + d, 4 * std::numeric_limits<K>::epsilon() * (a + d));
  EXPECT_DOUBLE_EQ(blocks.standard_density(), 0.75);
  EXPECT_DOUBLE_EQ(blocks.standard_lambda(), 1.5625 / 0.75);

  const auto lanes = blocks.shape_inverse_lanes(0);
  EXPECT_EQ(lanes(1, 0).lane[1], inverse(1, 0));
  EXPECT_EQ(lanes(1, 1).lane[0], inverse(1, 1));
  EXPECT_EQ(lanes(0, 0).lane[2], K(0)) << "an empty slot has no shape";
  EXPECT_EQ(blocks.asymmetry_lanes(0, 0).lane[1], K(0.625));
  EXPECT_EQ(blocks.asymmetry_lanes(0, 1).lane[1], K(0.5));
  EXPECT_NEAR(blocks.inverse_trace_lanes(0).lane[0], K(1) / K(1.5625), 4 * std::numeric_limits<K>::epsilon());
}

TYPED_TEST(BlocksOf, RefuseAParticleThatDoesNotExist) {
  const Ordered<TypeParam> blocks({{0, 0}, {1, 0}}, {1, 0});
  EXPECT_EQ(blocks.slot(1), 0u);
  EXPECT_THROW((void)blocks.slot(2), hmps::InputError) << "beyond the last particle, though there is such a slot";
  EXPECT_THROW((void)blocks.reference(2), hmps::InputError);
  EXPECT_THROW((void)blocks.shape_inverse(2), hmps::InputError);
  EXPECT_THROW((void)blocks.shape_trace(2), hmps::InputError);
}

}  // namespace blocks_test
