// SPDX-License-Identifier: MIT
#include "scene/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "../../reference/message_of.hpp"
#include "scene/build_scene.hpp"

namespace motion_test {

using hmps_test::message_of;

/// A folder with constrictors.csv alone, of two levels.
std::filesystem::path folder_with(const std::string& upper) {
  const auto folder =
      std::filesystem::path(::testing::TempDir()) / ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "constrictors.csv") << "z,angle,start,duration,further,later,lasting,release,end,opened\n"
                                                "10,0,1.6,0.1,20,1.7,0.1,1.85,2,0.2\n"
                                             << upper << '\n';
  return folder;
}

TEST(Constrictors, TurnInTwoStagesAndOpenAgain) {
  const auto plates = swallowing::read_constrictors(folder_with("30,28,1.5,0.1,0,1.7,0.1,1.85,2,0.2"));
  EXPECT_EQ(plates.angle(10, 1.7), 0);
  EXPECT_NEAR(plates.angle(10, 1.75), 10, 1e-9);
  EXPECT_NEAR(plates.angle(10, 1.82), 20, 1e-9);
  EXPECT_NEAR(plates.angle(10, 2.0), 4, 1e-9);
  EXPECT_NEAR(plates.angle(30, 1.6), 28, 1e-9);
  EXPECT_NEAR(plates.angle(30, 1.82), 28, 1e-9);
  EXPECT_NEAR(plates.angle(20, 1.82), 24, 1e-9);  // half way between the levels
}

TEST(Constrictors, RejectStagesThatOutlastTheRelease) {
  for (const char* row : {"30,28,1.5,0.4,0,1.7,0.1,1.85,2,0.2", "30,28,1.5,0.1,5,1.8,0.1,1.85,2,0.2",
                          "30,28,1.5,0.1,0,1.7,0,1.85,2,0.2", "5,28,1.5,0.1,0,1.7,0.1,1.85,2,0.2"}) {
    const std::string text = message_of([&] { (void)swallowing::read_constrictors(folder_with(row)); });
    EXPECT_NE(text.find("constrictors.csv line 3: a level needs"), std::string::npos) << text;
  }
}

/// Both the plates and the cricoid, region C, are prescribed, so that the wall between them would be crushed.
TEST(Constrictors, LeaveRoomForTheWallBesideTheCricoid) {
  const swallowing::Motion motion(SWALLOWING_DATA);
  const auto scene = swallowing::make_scene({.spacing = 2.4e-3, .data = SWALLOWING_DATA});
  const auto particles = scene.particles_of_regions();
  for (const double t : {1.6, 1.7, 1.8, 1.84, 1.86, 1.88, 1.95}) {
    std::vector<Eigen::Vector3d> cricoid;
    for (std::size_t r = 0; r < particles.size(); ++r)
      for (const hmps::Index i : particles[r])
        if (scene.regions[r].name == "C") cricoid.push_back(motion(scene.regions[r], t)(scene.reference[i]));
    double least = 1;
    for (std::size_t r = 0; r < particles.size(); ++r)
      for (const hmps::Index i : particles[r])
        if (scene.regions[r].kind == swallowing::Region::door) {
          const Eigen::Vector3d plate = motion(scene.regions[r], t)(scene.reference[i]);
          for (const Eigen::Vector3d& x : cricoid) least = std::min(least, (plate - x).norm());
        }
    EXPECT_GT(least - scene.spacing, 4.6e-3) << t;  // the wall is 4.8 mm thick
  }
}

/// The fold is to be the work of the walls: no region turns the leaf beyond the horizontal, and the middle and the
/// inferior constrictor wait until the leaf has passed.
TEST(Constrictors, LeaveTheFoldToTheWalls) {
  const swallowing::Motion motion(SWALLOWING_DATA);
  const auto plates = swallowing::read_constrictors(SWALLOWING_DATA);
  swallowing::Region middle{"F", swallowing::Region::moved, 41};
  for (int ms = 0; ms <= 2050; ++ms) {
    const double t = 1e-3 * ms;
    if (t < 1.7) {
      EXPECT_EQ(plates.angle(30, t), 0) << t;
    }
    const auto turned = motion(middle, t).rotation;
    const double turn = std::atan2(turned(0, 2), turned(0, 0)) * 180 / std::numbers::pi;
    EXPECT_LT(turn, 65.6) << t;  // the line from the middle to the tip is so much above the horizontal at rest
  }
}

}  // namespace motion_test
