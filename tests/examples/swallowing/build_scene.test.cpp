// SPDX-License-Identifier: MIT
#include "scene/build_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <hmps/contact/contact.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "scene/motion.hpp"

namespace build_scene_test {

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
    const swallowing::Motion motion(SWALLOWING_DATA);
    double plate = 1e9, wall = 0;
    for (std::size_t i = 0; i < scene.reference.size(); ++i) {
      Point x = 1e3 * scene.reference[i];
      if (i >= scene.elastic_count)  // The plates reach their place in the first half second.
        x = 1e3 * motion(scene.regions[static_cast<std::size_t>(scene.region[i])], 0.5)(scene.reference[i]);
      if (x[2] < 45 || x[2] > 65 || std::abs(x[0] + 5) > 3) continue;
      if (i >= scene.elastic_count) plate = std::min(plate, std::abs(x[1]));
      if (i < scene.elastic_count && scene.organ[i] == Organ::pharynx) wall = std::max(wall, std::abs(x[1]));
    }
    // The columns of the lattice beside the midsagittal plane leave the wall itself at up to half a spacing.
    EXPECT_GT(plate - wall - 1e3 * spacing, 0.8 - 0.5e3 * spacing) << spacing;
    EXPECT_LT(plate - wall - 1e3 * spacing, 0.8 + 0.5e3 * spacing) << spacing;
  }
}

// At 2.4 mm the plates once stood 0.48 mm in the wall, which was flung off at 1 m/s in the first millisecond.
TEST(BuildScene, StartsThePlatesClearOfTheWall) {
  for (const double spacing : {2.4e-3, 1.8e-3}) {
    const Scene scene = make_scene({.spacing = spacing, .data = SWALLOWING_DATA});
    std::vector<Eigen::Vector3d> places(scene.reference.size());
    std::vector<Eigen::Matrix3d> F(places.size(), Eigen::Matrix3d::Identity());
    (*scene.skin)(hmps::vectors(scene.reference), hmps::matrices(F), hmps::vectors(places));
    hmps::MetaballContact<double, 3, hmps::SmoothMetaball, hmps::CorrectedFriction> contact(
        {.spacing = spacing, .density = 1000, .stiffness = hmps::PenaltyStiffness::fixed(2e8 / spacing)});
    for (const auto& pair : scene.contacts) {
      const std::string first(name(pair.first)), second(name(pair.second));
      contact.add_pair(
          contact.add_organ({.name = first, .slaves = pair.first_slaves, .masters = pair.first_masters}),
          contact.add_organ({.name = second, .slaves = pair.second_slaves, .masters = pair.second_masters}));
    }
    for (const auto& overlap : contact.overlaps(hmps::vectors(places), hmps::matrices(F)))
      ADD_FAILURE() << spacing << ": " << overlap.slaves << " in " << overlap.masters << ", " << overlap.depth << " m";
  }
}

/// How many particles of region `name` lie to the left and to the right of the midsagittal plane.
[[nodiscard]] std::array<std::size_t, 2> on_the_sides(const Scene& scene, std::string_view name) {
  std::array<std::size_t, 2> count{};
  const auto particles = scene.particles_of_regions();
  for (std::size_t r = 0; r < particles.size(); ++r)
    if (scene.regions[r].name == name)
      for (const hmps::Index i : particles[r]) ++count[scene.reference[i][1] > 0];
  return count;
}

// Region A once lay between two columns of the lattice: it was empty at 2.4 and at 1.8 mm.
TEST(BuildScene, HoldsTheOutermostColumnOfTheTonguesSidesOfAnyLattice) {
  const swallowing::Anatomy anatomy;
  for (const double l0 : {2.4, 2.0, 1.8, 1.2, 1.0})
    for (double angle = 64; angle < 151; angle += 2) {
      const auto row = anatomy.tongue.profile(angle);
      const double outermost = std::floor(swallowing::Tongue::rim(row) / l0 - 0.5) * l0 + l0 / 2;
      const double a = angle * std::numbers::pi / 180, radius = row[1] - row[3] - 4.4;
      const Point x = anatomy.tongue.centre + Point(radius * std::cos(a), outermost, radius * std::sin(a));
      if (anatomy.tongue(x) > 0) continue;  // The lattice all but misses the rim by a tenth of a millimetre.
      const auto region = region_at(anatomy, Organ::tongue, x, swallowing::Model::X);
      ASSERT_GE(region, 0) << l0 << " mm, " << angle << " degrees, y = " << outermost;
      EXPECT_EQ(body_regions(swallowing::Model::X)[static_cast<std::size_t>(region)].name, "A") << l0 << ' ' << angle;
    }
  for (const double spacing : {2.4e-3, 1.8e-3}) {
    const auto [left, right] = on_the_sides(make_scene({.spacing = spacing, .data = SWALLOWING_DATA}), "A");
    EXPECT_GE(std::min(left, right), 20);  // as many millimetres of rim as there are from the molars to the front
  }
}

