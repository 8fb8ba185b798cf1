// SPDX-License-Identifier: MIT
#include "report/study.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <hmps/output/file_replacement.hpp>
#include <string>
#include <vector>

#include "../../reference/temporary_folder.hpp"
#include "common/files.hpp"

namespace study_test {

using namespace report;
namespace fs = std::filesystem;

class Program : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  int run(const std::vector<std::string>& arguments, const std::function<void(Study&)>& measure) {
    Study study("study", "A study.", "less");
    std::vector<std::string> all = arguments;
    all.insert(all.begin(), "study");
    std::vector<char*> argv;
    for (std::string& argument : all) argv.push_back(argument.data());
    return study.run(static_cast<int>(argv.size()), argv.data(), [&] { measure(study); });
  }

 private:
  hmps_test::TemporaryFolder folder_;
};

TEST_F(Program, PublishesATableItsSectionAndItsPicture) {
  const auto measure = [](Study& study) {
    EXPECT_TRUE(study.quick);
    study.publish({.name = "one", .header = {"a"}, .rows = {{"1"}}},
                  {"one.png", "a picture", [](const auto& file) { hmps::replace_file(file, "drawn"); }});
  };
  ASSERT_EQ(run({"--quick", "--out", path("out"), "--document", path("page/study.md")}, measure), 0);
  EXPECT_EQ(examples::read_file(path("out/one.csv")), "a\n1\n");
  EXPECT_EQ(examples::read_file(path("page/images/one.png")), "drawn");
  EXPECT_EQ(examples::read_file(path("page/study.md")),
            "\n<!-- begin one -->\n\n| a |\n|---|\n| 1 |\n\n![a picture](images/one.png)\n\n<!-- end one -->\n");
}
TEST_F(Program, WritesThePageInTheFolderWhereItRuns) {
  examples::prepare_folder(path(""));
  const fs::path before = fs::current_path();
  fs::current_path(path(""));
  const int code = run({"--out", path("out"), "--document", "study.md"}, [](Study& study) {
    study.publish({.name = "one", .header = {"a"}},
                  {"one.png", "", [](const auto& file) { hmps::replace_file(file, "drawn"); }});
  });
  fs::current_path(before);
  EXPECT_EQ(code, 0);
  EXPECT_TRUE(fs::exists(path("study.md")));
  EXPECT_EQ(examples::read_file(path("images/one.png")), "drawn");
}
TEST_F(Program, WritesNoPageUnlessRequested) {
  ASSERT_EQ(run({"--out", path("out")},
                [](Study& study) {
                  EXPECT_FALSE(study.quick);
                  study.publish({.name = "one", .header = {"a"}}, {"one.png", "", [](const auto&) { FAIL(); }});
                }),
            0);
  EXPECT_TRUE(fs::exists(path("out/one.csv")));
}
TEST_F(Program, ReportsFailedChecksOnThePageAndByItsExitCode) {
  const auto measure = [](Study& study) {
    Table table{.name = "one", .header = {"a"}};
    table.check(false, "it is broken");
    study.publish(table);
    study.publish({.name = "two", .header = {"a"}});
  };
  EXPECT_EQ(run({"--out", path("out"), "--document", path("study.md")}, measure), 1);
  EXPECT_NE(examples::read_file(path("study.md")).find("Failed check: one: it is broken.\n"), std::string::npos);
}
TEST_F(Program, ExitsWithTwoOnError) {
  EXPECT_EQ(run({"--out", path("out")}, [](Study&) { throw hmps::InputError("no"); }), 2);
  examples::prepare_folder(path(""));
  hmps::replace_file(path("file"), "");
  EXPECT_EQ(run({"--out", path("file/out")}, [](Study&) { FAIL() << "there is no folder"; }), 2);
}

}  // namespace study_test
