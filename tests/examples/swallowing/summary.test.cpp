// SPDX-License-Identifier: MIT
#include "output/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <hmps/core/error.hpp>
#include <nlohmann/json.hpp>

#include "../../reference/temporary_folder.hpp"
#include "../common/files.hpp"

namespace summary_test {

using hmps_test::TemporaryFolder;
using swallowing::DetF;
using swallowing::Summary;

TEST(Summary, HoldsTheFieldsThatOtherProgramsRead) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "summary.json";
  Summary s;
  s.case_name = "X1";
  s.spacing = 2.4e-3;
  s.time_step = 2e-5;
  s.nearest_to_limit = swallowing::NearestToLimit{0.7, 3e-5, 1.62, 17, "tongue"};
  s.contact_share_per_tenth = {0.1, 0.4};
  s.steps = 102500;
  s.particles_free = 6300;
  s.particles_control = 3100;
  s.fold_time = 1.652;
  s.tip_angle_min = -21.5;
  s.det_f = DetF{0.9998, 0.987, 0.91, 1.07};
  s.max_penetration = 0.21;
  s.wall_seconds = 95;
  s.particle_steps_per_second = 1e7;
  s.contact_share = 0.3;
  s.settings = {{"spacing", "0.0024"}, {"region H", "yes"}};
  swallowing::write_summary(path, s);

  const auto json = nlohmann::json::parse(examples::read_file(path));
  EXPECT_EQ(json.at("case"), "X1");
  EXPECT_EQ(json.at("spacing"), 2.4e-3);
  EXPECT_EQ(json.at("time_step"), 2e-5);
  EXPECT_EQ(json.at("nearest_to_limit").at("share"), 0.7);
  EXPECT_EQ(json.at("nearest_to_limit").at("time"), 1.62);
  EXPECT_EQ(json.at("steps"), 102500);
  EXPECT_EQ(json.at("particles_free"), 6300);
  EXPECT_EQ(json.at("particles_control"), 3100);
  EXPECT_EQ(json.at("fold_time"), 1.652);
  EXPECT_TRUE(json.at("fold_time_base").is_null());
  EXPECT_EQ(json.at("tip_angle_min"), -21.5);
  EXPECT_EQ(json.at("det_f").at("mean"), 0.9998);
  EXPECT_EQ(json.at("det_f").at("share_within_0_98_1_02"), 0.987);
  EXPECT_EQ(json.at("det_f").at("min"), 0.91);
  EXPECT_EQ(json.at("det_f").at("max"), 1.07);
  EXPECT_EQ(json.at("max_penetration"), 0.21);
  EXPECT_EQ(json.at("wall_seconds"), 95);
  EXPECT_EQ(json.at("particle_steps_per_second"), 1e7);
  EXPECT_EQ(json.at("contact_share"), 0.3);

  const auto read = swallowing::read_summary(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->settings, s.settings);
  EXPECT_EQ(read->fold_time, s.fold_time);
  EXPECT_FALSE(read->fold_time_base);
  EXPECT_EQ(read->det_f->min, 0.91);
  EXPECT_EQ(read->steps, s.steps);
  EXPECT_EQ(read->nearest_to_limit->particle, 17U);
  EXPECT_EQ(read->nearest_to_limit->organ, "tongue");
  EXPECT_EQ(read->contact_share_per_tenth, s.contact_share_per_tenth);
}

TEST(Summary, WritesNonFiniteValuesAsNull) {
  const TemporaryFolder folder;
  Summary s;
  s.tip_angle_min = std::nan("");
  s.failure = "particle 3 of the tongue is inverted";
  swallowing::write_summary(folder.path() / "s.json", s);
  const auto read = swallowing::read_summary(folder.path() / "s.json");
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::isnan(read->tip_angle_min));
  EXPECT_FALSE(read->det_f);
  EXPECT_EQ(read->failure, s.failure);
}

TEST(Summary, MissingFilesAreEmptyAndInvalidFilesAreErrors) {
  const TemporaryFolder folder;
  EXPECT_FALSE(swallowing::read_summary(folder.path() / "none.json"));
  examples::write_atomically(folder.path() / "foreign.json", "{\"a\": 1}");
  EXPECT_THROW((void)swallowing::read_summary(folder.path() / "foreign.json"), hmps::InputError);
  examples::write_atomically(folder.path() / "torn.json", "{\"case\": ");
  EXPECT_THROW((void)swallowing::read_summary(folder.path() / "torn.json"), hmps::InputError);
}

}  // namespace summary_test
