// SPDX-License-Identifier: MIT
#include "output/fitted_file.hpp"

#include <gtest/gtest.h>

#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"

namespace fitted_file_test {

using hmps::InputError;
using hmps_test::message_of;
using hmps_test::TemporaryFolder;
using swallowing::FittedOrgans;
using swallowing::Point;

constexpr double spacing = 2.4e-3;

FittedOrgans example() {
  FittedOrgans fitted;
  fitted.particles.positions = {Point(0.1, 0.2, 0.3), Point(-0.1, 1e-300, 1.0 / 3)};
  fitted.particles.volumes = {1e-8, 2e-8};
  fitted.particles.layers = {0, 3};
  fitted.particles.layer_spacings = {2.4e-3, 1.6e-3};
  fitted.particles.iterations = 200;
  fitted.particles.largest_deviation = 1e-5;
  fitted.depth = {0.5, 1.5};
  return fitted;
}

TEST(FittedFile, RestoresEveryBit) {
  const TemporaryFolder folder;
  EXPECT_FALSE(swallowing::read_fitted(folder.path(), spacing));
  const FittedOrgans written = example();
  swallowing::write_fitted(folder.path(), written, spacing);
  const auto read = swallowing::read_fitted(folder.path(), spacing);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->particles.positions, written.particles.positions);
  EXPECT_EQ(read->particles.volumes, written.particles.volumes);
  EXPECT_EQ(read->particles.layers, written.particles.layers);
  EXPECT_EQ(read->particles.layer_spacings, written.particles.layer_spacings);
  EXPECT_EQ(read->particles.iterations, written.particles.iterations);
  EXPECT_EQ(read->particles.largest_deviation, written.particles.largest_deviation);
  EXPECT_EQ(read->depth, written.depth);
}

TEST(FittedFile, IsRefusedForAnotherSpacing) {
  const TemporaryFolder folder;
  swallowing::write_fitted(folder.path(), example(), spacing);
  const std::string text = message_of<InputError>([&] { (void)swallowing::read_fitted(folder.path(), 1.8e-3); });
  EXPECT_NE(text.find("fitted.bin holds particles of a spacing of 0.0024 m"), std::string::npos) << text;
}

TEST(FittedFile, ReportsDamage) {
  const TemporaryFolder folder;
  swallowing::write_fitted(folder.path(), example(), spacing);
  const auto path = folder.path() / "fitted.bin";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 9);
  const std::string text = message_of<InputError>([&] { (void)swallowing::read_fitted(folder.path(), spacing); });
  EXPECT_NE(text.find("fitted.bin is damaged"), std::string::npos) << text;
}

}  // namespace fitted_file_test
