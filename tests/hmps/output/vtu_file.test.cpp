// SPDX-License-Identifier: MIT
#include "hmps/output/vtu_file.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "../../reference/temporary_folder.hpp"
#include "hmps/core/detail/text_file.hpp"

namespace vtu_file_test {

using namespace hmps;

struct Cloud {
  std::vector<Vector<double, 3>> x{{0, 0.25, -1}, {1, 2, 3}, {-4, 5.5, 6}};
  std::vector<double> j{1, 0.5, 1.25};
  std::vector<int> organ{0, 1, 0};
  std::vector<Matrix<double, 3>> stress{3, Matrix<double, 3>::Identity()};
  std::vector<std::array<Index, 3>> triangles{{0, 1, 2}, {0, 2, 1}};

  [[nodiscard]] std::vector<VtkField> fields() {
    stress[1] << 1, 2, 3, 4, 5, 6, 7, 8, 9;
    return {vtk_field("velocity", vectors(x)), vtk_field<double>("J", scalars(j)), vtk_field("organ", scalars(organ)),
            vtk_field("stress <&>", matrices(stress))};
  }
};

/// The message of the error of `call`.
template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(VtuFile, RefusesWhatDoesNotFit) {
  Cloud cloud;
  const hmps_test::TemporaryFolder folder;
  const auto path = folder.path() / "a.vtu";
  const auto write = [&](const std::vector<VtkField>& fields, const VtuSettings& settings = {}) {
    return error_of([&] { write_vtu(path, vectors(cloud.x), fields, settings); });
  };
  std::vector<double> two{1, 2};
  EXPECT_NE(write({vtk_field("J", scalars(two))}).find("J of a VTU file has 2 particles but there are 3"),
            std::string::npos);
  EXPECT_NE(write({vtk_field("J", scalars(cloud.j)), vtk_field("J", scalars(cloud.j))}).find("two fields"),
            std::string::npos);
  // In the file both are "J?".
  EXPECT_NE(write({vtk_field("J\n", scalars(cloud.j)), vtk_field("J\t", scalars(cloud.j))}).find("two fields"),
            std::string::npos);
  EXPECT_NE(write({vtk_field("", scalars(cloud.j))}).find("no name"), std::string::npos);
  EXPECT_NE(write({}, {.time = std::numeric_limits<double>::infinity()}).find("time"), std::string::npos);
  EXPECT_NE(write({vtk_field("J", scalars(cloud.j))}, {.names = {{"J", {"a"}}}}).find("not an integer field"),
            std::string::npos);
  cloud.triangles[1][2] = 3;
  EXPECT_NE(write({}, {.triangles = cloud.triangles}).find("triangle 1"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path));
  cloud.x[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(write({}).find("particle 2"), std::string::npos);
  cloud.x[2][1] = 0;
  const auto missing = (folder.path() / "missing" / "a.vtu").string();
  EXPECT_NE(error_of([&] { write_vtu(missing, vectors(cloud.x)); }).find(missing), std::string::npos);
}

TEST(VtuFile, ASeriesListsEachFrameWhenItIsWritten) {
  Cloud cloud;
  const hmps_test::TemporaryFolder folder;
  VtuSeries frames(folder.path() / "deep" / "er" / "run.pvd");
  EXPECT_THROW(VtuSeries(folder.path() / "run.vtu"), InputError);
  for (int i = 0; i < 3; ++i) {
    frames.add(0.5 * i, vectors(cloud.x));
    const std::string list = detail::read_text((folder.path() / "deep/er/run.pvd").string());
    EXPECT_EQ(list, pvd_text(frames.frames()));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "deep/er" / frames.frames().back().second));
  }
  EXPECT_EQ(frames.frames()[2].second, "run_00002.vtu");
  EXPECT_NE(pvd_text(frames.frames()).find("timestep=\"0.5\" group=\"\" part=\"0\" file=\"run_00001.vtu\""),
            std::string::npos);
}

TEST(VtuFile, KeepsPointsDistinctFarFromTheOrigin) {
  std::vector<Vector<double, 3>> x;
  for (int k = 0; k < 10; ++k) x.push_back({1000 + 2e-5 * k, 0, 0});
  const hmps_test::TemporaryFolder folder;
  write_vtu(folder.path() / "a.vtu", vectors(x));
  const std::string text = detail::read_text((folder.path() / "a.vtu").string());
  EXPECT_NE(text.find("type=\"Float64\" Name=\"position\""), std::string::npos);
  for (auto& place : x) place[0] -= 1000;
  write_vtu(folder.path() / "a.vtu", vectors(x));
  EXPECT_NE(detail::read_text((folder.path() / "a.vtu").string()).find("type=\"Float32\" Name=\"position\""),
            std::string::npos);
}

TEST(VtuFile, NamesThatAreNotUtf8BecomeQuestionMarks) {
  const Cloud cloud;
  const std::string text =
      vtu_text(vtk_field("position", vectors(cloud.x)),
               std::vector{vtk_field("press\xe3o", scalars(cloud.j)), vtk_field("o\xff", scalars(cloud.organ))},
               {.names = {{"o\xff", {"a\xe9", "b"}}}});
  EXPECT_NE(text.find("Name=\"press?o\""), std::string::npos);
  EXPECT_NE(text.find("Name=\"o? names\""), std::string::npos);
  EXPECT_NE(text.find("\n97 63 0\n98 0\n"), std::string::npos);  // a question mark is byte 63
}

