// SPDX-License-Identifier: MIT
#include "output/mechanisms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "../../reference/temporary_folder.hpp"

namespace mechanisms_test {

using hmps_test::TemporaryFolder;
using swallowing::Summary;

/// Writes a case with a moment by the tongue that grows until 1.65 s, one by the wall that turns round, and an area
/// that is 12 mm2 from 1.63 to 1.69 s.
void write_case(const std::filesystem::path& folder, const swallowing::RunSettings& settings) {
  std::filesystem::create_directories(folder);
  Summary summary;
  summary.case_name = "X1";
  summary.fold_time = 1.65;
  summary.settings = settings;
  swallowing::write_summary(folder / "summary.json", summary);
  { swallowing::Series series(folder / "series.csv"); }
  swallowing::TimeTable table(folder / "contacts.csv",
                              "time,centre_height,tip_height,leaf_to_larynx,glottis,moment_tongue,moment_pharynx,"
                              "epiglottis-pharynx_area,open_upper");
  for (int k = 1000; k <= 2050; ++k) {
    const double t = 1e-3 * k, area = k >= 1630 && k <= 1690 ? 12 : 99;
    table.add(std::array{t, 46.0, 50 - t, std::abs(t - 1.9) + 5, 3.0, t, 1.5 - t, area, 100 - 40 * std::abs(t - 1)});
  }
}

TEST(Mechanisms, AreDerivedFromTheContacts) {
  const TemporaryFolder folder;
  const swallowing::RunSettings settings{{"spacing", "0.0024"}};
  write_case(folder.path() / "X1", settings);
  const auto results = swallowing::read_results(folder.path(), settings);
  swallowing::write_mechanisms(folder.path() / "mechanisms.md", results);
  const std::string text = examples::read_file(folder.path() / "mechanisms.md");
  for (const char* line :
       {"| folds below the horizontal | 1.650 s | – | – | – |",
        "| α, tongue: largest moment that turns the tip down, mN m | 1.65 at 1.650 s |",  // not after the fold
        "| β, pharyngeal wall: largest moment that turns the tip down, mN m | 0.10 at 1.400 s |",
        "| β, pharyngeal wall: largest moment that holds the tip up, mN m | -0.15 at 1.650 s |",
        "| leaf on wall, 1.63 to 1.69 s: area, mm2 | 12.0 |",
        "| leaf on wall, 1.63 to 1.69 s: normal force, N | – |",  // no such column
        "| height of the middle of the leaf at 1.700 s, mm | 46.0 |", "| height of its tip at 1.700 s, mm | 48.3 |",
        "| least gap between the upper leaf and the larynx, mm | 5.0 at 1.900 s |",
        "| least open area of the pharynx at 65 mm, of that at rest | 58 % at 2.050 s |"})
    EXPECT_NE(text.find(line), std::string::npos) << line << '\n' << text;
}

}  // namespace mechanisms_test
