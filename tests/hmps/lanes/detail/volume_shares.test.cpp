// SPDX-License-Identifier: MIT
#include "hmps/lanes/detail/volume_shares.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "../../../reference/message_of.hpp"

namespace volume_shares_test {

using hmps_test::message_of;

[[nodiscard]] std::vector<double> shares(const std::vector<double>& volumes, std::size_t size, double l0) {
  return hmps::detail::volume_shares<3>(hmps::scalars(volumes), size, l0);
}

TEST(VolumeShares, AreVolumesOverTheCubeOfTheSpacing) {
  EXPECT_EQ(shares({8, 4, 16}, 3, 2), (std::vector<double>{1, 0.5, 2}));
  EXPECT_TRUE(shares({}, 0, 2).empty());
}

TEST(VolumeShares, RefusesBadVolumes) {
  const auto refused = [](const std::vector<double>& volumes, const char* text) {
    EXPECT_NE(message_of([&] { (void)shares(volumes, 3, 2); }).find(text), std::string::npos)
        << message_of([&] { (void)shares(volumes, 3, 2); });
  };
  refused({8, 8}, "volumes");
  refused({8, 0, 8}, "the volume of particle 1 is 0 m3");
  refused({8, 8, std::numeric_limits<double>::infinity()}, "the volume of particle 2 is inf m3");
  refused({8e9, 8e9, 8e9}, "the cube of the spacing of 2 m");
  refused({0.8, 0.8, 0.8}, "the cube of the spacing of 2 m");
  EXPECT_NE(message_of([&] {
              std::vector<double> one_of_many(100, 8);
              one_of_many[7] = 65 * 8;
              (void)shares(one_of_many, 100, 2);
            }).find("the volume of particle 7 is 520 m3"),
            std::string::npos);
}

TEST(VolumeShares, AreOneWithoutVolumes) {
  struct Plain {
    using Scalar = double;
  };
  EXPECT_EQ(hmps::detail::volume_share(Plain{}, 3), 1);
  EXPECT_EQ(hmps::detail::volume_share_lanes(Plain{}, 3).lane[0], 1);
  const hmps::detail::VolumeShares<double> none;
  EXPECT_EQ(none.of(5), 1);
  EXPECT_EQ(none.lanes(0).lane[1], 1);
  EXPECT_EQ(none.bytes(), 0U);
}

}  // namespace volume_shares_test
