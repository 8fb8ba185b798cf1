// SPDX-License-Identifier: MIT
#include "output/pictures.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../../reference/temporary_folder.hpp"
#include "output/comparison.hpp"

namespace pictures_test {

using hmps_test::TemporaryFolder;
using swallowing::Role;
using swallowing::Snapshot;
using swallowing::Snapshots;

/// A block of one organ, 40 mm by 20 mm by 60 mm, with a dark layer below and a grey one behind.
Snapshot block(double time) {
  Snapshot s;
  s.time = time;
  s.spacing = 2e-3;
  s.organs = {"tongue", "epiglottis"};
  for (int i = 0; i < 20; ++i)
    for (int j = -5; j < 5; ++j)
      for (int k = 0; k < 30; ++k) {
        s.positions.push_back(
            {2e-3f * static_cast<float>(i), 2e-3f * (static_cast<float>(j) + 0.5f), 2e-3f * static_cast<float>(k)});
        s.organ.push_back(k > 20 ? 1 : 0);
        s.role.push_back(k == 0 ? Role::control : i == 19 ? Role::plate : Role::free);
      }
  s.centre = {0.01, 0, 0.045};
  s.tip = {0.02, 0, 0.055};
  s.tip_angle = 45;
  return s;
}

struct Png {
  cairo_surface_t* surface;
  explicit Png(const std::filesystem::path& path) : surface(cairo_image_surface_create_from_png(path.c_str())) {}
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  ~Png() { cairo_surface_destroy(surface); }
  /// The share of pixels that `wanted(red, green, blue)` holds for.
  template <class Wanted>
  [[nodiscard]] double share(Wanted&& wanted) const {
    const int width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
    const unsigned char* data = cairo_image_surface_get_data(surface);
    int count = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const unsigned char* p = data + y * cairo_image_surface_get_stride(surface) + 4 * x;
        count += wanted(int{p[2]}, int{p[1]}, int{p[0]});
      }
    return static_cast<double>(count) / width / height;
  }
};

constexpr auto red = [](int r, int g, int b) { return r > 150 && g < 120 && b < 120; };
constexpr auto yellow = [](int r, int g, int b) { return r > 200 && g > 150 && b < 100; };
constexpr auto dark = [](int r, int g, int b) { return r < 70 && g < 70 && b < 80; };

TEST(Pictures, ASnapshotComesBackAsItWas) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  EXPECT_FALSE(snapshots.load(1.667));
  const Snapshot s = block(1.667);
  snapshots.add(1.667, s);
  const auto read = snapshots.load(1.667);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->time, s.time);
  EXPECT_EQ(read->spacing, s.spacing);
  EXPECT_EQ(read->positions, s.positions);
  EXPECT_EQ(read->organ, s.organ);
  EXPECT_EQ(read->role, s.role);
  EXPECT_EQ(read->organs, s.organs);
  EXPECT_EQ(read->centre, s.centre);
  EXPECT_EQ(read->tip, s.tip);
  EXPECT_EQ(read->tip_angle, 45);
}

TEST(Pictures, AResumedRunKeepsWhatLiesBeforeTheCheckpoint) {
  const TemporaryFolder folder;
  {
    const Snapshots snapshots(folder.path());
    for (const double time : {0., 0.5, 1.383, 1.583, 1.667}) snapshots.add(time, block(time));
  }
  {
    const Snapshots snapshots(folder.path(), 1.4);
    EXPECT_TRUE(snapshots.load(0) && snapshots.load(0.5) && snapshots.load(1.383));
    EXPECT_FALSE(snapshots.load(1.583) || snapshots.load(1.667));
  }
  const Snapshots anew(folder.path());
  EXPECT_FALSE(anew.load(0));
}

TEST(Pictures, TheSheetShowsOrgansAndControlRegions) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  const auto path = folder.path() / "sheet.png";
  swallowing::draw_sheet(path, snapshots, "nothing yet");
  EXPECT_LT(Png(path).share(red), 1e-3);

  for (const double time : swallowing::snapshot_times) snapshots.add(time, block(time));
  swallowing::draw_sheet(path, snapshots, "all");
  const Png sheet(path);
  ASSERT_EQ(cairo_surface_status(sheet.surface), CAIRO_STATUS_SUCCESS);
  EXPECT_GT(cairo_image_surface_get_width(sheet.surface), 1500);
  EXPECT_GT(sheet.share(red), 0.2);
  EXPECT_GT(sheet.share(yellow), 0.05);
  EXPECT_GT(sheet.share(dark), 0.01);
}

TEST(Pictures, OnlyTheRightHalfIsDrawn) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  Snapshot s = block(0);
  for (auto& p : s.positions) p[1] = -std::abs(p[1]);
  snapshots.add(0, s);
  swallowing::draw_sheet(folder.path() / "sheet.png", snapshots, "left");
  EXPECT_LT(Png(folder.path() / "sheet.png").share(yellow), 1e-3);
}

/// A sheet of one organ across the midsagittal plane.
Snapshot sheet_of(const std::string& organ, float x, float height) {
  Snapshot s;
  s.spacing = 2e-3;
  s.organs = {organ};
  for (int j = -8; j <= 8; ++j)
    for (int k = -8; k <= 8; ++k) {
      s.positions.push_back({x, 2e-3f * static_cast<float>(j), height + 2e-3f * static_cast<float>(k)});
      s.organ.push_back(0);
      s.role.push_back(Role::free);
    }
  return s;
}

