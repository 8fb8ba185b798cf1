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

/// A room between a tongue and walls, ten particles deep; particles a millimetre apart.
swallowing::Scene room(std::vector<Eigen::Vector3d>& x, double side) {
  swallowing::Scene scene;
  scene.spacing = 1e-3;
  const auto add = [&](double a, double b, Organ organ) {
    x.emplace_back(1e-3 * a, 1e-3 * b, 65e-3);
    scene.organ.push_back(organ);
  };
  for (int k = -static_cast<int>(side); k <= side; ++k) {
    add(0, k, Organ::tongue);
    add(-12, k, Organ::tongue);  // the front of its shell
    add(11, k, Organ::pharynx);
  }
  for (int k = -12; k < 11; ++k)
    for (const double b : {-side, side}) add(k, b, k < 1 ? Organ::tongue : Organ::pharynx);
  return scene;
}

TEST(Lumen, AreaIsThatBetweenTongueAndWalls) {
  for (const double side : {11., 8., 2.}) {
    std::vector<Eigen::Vector3d> x;
    const swallowing::Scene scene = room(x, side);
    const double area = 10 * (2 * side - 1);  // between the balls, in mm2
    EXPECT_NEAR(swallowing::open_area(scene, x, 65e-3) * 1e6, area, 0.03 * area) << side;
    EXPECT_EQ(swallowing::open_area(scene, x, 60e-3), 0) << "there is nothing at this height";
  }
}

TEST(Lumen, AreaOfAClosedChannelIsZero) {
  std::vector<Eigen::Vector3d> x;
  swallowing::Scene scene = room(x, 11);
  for (int a = 0; a <= 11; ++a)
    for (int b = -11; b <= 11; ++b) {
      x.emplace_back(1e-3 * a, 1e-3 * b, 65e-3);
      scene.organ.push_back(Organ::tongue);
    }
  EXPECT_EQ(swallowing::open_area(scene, x, 65e-3), 0);
}

TEST(Lumen, IsInfiniteWhereThereAreNoWalls) {
  Throat throat;
  EXPECT_TRUE(std::isinf(swallowing::channel_width(throat.scene, throat.x, 20e-3)));
  throat.scene.contacts.clear();
  EXPECT_TRUE(std::isinf(swallowing::tongue_to_wall(throat.scene, throat.x)));
}

}  // namespace lumen_test
