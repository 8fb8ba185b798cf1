// SPDX-License-Identifier: MIT
#include "hmps/output/file_replacement.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <iterator>
#include <string>

#include "../../reference/file_size_limit.hpp"
#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"
#include "hmps/core/detail/text_file.hpp"

namespace file_replacement_test {

using namespace hmps;

TEST(FileReplacement, TheNewFileTakesThePlaceOfTheOld) {
  const hmps_test::TemporaryFolder folder;
  const auto path = folder.path() / "a.bin";
  replace_file(path, std::string_view("first\0\n", 7));
  EXPECT_EQ(detail::read_text(path.string()), std::string("first\0\n", 7));
  replace_file(path, "2");
  EXPECT_EQ(detail::read_text(path.string()), "2");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(FileReplacement, KeepsALink) {
  const hmps_test::TemporaryFolder folder;
  const auto file = folder.path() / "a.bin", link = folder.path() / "link.bin";
  replace_file(file, "first");
  std::filesystem::create_symlink("a.bin", link);
  replace_file(link, "second");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(detail::read_text(file.string()), "second");
}

// Results are often linked to another disk before the first run.
TEST(FileReplacement, FollowsLinksToAFileThatDoesNotExistYet) {
  const hmps_test::TemporaryFolder folder;
  const auto file = folder.path() / "store" / "a.bin", link = folder.path() / "link.bin",
             second = folder.path() / "second.bin";
  std::filesystem::create_directory(folder.path() / "store");
  std::filesystem::create_symlink("store/a.bin", link);
  std::filesystem::create_symlink(link, second);
  replace_file(second, "first");
  EXPECT_TRUE(std::filesystem::is_symlink(link) && std::filesystem::is_symlink(second));
  EXPECT_EQ(detail::read_text(file.string()), "first");
  std::filesystem::remove(link);
  std::filesystem::create_symlink("second.bin", link);
  EXPECT_THROW(replace_file(second, "in a circle"), InputError);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(FileReplacement, DoesNotFollowALinkAtTheTemporaryName) {
  const hmps_test::TemporaryFolder folder;
  const auto other = folder.path() / "precious.txt", path = folder.path() / "a.bin",
             part = folder.path() / "a.bin.part";
  const auto expect_other_kept = [&] {
    replace_file(path, "new");
    EXPECT_EQ(detail::read_text(other.string()), "precious");
    EXPECT_EQ(detail::read_text(path.string()), "new");
    EXPECT_FALSE(std::filesystem::is_symlink(path));
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(part)));
  };
  replace_file(other, "precious");
  std::filesystem::create_symlink("precious.txt", part);
  expect_other_kept();
  std::filesystem::create_hard_link(other, part);
  expect_other_kept();
}

TEST(FileReplacement, ErrorsNameTheFileAndLeaveTheOldOne) {
  const hmps_test::TemporaryFolder folder;
  const auto missing = folder.path() / "missing" / "a.bin";
  try {
    replace_file(missing, "1");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(missing.string()), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
  // What is not a regular file stays: a program run by root would otherwise replace a device by a file.
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(replace_file(pipe, "1"), InputError);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  std::filesystem::remove(pipe);
  // A folder that is not empty cannot be replaced by a file.
  const auto taken = folder.path() / "taken";
  std::filesystem::create_directories(taken / "inner");
  EXPECT_THROW(replace_file(taken, "1"), InputError);
  EXPECT_TRUE(std::filesystem::is_directory(taken / "inner"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

// The file system may take the name, but not the temporary one.
TEST(FileReplacement, SaysThatANameIsTooLong) {
  const hmps_test::TemporaryFolder folder;
  std::string name(100, 'a');
  while (name.size() < 1000 && detail::name_fits(folder.path() / name)) name += 'a';
  const auto path = folder.path() / name;
  const std::string error = hmps_test::message_of([&] { replace_file(path, "1"); });
  EXPECT_NE(error.find("too long for the file system with the .part"), std::string::npos) << error;
  name.pop_back();
  replace_file(folder.path() / name, "1");
  EXPECT_EQ(detail::read_text((folder.path() / name).string()), "1");
}

TEST(FileReplacement, CallsBeforeItRenames) {
  const hmps_test::TemporaryFolder folder;
  const auto path = folder.path() / "a.bin";
  replace_file(path, "old");
  replace_file(path, "new", [&](const std::filesystem::path& temporary) {
    EXPECT_EQ(detail::read_text(temporary.string()), "new");
    EXPECT_EQ(detail::read_text(path.string()), "old");
  });
  EXPECT_EQ(detail::read_text(path.string()), "new");
  EXPECT_THROW(replace_file(path, "newer", [](const auto&) { throw StateError("no"); }), StateError);
  EXPECT_EQ(detail::read_text(path.string()), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(FileReplacement, LeavesNothingOfAFileThatDoesNotFit) {
  const hmps_test::TemporaryFolder folder;
  const auto path = folder.path() / "a.bin";
  replace_file(path, "old");
  const hmps_test::FileSizeLimit limit(4096);
  EXPECT_THROW(replace_file(path, std::string(100000, 'x')), InputError);
  EXPECT_EQ(detail::read_text(path.string()), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace file_replacement_test