TEST(Pictures, FromBehindTheLeafIsNotHiddenByTheWall) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  const auto path = folder.path() / "rear.png";
  const auto drawn = [&](const Snapshot& s) {
    snapshots.add(1.583, s);
    swallowing::draw_rear(path, snapshots, "rear");
    return Png(path);
  };
  EXPECT_GT(drawn(sheet_of("epiglottis", -5e-3f, 45e-3f)).share(yellow), 5e-3);
  constexpr auto pink = [](int r, int g, int b) { return r > 200 && g < 200 && b > 150 && r > g + 20; };
  EXPECT_LT(drawn(sheet_of("pharynx", 10e-3f, 45e-3f)).share(pink), 1e-4) << "the posterior wall is removed";
  EXPECT_GT(drawn(sheet_of("pharynx", -5e-3f, 45e-3f)).share(pink), 1e-3) << "the right side wall stays";
}

TEST(Pictures, SectionsShowTheirHeight) {
  const TemporaryFolder folder;
  const Snapshots snapshots(folder.path() / "snapshots");
  const auto path = folder.path() / "sections.png";
  snapshots.add(1.667, sheet_of("tongue", 0, 40e-3f));
  swallowing::draw_sections(path, snapshots, "sections");
  EXPECT_GT(Png(path).share(red), 5e-4);
  snapshots.add(1.667, sheet_of("tongue", 0, 110e-3f));
  swallowing::draw_sections(path, snapshots, "above all sections");
  EXPECT_LT(Png(path).share(red), 1e-4) << "only that of the legend";
}

TEST(Pictures, OutlinesOfTwoLeavesAreRedAndYellow) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "outlines.png";
  const std::array<swallowing::NamedSnapshots, 2> both{{{"X1", folder.path() / "a"}, {"Y1", folder.path() / "b"}}};
  const Snapshots first(both[0].folder), second(both[1].folder);
  first.add(1.7, sheet_of("epiglottis", -10e-3f, 40e-3f));
  swallowing::draw_outlines(path, both);
  EXPECT_FALSE(std::filesystem::exists(path)) << "the second leaf is missing";
  second.add(1.7, sheet_of("epiglottis", 5e-3f, 40e-3f));
  swallowing::draw_outlines(path, both);
  const Png outlines(path);
  const double reds = outlines.share([](int r, int g, int b) { return r > 170 && g < 60 && b < 70; });
  const double yellows = outlines.share([](int r, int g, int b) { return r > 200 && g > 150 && b < 60; });
  EXPECT_GT(reds, 2e-3);
  EXPECT_LT(reds, 0.03) << "an outline, not an area";
  EXPECT_NEAR(yellows / reds, 1, 0.3);
}

TEST(Pictures, TableAndFoldStandBesideThePaper) {
  const TemporaryFolder folder;
  const auto x1 = folder.path() / "X1";
  std::filesystem::create_directories(x1);
  {
    swallowing::Series series(x1 / "series.csv");
    for (int i = 0; i < 205; ++i) {
      swallowing::Sample sample;
      sample.time = 0.01 * i;
      sample.tip_angle = 60 - 0.4 * i;
      series.add(sample);
    }
  }
  swallowing::Summary summary;
  summary.case_name = "X1";
  summary.friction = 0.1;
  summary.time = 2.05;
  summary.fold_time = 1.662;
  const swallowing::RunSettings settings{{"spacing", "0.0024"}, {"scalar", "float"}};
  summary.settings = settings;
  swallowing::write_summary(x1 / "summary.json", summary);
  summary.settings = {{"spacing", "0.0018"}, {"scalar", "float"}};
  std::filesystem::create_directories(folder.path() / "Y1");
  swallowing::write_summary(folder.path() / "Y1/summary.json", summary);

  const auto results = swallowing::read_results(folder.path(), settings);
  ASSERT_TRUE(results[0].summary);
  EXPECT_EQ(results[0].samples.size(), 205u);
  EXPECT_FALSE(results[2].summary) << "a case of other settings stands in the table";
  EXPECT_EQ(results[2].left_out, "spacing 0.0018 in place of 0.0024");
  EXPECT_FALSE(results[3].summary);
  swallowing::write_table2(folder.path() / "table2.md", results);
  swallowing::draw_fold(folder.path() / "fold.png", results);
  const std::string table = examples::read_file(folder.path() / "table2.md");
  EXPECT_NE(table.find("| X1 | X | 0.1 | 1.65 s | 1.662 s | +12 ms |"), std::string::npos) << table;
  EXPECT_NE(table.find("| Y1 | Y | 0.1 | 1.70 s | other settings |"), std::string::npos) << table;
  EXPECT_NE(table.find("Case Y1 was run with other settings: spacing 0.0018"), std::string::npos) << table;
  EXPECT_NE(table.find("| Y3 | Y | 0.3 | did not fold | not run |"), std::string::npos) << table;
  EXPECT_GT(Png(folder.path() / "fold.png").share([](int r, int g, int b) { return r > 170 && g < 60 && b < 70; }),
            1e-3);
}

}  // namespace pictures_test
