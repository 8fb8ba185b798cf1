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
  const VtuSettings twice{.names = {{"organ", {"a", "b", "c"}}, {"organ", {"d", "e", "f"}}}};
  EXPECT_THROW(write_vtu(path, vectors(x), fields, twice), InputError);
}

}  // namespace vtu_file_test
