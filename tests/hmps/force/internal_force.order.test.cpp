// SPDX-License-Identifier: MIT
// The order in which an executor runs the blocks changes no bit (threads: tests of the executors).
#include <gtest/gtest.h>

#include <numeric>

#include "../executors/same_bits.hpp"

namespace {

struct Backwards {
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    for (std::size_t i = n; i-- > 0;) body(i);
  }
};
struct Shuffled {
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    scenes::Random(1).shuffle(order);
    for (std::size_t i : order) body(i);
  }
};

template <class B>
class Order : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::BondList<double, 3>>;
TYPED_TEST_SUITE(Order, Models);

TYPED_TEST(Order, OfTheBlocksChangesNoBit) {
  const same_bits::Probe<TypeParam> probe;
  const auto expected = probe(hmps::Serial{});
  EXPECT_TRUE(same_bits::identical(probe(Backwards{}), expected));
  EXPECT_TRUE(same_bits::identical(probe(Shuffled{}), expected));
  const auto lambda = [](std::size_t n, auto&& body) {
    for (std::size_t i = 0; i < n; ++i) body(n - 1 - i);
  };
  EXPECT_TRUE(same_bits::identical(probe(lambda), expected));
}

}  // namespace
