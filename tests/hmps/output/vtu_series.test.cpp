// SPDX-License-Identifier: MIT
#include "hmps/output/vtu_series.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"
#include "hmps/core/detail/text_file.hpp"

namespace vtu_series_test {

using namespace hmps;
using hmps_test::message_of;

const std::vector<Vector<double, 3>> points{{0, 0.25, -1}, {1, 2, 3}, {-4, 5.5, 6}};

TEST(VtuSeries, ListsEachFrameWhenItIsWritten) {
  const hmps_test::TemporaryFolder folder;
  VtuSeries frames(folder.path() / "deep" / "er" / "run.pvd");
  EXPECT_THROW(VtuSeries(folder.path() / "run.vtu"), InputError);
  for (int i = 0; i < 3; ++i) {
    frames.add(0.5 * i, vectors(points));
    const std::string list = detail::read_text((folder.path() / "deep/er/run.pvd").string());
    EXPECT_EQ(list, pvd_text(frames.frames()));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "deep/er" / frames.frames().back().second));
  }
  EXPECT_EQ(frames.frames()[2].second, "run_00002.vtu");
  EXPECT_NE(pvd_text(frames.frames()).find("timestep=\"0.5\" group=\"\" part=\"0\" file=\"run_00001.vtu\""),
            std::string::npos);
}

TEST(VtuSeriesMisuse, DetectsTwoSeriesOnOnePath) {
  const hmps_test::TemporaryFolder folder;
  VtuSeries first(folder.path() / "run.pvd");
  first.add(0, vectors(points));
  VtuSeries second(folder.path() / "run.pvd");
  EXPECT_THROW(first.add(1, vectors(points)), StateError);
  second.add(0, vectors(points));
  std::filesystem::remove(folder.path() / "run.pvd");  // written anew, with all its frames
  second.add(1, vectors(points));
  EXPECT_EQ(detail::read_text((folder.path() / "run.pvd").string()), pvd_text(second.frames()));
}

TEST(VtuSeries, AcceptsAFrameAgainAfterAWriteError) {
  const hmps_test::TemporaryFolder folder;
  const auto path = folder.path() / "run.pvd";
  const std::vector<Vector<double, 3>> x(2, Vector<double, 3>::Zero());
  VtuSeries series(path);
  series.add(0, vectors(x));
  const std::string before = detail::read_text(path.string());
  const auto obstacle = folder.path() / "run.pvd.part";  // a folder in place of the temporary file, and not empty
  std::filesystem::create_directories(obstacle / "full");
  EXPECT_THROW(series.add(0.1, vectors(x)), InputError);
  EXPECT_EQ(detail::read_text(path.string()), before);
  EXPECT_EQ(series.frames().size(), 1U);
  std::filesystem::remove_all(obstacle);
  series.add(0.1, vectors(x));
  EXPECT_EQ(series.frames().size(), 2U);
}

std::vector<double> times_of(const VtuSeries& series) {
  std::vector<double> times;
  for (const auto& [time, file] : series.frames()) times.push_back(time);
  return times;
}

TEST(VtuSeries, GoesOnWhereARunIsResumed) {
  const hmps_test::TemporaryFolder folder;
  const auto path = folder.path() / "a & b.pvd";
  std::vector<Vector<double, 3>> x(2, Vector<double, 3>::Zero());
  const auto text = [&](const char* file) { return detail::read_text((folder.path() / file).string()); };
  {
    VtuSeries series(path, {.resume_at = 0.3});  // nothing to resume
    EXPECT_TRUE(series.frames().empty());
    for (const double time : {0.1, 0.2, 0.3, 0.4, 0.5}) series.add(time, vectors(x));
  }
  const std::string before = text("a & b_00001.vtu"), at = text("a & b_00002.vtu"), after = text("a & b_00003.vtu");
  x[1][0] = 1;
  {
    VtuSeries series(path, {.resume_at = 0.1 + 0.2});  // 0.30000000000000004
    EXPECT_EQ(times_of(series), (std::vector<double>{0.1, 0.2, 0.3}));
    EXPECT_EQ(text("a & b.pvd"), pvd_text(series.frames()));
    series.add(0.45, vectors(x));
    EXPECT_EQ(series.frames().back().second, "a & b_00003.vtu");
    EXPECT_EQ(text("a & b.pvd"), pvd_text(series.frames()));
  }
  EXPECT_EQ(text("a & b_00002.vtu"), at);
  EXPECT_NE(text("a & b_00003.vtu"), after);
  {  // The frame at which the run goes on may be written again, once.
    VtuSeries series(path, {.resume_at = 0.3});
    series.add(0.1 + 0.2, vectors(x));
    EXPECT_EQ(times_of(series), (std::vector<double>{0.1, 0.2, 0.1 + 0.2}));
    EXPECT_THROW(series.add(0.1 + 0.2, vectors(x)), InputError);
  }
  EXPECT_NE(text("a & b_00002.vtu"), at);
  {  // A frame before that may not.
    VtuSeries series(path, {.resume_at = 0.25});
    EXPECT_EQ(times_of(series), (std::vector<double>{0.1, 0.2}));
    EXPECT_THROW(series.add(0.2, vectors(x)), InputError);
    series.add(0.25, vectors(x));
    EXPECT_EQ(series.frames().back().second, "a & b_00002.vtu");
  }
  EXPECT_EQ(text("a & b_00001.vtu"), before);
  EXPECT_TRUE(VtuSeries(path, {.resume_at = 0}).frames().empty());
  EXPECT_EQ(text("a & b.pvd"), pvd_text({}));
  EXPECT_TRUE(VtuSeries(path, {.resume_at = 1}).frames().empty());
}