// The rise is that of the drawn surfaces: the least at which they meet is 2.74 mm.
TEST(BuildScene, LiftsTheTonguesRimToThePalate) {
  const swallowing::Anatomy anatomy;
  const swallowing::Motion motion(SWALLOWING_DATA);
  const auto pose = motion({"A", swallowing::Region::moved, 10}, 0.5);
  double gap = 1e9;
  for (double angle = 74; angle <= 106; ++angle) {
    const auto row = anatomy.tongue.profile(angle);
    const double a = angle * std::numbers::pi / 180, radius = row[1] - row[3] - 4.5;
    const Point rim =
        anatomy.tongue.centre + Point(radius * std::cos(a), swallowing::Tongue::rim(row), radius * std::sin(a));
    gap = std::min(gap, anatomy.hard_palate(1e3 * pose(1e-3 * rim)));
  }
  EXPECT_GT(gap, 0);  // mm; two regions that are held overlap for ever
  EXPECT_LT(gap, 0.1);
}

TEST(BuildScene, RefusesAControlRegionWithoutParticles) {
  Scene scene = make_scene({.spacing = 2.4e-3, .data = SWALLOWING_DATA});
  const auto a = std::find_if(scene.regions.begin(), scene.regions.end(), [](const auto& r) { return r.name == "A"; });
  for (int& region : scene.region)
    if (region == a - scene.regions.begin()) region = -1;
  try {
    require_particles(scene, swallowing::Model::X);
    FAIL() << "an empty region was accepted";
  } catch (const hmps::InputError& error) {
    for (const char* part : {"region A", "model X", "2.4 mm", "--spacing", "--lattice-shift"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

// At 2.4 mm a column stands on the edge of the regions B. Without fused multiply-add it was in them on one side only.
TEST(BuildScene, GivesTheRegionsOfTheTongueTheSameParticlesOnBothSides) {
  const Scene scene = make_scene({.spacing = 2.4e-3, .data = SWALLOWING_DATA});
  for (const char* region : {"B0", "B1", "B2", "B3", "B4", "B5", "B6", "B7", "A"}) {
    const auto [left, right] = on_the_sides(scene, region);
    EXPECT_EQ(left, right) << region;
  }
}

// Model Y has no region F, and that is no error.
TEST(BuildScene, GivesEveryRegionOfBothModelsParticles) {
  for (const auto model : {swallowing::Model::X, swallowing::Model::Y}) {
    const Scene scene = make_scene({.spacing = 2.4e-3, .model = model, .data = SWALLOWING_DATA});
    for (const auto& particles : scene.particles_of_regions()) EXPECT_FALSE(particles.empty());
    EXPECT_EQ(std::any_of(scene.regions.begin(), scene.regions.end(), [](const auto& r) { return r.name == "F"; }),
              model == swallowing::Model::X);
  }
}

// The surface that particles are fitted to cuts corners between organs.
TEST(BuildScene, FittedParticlesInNoOrganAreOfThatOfTheNearest) {
  const swallowing::Anatomy anatomy;
  const Scene scene = make_scene({.spacing = 2.4e-3, .data = SWALLOWING_DATA});
  const auto place_of = [&](Organ organ) {
    const auto at = std::find(scene.organ.begin(), scene.organ.end(), organ) - scene.organ.begin();
    return scene.reference[static_cast<std::size_t>(at)];
  };
  const Point tongue = place_of(Organ::tongue), pharynx = place_of(Organ::pharynx), off(0, 1, 0);  // a metre
  const auto organ = swallowing::detail::organs_of(anatomy, {off, pharynx, tongue});
  const bool nearer = (pharynx - off).norm() < (tongue - off).norm();
  EXPECT_EQ(organ, (std::vector{nearer ? Organ::pharynx : Organ::tongue, Organ::pharynx, Organ::tongue}));
}

}  // namespace build_scene_test
