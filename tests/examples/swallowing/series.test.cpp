// SPDX-License-Identifier: MIT
#include "output/series.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"

namespace series_test {

using hmps_test::message_of;
using hmps_test::TemporaryFolder;
using swallowing::Sample;
using swallowing::Series;
using swallowing::TableMark;

Sample sample(int i) {
  Sample s;
  s.time = i * 1e-3;
  s.tip_angle = std::cos(0.1 * i) / 3;  // a number that needs all its digits
  s.contacts = i;
  return s;
}

TEST(Series, CanBeReadWhileItGrowsToTheLastBit) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  Series series(path);
  EXPECT_TRUE(swallowing::read_series(path).empty());
  for (int i = 0; i < 100; ++i) {
    series.add(sample(i));
    const auto read = swallowing::read_series(path);
    ASSERT_EQ(read.size(), static_cast<std::size_t>(i + 1));
    EXPECT_EQ(read.back().values(), sample(i).values());
  }
}

/// Writes samples 0 to 29 at `path`. Returns the mark behind the 21st, where a checkpoint is written.
TableMark thirty_samples(const std::filesystem::path& path) {
  Series series(path);
  TableMark mark;
  for (int i = 0; i < 30; ++i) {
    series.add(sample(i));
    if (i == 20) mark = series.flush_to_disk();
  }
  return mark;
}

TEST(Series, ResumedAtACheckpointItIsTheSameFile) {
  const TemporaryFolder folder;
  const auto whole = folder.path() / "whole.csv", resumed = folder.path() / "resumed.csv";
  {
    Series series(whole);
    for (int i = 0; i < 50; ++i) series.add(sample(i));
  }
  const TableMark mark = thirty_samples(resumed);
  // What a kill leaves: more than the checkpoint knows of, and half a line. What a loss of power leaves: anything
  // there.
  std::filesystem::resize_file(resumed, std::filesystem::file_size(resumed) - 7);
  std::filesystem::resize_file(resumed, std::filesystem::file_size(resumed) + 100);
  TableMark again;
  {
    Series series(resumed, mark);
    ASSERT_EQ(series.samples().size(), 21u);
    EXPECT_EQ(series.samples().back().values(), sample(20).values());
    for (int i = 21; i < 50; ++i) series.add(sample(i));
    again = series.flush_to_disk();
  }
  EXPECT_EQ(examples::read_file(resumed), examples::read_file(whole));
  EXPECT_EQ(Series(whole, again).samples().size(), 50u) << "a resumed series marks as one that was not";
}

TEST(Series, IsNotResumedWhereItHasLostWhatLiesBeforeTheCheckpoint) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  const auto refusal = [&](const TableMark& mark) {
    return message_of<hmps::InputError>([&] { (void)Series(path, mark); });
  };
  const TableMark mark = thirty_samples(path);
  const std::string whole = examples::read_file(path);
  for (const std::uint64_t left : {mark.bytes - 1, mark.bytes / 2, std::uint64_t{0}}) {
    examples::write_atomically(path, std::string_view(whole).substr(0, left));
    EXPECT_NE(refusal(mark).find("series.csv has " + std::to_string(left) + " of the"), std::string::npos)
        << refusal(mark);
    EXPECT_EQ(std::filesystem::file_size(path), left) << "what was left was touched";
  }
  std::string changed = whole;
  changed[mark.bytes / 2] = changed[mark.bytes / 2] == '1' ? '2' : '1';
  examples::write_atomically(path, changed);
  EXPECT_NE(refusal(mark).find("no longer"), std::string::npos) << refusal(mark);
  std::filesystem::remove(path);
  EXPECT_NE(refusal(mark).find("--resume"), std::string::npos) << refusal(mark);
  EXPECT_FALSE(std::filesystem::exists(path)) << "a series was begun anew";
  examples::write_atomically(path, whole);
  EXPECT_EQ(Series(path, mark).samples().size(), 21u);
}

TEST(Series, StartsAnewWithoutResume) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  { Series(path).add(sample(1)); }
  { Series(path).add(sample(2)); }
  ASSERT_EQ(swallowing::read_series(path).size(), 1u);
  EXPECT_EQ(swallowing::read_series(path)[0].time, 2e-3);
}

TEST(Series, KeepsTheRowsOfADivergingRun) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  Sample last = sample(3);
  last.kinetic_energy = std::numeric_limits<double>::infinity();
  last.smallest_j = std::nan("");
  Series(path).add(last);
  const auto read = swallowing::read_series(path);
  ASSERT_EQ(read.size(), 1u);
  EXPECT_TRUE(std::isinf(read[0].kinetic_energy));
  EXPECT_TRUE(std::isnan(read[0].smallest_j));
}

TEST(Series, AMalformedLineIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "series.csv";
  { Series(path).add(sample(1)); }
  const std::string whole = examples::read_file(path);
  const std::size_t line = whole.find('\n') + 1;
  for (const char* damage : {"x", ",", "1x,", " "}) {
    examples::write_atomically(path, whole.substr(0, line) + damage + whole.substr(line));
    EXPECT_THROW((void)swallowing::read_series(path), hmps::InputError) << damage;
  }
}

TEST(Series, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  examples::write_atomically(folder.path() / "other.csv", "t,x\n1,2\n");
  EXPECT_THROW((void)swallowing::read_series(folder.path() / "other.csv"), hmps::InputError);
}

}  // namespace series_test
