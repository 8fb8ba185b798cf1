// SPDX-License-Identifier: MIT
#include "scene/build_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/motion.hpp"

namespace {

using swallowing::make_scene;
using swallowing::Organ;
using swallowing::Point;
using swallowing::Scene;

/// Where the particles of the scene stand in mm once the body has conformed, those without a region at their place.
class Conformed {
 public:
  Conformed(double spacing, double shift)
      : l0_(1e3 * spacing),
        motion_(SWALLOWING_DATA),
        scene_(make_scene({.spacing = spacing, .lattice_shift = shift, .data = SWALLOWING_DATA})) {}

  /// x of the inner surface of the posterior wall beside the tip of the epiglottis, as contact sees it.
  [[nodiscard]] double posterior_wall() const {
    std::vector<Eigen::Vector3d> places(scene_.reference.size());
    std::vector<Eigen::Matrix3d> F(places.size(), Eigen::Matrix3d::Identity());
    (*scene_.skin)(hmps::vectors(scene_.reference), hmps::matrices(F), hmps::vectors(places));
    double first = 1e9;
    for (std::size_t i = 0; i < scene_.elastic_count; ++i) {
      const Point x = 1e3 * scene_.reference[i];
      if (x[2] < 45 || x[2] > 65 || std::abs(x[1]) > 2 || x[0] < 0 || scene_.organ[i] != Organ::pharynx) continue;
      first = std::min(first, 1e3 * places[i][0]);
    }
    return first - l0_ / 2;
  }
  /// How far the surface of the leaf reaches along its upper end from where its midline is drawn to end.
  [[nodiscard]] double tip() const {
    const double angle = swallowing::Epiglottis::angle(0.8 * swallowing::Epiglottis::length);
    const Point along(std::cos(angle), 0, std::sin(angle));
    Point moved = Point::Zero();
    double reach = -1e9;
    for (std::size_t i = 0; i < scene_.elastic_count; ++i) {
      if (scene_.organ[i] != Organ::epiglottis) continue;
      const Point x = 1e3 * scene_.reference[i];
      if (scene_.region[i] >= 0) moved = 1e3 * conformed(i) - x;
      if (std::abs(x[1]) < 4) reach = std::max(reach, along.dot(x));
    }
    return reach + l0_ / 2 + along.dot(moved) - along.dot(swallowing::Epiglottis::midline(36));
  }

 private:
  [[nodiscard]] Point conformed(std::size_t i) const {
    const auto& region = scene_.regions[static_cast<std::size_t>(scene_.region[i])];
    // The track of the hyoid, which E and F take part in, begins after 0.5 s.
    return motion_(region, 0.5)(scene_.reference[i]);
  }
  double l0_;
  swallowing::Motion motion_;
  Scene scene_;
};

// Half a spacing of the lattice is 1.2 mm. Contact does not see it on the wall, and the tip has been moved by 0.5 s.
TEST(BuildScene, PutsTheWallAndTheTipWhereTheyAreDrawnWhereverTheLatticeIs) {
  for (const double spacing : {2.4e-3, 1.8e-3})
    for (const double shift : {0.0, 0.5}) {
      const Conformed body(spacing, shift);
      EXPECT_NEAR(body.posterior_wall(), 10.8, 0.1) << spacing << " shift " << shift;
      EXPECT_NEAR(body.tip(), 0, 0.02) << spacing << " shift " << shift;
    }
}

TEST(BuildScene, KeepsThePlatesAtOneDistanceFromTheWallWhateverTheSpacing) {
  for (const double spacing : {2.4e-3, 1.8e-3}) {
    const Scene scene = make_scene({.spacing = spacing, .data = SWALLOWING_DATA});
    double plate = 1e9, wall = 0;
    for (std::size_t i = 0; i < scene.reference.size(); ++i) {
      const Point x = 1e3 * scene.reference[i];
      if (x[2] < 45 || x[2] > 65 || std::abs(x[0] + 5) > 3) continue;
      if (i >= scene.elastic_count) plate = std::min(plate, std::abs(x[1]));
      if (i < scene.elastic_count && scene.organ[i] == Organ::pharynx) wall = std::max(wall, std::abs(x[1]));
    }
    // The columns of the lattice beside the midsagittal plane leave the wall itself at up to half a spacing.
    EXPECT_GT(plate - wall - 1e3 * spacing, 0.8 - 0.5e3 * spacing) << spacing;
    EXPECT_LT(plate - wall - 1e3 * spacing, 0.8 + 0.5e3 * spacing) << spacing;
  }
}

}  // namespace