// VTK itself reads back what was written: read_vtu.py beside this file compares every value.
TEST(VtuFile, CanBeReadByVtk) {
  const std::string python = "/usr/bin/python3 ";
  if (std::system((python + "-c 'import vtk' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "the Python package of VTK is not here: apt-get install --no-install-recommends python3-vtk9";
  Cloud cloud;
  const hmps_test::TemporaryFolder folder;
  VtuSettings settings{.time = 0.125, .names = {{"organ", {"tongue", "palate & uvula"}}}};
  write_vtu(folder.path() / "cloud.vtu", vectors(cloud.x), cloud.fields(), settings);
  settings.triangles = cloud.triangles;
  write_vtu(folder.path() / "surface.vtu", vectors(cloud.x), cloud.fields(), settings);
  std::vector<Vector<float, 2>> none;
  write_vtu(folder.path() / "empty.vtu", vectors(none));
  const auto script = std::filesystem::path(__FILE__).parent_path() / "read_vtu.py";
  EXPECT_EQ(std::system((python + script.string() + " " + folder.path().string()).c_str()), 0);
}

TEST(VtuFileMisuse, DetectsTwoSeriesOnOnePath) {
  const Cloud cloud;
  const hmps_test::TemporaryFolder folder;
  VtuSeries first(folder.path() / "run.pvd");
  first.add(0, vectors(cloud.x));
  VtuSeries second(folder.path() / "run.pvd");
  EXPECT_THROW(first.add(1, vectors(cloud.x)), StateError);
  second.add(0, vectors(cloud.x));
  std::filesystem::remove(folder.path() / "run.pvd");  // written anew, with all its frames
  second.add(1, vectors(cloud.x));
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
    const std::string error = error_of([&] { VtuSeries(path, {.resume_at = 0.15}); });
    EXPECT_NE(error.find(path.string() + " cannot be resumed"), std::string::npos) << error << text;
    EXPECT_EQ(detail::read_text(path.string()), text);
  }
  EXPECT_NE(error_of([&] { VtuSeries(path, {.resume_at = nan}); }).find("resumed at nan"), std::string::npos);
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  EXPECT_THROW(VtuSeries(path, {.resume_at = 0.15}), InputError);
}

TEST(VtuSeries, StaysInItsFolderIfTheProgramChangesFolder) {
  const Cloud cloud;
  const hmps_test::TemporaryFolder folder, elsewhere;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  VtuSeries frames("run.pvd");
  frames.add(0, vectors(cloud.x));
  std::filesystem::current_path(elsewhere.path());
  frames.add(1, vectors(cloud.x));
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "run_00001.vtu"));
  EXPECT_TRUE(std::filesystem::is_empty(elsewhere.path()));
}

TEST(VtuFileMisuse, IsRefused) {
  const std::vector<Vector<double, 3>> x(2, Vector<double, 3>::Zero());
  const hmps_test::TemporaryFolder folder;
  const auto path = folder.path() / "a.vtu";
  EXPECT_THROW(write_vtu(folder.path() / "a.vtk", vectors(x)), InputError);
  EXPECT_THROW(write_vtu(folder.path(), vectors(x)), InputError);
  EXPECT_EQ((VtkField{"a", 0, "Float32", ""}.size()), 0U);
  for (const VtkField& field : {VtkField{"a", 0, "Float32", ""}, VtkField{"a", -1, "Float32", ""},
                                VtkField{"a", 1, "Float16", std::string(8, 'a')}})
    EXPECT_THROW(write_vtu(path, vectors(x), {field}), InputError) << field.components;
  const std::vector<int> organ(x.size(), 2);
  const std::vector<VtkField> fields{vtk_field("organ", scalars(organ))};
  EXPECT_THROW(write_vtu(path, vectors(x), fields, {.names = {{"organ", {"tongue", "palate"}}}}), InputError);
  EXPECT_NO_THROW(write_vtu(folder.path() / "named.vtu", vectors(x), fields, {.names = {{"organ", {"a", "b", "c"}}}}));
  const std::vector<int> signed_organ{-1, 0};
  EXPECT_NE(error_of([&] {
              write_vtu(path, vectors(x), {vtk_field("organ", scalars(signed_organ))}, {.names = {{"organ", {"a"}}}});
            }).find("number 0 of the field organ of a VTU file is -1"),
            std::string::npos);
  EXPECT_THROW(VtuSeries(folder.path() / "s\xe9rie.pvd"), InputError);
  const VtuSettings twice{.names = {{"organ", {"a", "b", "c"}}, {"organ", {"d", "e", "f"}}}};
  EXPECT_THROW(write_vtu(path, vectors(x), fields, twice), InputError);
  VtuSeries frames(folder.path() / "run.pvd");
  frames.add(1, vectors(x));
  EXPECT_THROW(frames.add(1, vectors(x)), InputError);
  EXPECT_THROW(frames.add(0.5, vectors(x)), InputError);
  EXPECT_EQ(frames.frames().size(), 1U);
}

}  // namespace vtu_file_test