TEST(VtuSeries, RefusesToGoOnWithWhatItDidNotWrite) {
  const hmps_test::TemporaryFolder folder;
  const auto path = folder.path() / "run.pvd";
  const std::vector<std::pair<double, std::string>> frames{{0.1, "run_00000.vtu"}, {0.2, "run_00001.vtu"}};
  const std::string whole = pvd_text(frames);
  const auto of = [](double a, double b) {
    return pvd_text(std::vector<std::pair<double, std::string>>{{a, "run_00000.vtu"}, {b, "run_00001.vtu"}});
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& text :
       {std::string(), whole.substr(0, whole.size() / 2), whole.substr(0, whole.size() - 1), whole + "\n",
        std::string("nonsense"), of(0.2, 0.1), of(0.1, 0.1), of(0.1, nan), of(nan, 0.1),
        pvd_text(std::vector<std::pair<double, std::string>>{{0.1, "other_00000.vtu"}})}) {
    replace_file(path, text);
    const std::string error = message_of([&] { VtuSeries(path, {.resume_at = 0.15}); });
    EXPECT_NE(error.find(path.string() + " cannot be resumed"), std::string::npos) << error << text;
    EXPECT_EQ(detail::read_text(path.string()), text);
  }
  EXPECT_NE(message_of([&] { VtuSeries(path, {.resume_at = nan}); }).find("resumed at nan"), std::string::npos);
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  EXPECT_THROW(VtuSeries(path, {.resume_at = 0.15}), InputError);
}

TEST(VtuSeries, StaysInItsFolderIfTheProgramChangesFolder) {
  const hmps_test::TemporaryFolder folder, elsewhere;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  VtuSeries frames("run.pvd");
  frames.add(0, vectors(points));
  std::filesystem::current_path(elsewhere.path());
  frames.add(1, vectors(points));
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "run_00001.vtu"));
  EXPECT_TRUE(std::filesystem::is_empty(elsewhere.path()));
}

// The first argument used to win silently.
TEST(VtuSeries, RefusesASecondTimeInTheSettings) {
  const hmps_test::TemporaryFolder folder;
  VtuSeries frames(folder.path() / "run.pvd");
  const std::string error = message_of([&] { frames.add(0.25, vectors(points), {}, {.time = 0}); });
  EXPECT_NE(error.find("at 0.25 s, but its settings have the time 0 s"), std::string::npos) << error;
  EXPECT_TRUE(frames.frames().empty());
  frames.add(0.25, vectors(points), {}, {.time = 0.25});
  const std::string text = detail::read_text((folder.path() / "run_00000.vtu").string());
  EXPECT_NE(text.find("format=\"ascii\">0.25</DataArray>"), std::string::npos);
}

// The collection itself could be written, so that the first frame was what failed, after hours of a run.
TEST(VtuSeries, RefusesANameThatIsTooLongForItsFrames) {
  const hmps_test::TemporaryFolder folder;
  const auto series = [&](std::size_t length) {
    return VtuSeries(folder.path() / (std::string(length, 'b') + ".pvd"));
  };
  std::size_t most = 0;  // of the file system
  const auto file = [&](std::size_t length) { return folder.path() / std::string(length, 'b'); };
  for (std::size_t length = 100; length < 1000 && detail::name_fits(file(length)); ++length) most = length + 5;
  if (most >= 1000) GTEST_SKIP() << "this file system takes any name";
  series(most - 19).add(0, vectors(points));
  const std::string error = message_of([&] { (void)series(most - 18); });
  EXPECT_NE(error.find("_00000.vtu and so on"), std::string::npos) << error;
  EXPECT_FALSE(std::filesystem::exists(file(most - 18).concat(".pvd")));
}

TEST(VtuSeriesMisuse, IsRefused) {
  const std::vector<Vector<double, 3>> x(2, Vector<double, 3>::Zero());
  const hmps_test::TemporaryFolder folder;
  EXPECT_THROW(VtuSeries(folder.path() / "s\xe9rie.pvd"), InputError);
  VtuSeries frames(folder.path() / "run.pvd");
  frames.add(1, vectors(x));
  EXPECT_THROW(frames.add(1, vectors(x)), InputError);
  EXPECT_THROW(frames.add(0.5, vectors(x)), InputError);
  EXPECT_EQ(frames.frames().size(), 1U);
}

}  // namespace vtu_series_test
