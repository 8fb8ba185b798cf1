// SPDX-License-Identifier: MIT
#include "output/lumen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lumen_test {

using swallowing::Organ;

/// A tongue of two particles and a wall of four, about a channel; a millimetre of spacing.
struct Throat {
  swallowing::Scene scene;
  std::vector<Eigen::Vector3d> x;

  Throat() {
    scene.spacing = 1e-3;
    const auto add = [&](double a, double b, double c) {
      x.emplace_back(1e-3 * a, 1e-3 * b, 1e-3 * c);
      return static_cast<hmps::Index>(x.size() - 1);
    };
    swallowing::ContactPair pair{};
    pair.first = Organ::tongue;
    pair.second = Organ::pharynx;
    pair.first_slaves = {add(-2, 1, 60), add(9, 12, 60)};  // the second lies beside the midsagittal plane
    pair.second_slaves = {add(6, 1, 60), add(10, 12, 60), add(0.5, -7, 64.5), add(-0.5, 6, 65.5), add(0, 3, 50)};
    scene.contacts.push_back(pair);
  }
};

TEST(Lumen, IsMeasuredBetweenSurfaces) {
  const Throat throat;
  EXPECT_NEAR(swallowing::tongue_to_wall(throat.scene, throat.x), 7e-3, 1e-12);
  EXPECT_NEAR(swallowing::channel_width(throat.scene, throat.x, 65e-3), 12e-3, 1e-12);
}

TEST(Lumen, IsInfiniteWhereThereAreNoWalls) {
  Throat throat;
  EXPECT_TRUE(std::isinf(swallowing::channel_width(throat.scene, throat.x, 20e-3)));
  throat.scene.contacts.clear();
  EXPECT_TRUE(std::isinf(swallowing::tongue_to_wall(throat.scene, throat.x)));
}

}  // namespace lumen_test
