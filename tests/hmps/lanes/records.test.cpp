// SPDX-License-Identifier: MIT
#include "hmps/lanes/records.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace {

template <class T>
class Records : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Records, Scalars);

/// Records of N numbers, no two of which are the same, end where their memory does.
template <class T, std::size_t N>
void every_lane_has_the_record_at_its_place() {
  constexpr std::size_t width = static_cast<std::size_t>(hmps::Lanes<T>::width), pitch = hmps::record_pitch<T>(N);
  static_assert(pitch >= N && pitch < N + 16 / sizeof(T));
  constexpr std::size_t count = 23;
  std::vector<T> memory(count * pitch);
  for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = static_cast<T>(k);
  hmps::Index places[width];
  for (std::size_t l = 0; l < width; ++l) places[l] = static_cast<hmps::Index>(7 * l % count);
  places[1] = count - 1;
  places[2] = places[width - 1] = 0;
  const auto found = hmps::gather_records<N>(memory.data(), places);
  for (std::size_t c = 0; c < N; ++c)
    for (std::size_t l = 0; l < width; ++l)
      EXPECT_EQ(found[c].lane[l], memory[places[l] * pitch + c]) << N << ' ' << c << ' ' << l;
}
TYPED_TEST(Records, EveryLaneHasTheRecordAtItsPlace) {
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    (every_lane_has_the_record_at_its_place<TypeParam, n + 1>(), ...);
  }
  (std::make_index_sequence<10>{});
}

}  // namespace
