// SPDX-License-Identifier: MIT
#include "hmps/lanes/slots.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <type_traits>

namespace {

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
  const auto arrays = marked<hmps::SlotArrays<TypeParam, 3>>(3, slots);
  for (std::ptrdiff_t first = -width; first <= slots; ++first)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::ptrdiff_t l = 0; l < width; ++l) {
        const bool inside = first + l >= 0 && first + l < slots;
        const std::size_t expected = inside ? mark(c, static_cast<std::size_t>(first + l)) : 0;
        EXPECT_EQ(arrays.run(first)[c].lane[l], static_cast<TypeParam>(expected)) << c << ' ' << first << ' ' << l;
      }
  EXPECT_GE(arrays.bytes(), 3 * slots * sizeof(TypeParam));
  EXPECT_EQ((hmps::SlotArrays<TypeParam, 0>(slots).bytes()), 0u);
}

/// What was put in one by one comes out a block at a time and for neighbours anywhere, and the other way round.
template <class TypeParam, std::size_t N>
void records_hand_out_what_was_kept() {
  constexpr auto width = static_cast<std::size_t>(hmps::Lanes<TypeParam>::width);
  constexpr std::size_t slots = 5 * width;
  auto records = marked<hmps::SlotRecords<TypeParam, N>>(N, slots);
  hmps::Index places[width];
  for (std::size_t l = 0; l < width; ++l) places[l] = static_cast<hmps::Index>((37 * l + 11) % slots);
  const auto found = records.gather(places);
  for (std::size_t c = 0; c < N; ++c) {
    const auto second = records.lanes(c, width);
    for (std::size_t l = 0; l < width; ++l) {
      EXPECT_EQ(found[c].lane[l], static_cast<TypeParam>(mark(c, places[l])));
      EXPECT_EQ(second.lane[l], static_cast<TypeParam>(mark(c, width + l)));
    }
    records.keep(c, 2 * width, second);
  }
  for (std::size_t c = 0; c < N; ++c)
    for (std::size_t s = 0; s < slots; ++s)
      EXPECT_EQ(records(c, s), static_cast<TypeParam>(mark(c, s / width == 2 ? s - width : s)));
  EXPECT_GE(records.bytes(), N * slots * sizeof(TypeParam));
}
TYPED_TEST(Slots, RecordsHandOutWhatWasKept) {
  records_hand_out_what_was_kept<TypeParam, 1>();
  records_hand_out_what_was_kept<TypeParam, 3>();
  records_hand_out_what_was_kept<TypeParam, 10>();
}

TYPED_TEST(Slots, NumbersThatNoForceNeedsTakeNoMemory) {
  EXPECT_EQ((hmps::SlotRecords<TypeParam, 0>(40).bytes()), 0u);
  EXPECT_EQ((hmps::SlotArrays<TypeParam, 0>(40).bytes()), 0u);
}

}  // namespace
