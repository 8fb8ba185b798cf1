// SPDX-License-Identifier: MIT
#include "output/series.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "folder.hpp"

namespace {

using swallowing::Sample;
using swallowing::Series;

Sample sample(int i) {
  Sample s;
  s.time = i * 1e-3;
  s.tip_angle = std::cos(0.1 * i) / 3;  // a number that needs all its digits
  s.contacts = i;
  return s;
}

TEST(Series, CanBeReadWhileItGrowsToTheLastBit) {
  TestFolder folder;
  const auto path = folder.path / "series.csv";
  Series series(path);
  EXPECT_TRUE(swallowing::read_series(path).empty());
  for (int i = 0; i < 100; ++i) {
    series.add(sample(i));
    const auto read = swallowing::read_series(path);
    ASSERT_EQ(read.size(), static_cast<std::size_t>(i + 1));
    EXPECT_EQ(read.back().values(), sample(i).values());
  }
}

TEST(Series, ResumedAtACheckpointItIsTheSameFile) {
  TestFolder folder;
  const auto whole = folder.path / "whole.csv", resumed = folder.path / "resumed.csv";
  {
    Series series(whole);
    for (int i = 0; i < 50; ++i) series.add(sample(i));
  }
  {
    Series series(resumed);
    for (int i = 0; i < 30; ++i) series.add(sample(i));
  }
  // What a kill leaves: more than the checkpoint knows of, and half a line.
  std::filesystem::resize_file(resumed, std::filesystem::file_size(resumed) - 7);
  {
    Series series(resumed, 20e-3);
    ASSERT_EQ(series.samples().size(), 21u);
    for (int i = 21; i < 50; ++i) series.add(sample(i));
  }
  EXPECT_EQ(examples::read_file(resumed), examples::read_file(whole));
}

TEST(Series, WithoutResumeItBeginsAnew) {
  TestFolder folder;
  const auto path = folder.path / "series.csv";
  { Series(path).add(sample(1)); }
  { Series(path).add(sample(2)); }
  ASSERT_EQ(swallowing::read_series(path).size(), 1u);
  EXPECT_EQ(swallowing::read_series(path)[0].time, 2e-3);
}

TEST(Series, KeepsWhatADivergingRunLeft) {
  TestFolder folder;
  const auto path = folder.path / "series.csv";
  Sample last = sample(3);
  last.kinetic_energy = std::numeric_limits<double>::infinity();
  last.smallest_j = std::nan("");
  Series(path).add(last);
  const auto read = swallowing::read_series(path);
  ASSERT_EQ(read.size(), 1u);
  EXPECT_TRUE(std::isinf(read[0].kinetic_energy));
  EXPECT_TRUE(std::isnan(read[0].smallest_j));
}

TEST(Series, OtherFilesAreRefused) {
  TestFolder folder;
  examples::write_atomically(folder.path / "other.csv", "t,x\n1,2\n");
  EXPECT_THROW((void)swallowing::read_series(folder.path / "other.csv"), hmps::InputError);
}

}  // namespace
