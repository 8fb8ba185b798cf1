// SPDX-License-Identifier: MIT
#include "hmps/lanes/detail/window.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hmps/lanes/detail/aligned_allocator.hpp"

namespace window_test {

template <class T>
class Window : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Window, Scalars);

// Every place of both blocks, in every lane, repeated places and places in falling order.
TYPED_TEST(Window, LanesTakeTheNumbersAtTheirPlaces) {
  using Places = hmps::detail::WindowPlaces<TypeParam>;
  constexpr std::size_t width = Places::width;
  std::vector<TypeParam, hmps::detail::AlignedAllocator<TypeParam>> numbers(3 * width);
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<TypeParam>(k + 1);
  for (std::size_t first : {std::size_t{0}, width})
    for (std::size_t start = 0; start < 2 * width; ++start)
      for (std::size_t step : {std::size_t{0}, std::size_t{1}, std::size_t{5}, 2 * width - 1}) {
        typename Places::Stored stored;
        for (std::size_t l = 0; l < width; ++l) stored[l] = static_cast<std::uint8_t>((start + l * step) % (2 * width));
        const hmps::Lanes<TypeParam> picked = Places(stored).pick(numbers.data() + first);
        for (std::size_t l = 0; l < width; ++l) EXPECT_EQ(picked.lane[l], numbers[first + stored[l]]) << start << step;
      }
}

TYPED_TEST(Window, MemoryIsAlignedAsLanesAre) {
  for (const std::size_t n : {std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
    const std::vector<TypeParam, hmps::detail::AlignedAllocator<TypeParam>> numbers(n);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % alignof(hmps::Lanes<TypeParam>), 0u);
  }
}

}  // namespace window_test
