// SPDX-License-Identifier: MIT
#include "hmps/lanes/detail/slots.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <type_traits>

namespace slots_test {

template <class K>
class Slots : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Slots, Scalars);

/// A number that no other place has; all are exact in float.
std::size_t mark(std::size_t component, std::size_t slot) { return 1000 * component + slot + 1; }

template <class Slots>
Slots marked(std::size_t components, std::size_t slots) {
  Slots all(slots);
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t s = 0; s < slots; ++s)
      all(c, s) = static_cast<std::remove_cvref_t<decltype(all(0, 0))>>(mark(c, s));
  return all;
}

// A run of lanes may hang over either end of a component.
TYPED_TEST(Slots, ArraysHaveAMarginOfZerosAtBothEnds) {
  constexpr auto width = static_cast<std::ptrdiff_t>(hmps::Lanes<TypeParam>::width);
  constexpr std::ptrdiff_t slots = 48;
  const auto arrays = marked<hmps::detail::SlotArrays<TypeParam, 3>>(3, slots);
  for (std::ptrdiff_t first = -width; first <= slots; ++first)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::ptrdiff_t l = 0; l < width; ++l) {
        const bool inside = first + l >= 0 && first + l < slots;
        const std::size_t expected = inside ? mark(c, static_cast<std::size_t>(first + l)) : 0;
        EXPECT_EQ(arrays.run(first)[c].lane[l], static_cast<TypeParam>(expected)) << c << ' ' << first << ' ' << l;
      }
  // Halves of two runs.
  for (std::ptrdiff_t first = -width; first <= slots; first += 5)
    for (std::ptrdiff_t second = -width; second <= slots; second += 3)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::ptrdiff_t l = 0; l < width; ++l) {
          const auto k = static_cast<std::size_t>(l);
          EXPECT_EQ(arrays.run(first, second)[c].lane[k], arrays.run(l < width / 2 ? first : second)[c].lane[k]);
        }
  EXPECT_GE(arrays.bytes(), 3 * slots * sizeof(TypeParam));
  EXPECT_EQ((hmps::detail::SlotArrays<TypeParam, 0>(slots).bytes()), 0u);
}

// Numbers that were stored one by one are read a block at a time, and the other way round.
TYPED_TEST(Slots, ReturnStoredValues) {
  constexpr auto width = static_cast<std::size_t>(hmps::Lanes<TypeParam>::width);
  constexpr std::size_t slots = 5 * width;
  auto arrays = marked<hmps::detail::SlotArrays<TypeParam, 10>>(10, slots);
  for (std::size_t c = 0; c < 10; ++c) {
    const auto second = arrays.lanes(c, width);
    for (std::size_t l = 0; l < width; ++l) EXPECT_EQ(second.lane[l], static_cast<TypeParam>(mark(c, width + l)));
    arrays.store(c, 2 * width, second);
  }
  for (std::size_t c = 0; c < 10; ++c)
    for (std::size_t s = 0; s < slots; ++s)
      EXPECT_EQ(arrays(c, s), static_cast<TypeParam>(mark(c, s / width == 2 ? s - width : s)));
}

TYPED_TEST(Slots, NumbersThatNoForceNeedsTakeNoMemory) {
  EXPECT_EQ((hmps::detail::SlotArrays<TypeParam, 0>(40).bytes()), 0u);
}

}  // namespace slots_test
