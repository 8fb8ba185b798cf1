// SPDX-License-Identifier: MIT
#include "../common/files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <hmps/motion/csv.hpp>

#include "../../reference/file_size_limit.hpp"
#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"
#include "../common/csv_writer.hpp"

namespace files_test {

using hmps::InputError;
using hmps_test::message_of;
using hmps_test::TemporaryFolder;

TEST(Files, AreReplacedAsAWhole) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  examples::write_atomically(path, "first");
  examples::write_atomically(path, "second");
  EXPECT_EQ(examples::read_file(path), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "nothing is left beside it";
  EXPECT_THROW(examples::write_atomically(folder.path() / "missing" / "a.txt", "x"), InputError);
  EXPECT_THROW((void)examples::read_file(folder.path() / "b.txt"), InputError);
}

TEST(Files, ReplacesOnlyFilesAndFollowsNoLinkButItsOwn) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe", file = folder.path() / "a.txt", link = folder.path() / "link",
             other = folder.path() / "precious";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(examples::write_atomically(pipe, "x"), InputError);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  examples::write_atomically(file, "first");
  std::filesystem::create_symlink("a.txt", link);
  examples::write_atomically(link, "second");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(examples::read_file(file), "second");
  examples::write_atomically(other, "kept");
  std::filesystem::create_symlink("precious", folder.path() / "a.txt.part");
  examples::write_atomically(file, "third");
  EXPECT_EQ(examples::read_file(other), "kept");
  EXPECT_FALSE(std::filesystem::is_symlink(file));
  {
    const hmps_test::FileSizeLimit limit(4096);
    EXPECT_THROW(examples::write_atomically(file, std::string(100000, 'x')), InputError);
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.txt.part"));
  EXPECT_EQ(examples::read_file(file), "third");
}

TEST(Files, ReportsAFolderThatCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(examples::prepare_folder(folder.path() / "new" / "deep"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "new" / "deep"));
  examples::write_atomically(folder.path() / "file", "x");
  const std::string in_the_way = message_of<InputError>([&] { examples::prepare_folder(folder.path() / "file"); });
  EXPECT_NE(in_the_way.find("file"), std::string::npos);
  EXPECT_THROW(examples::prepare_folder(folder.path() / "file" / "below"), InputError);
  if (::geteuid() == 0) return;  // root writes everywhere
  std::filesystem::permissions(folder.path() / "new", std::filesystem::perms::owner_read);
  EXPECT_THROW(examples::prepare_folder(folder.path() / "new"), InputError);
  std::filesystem::permissions(folder.path() / "new", std::filesystem::perms::owner_all);
}

TEST(Csv, NumbersComeBackToTheLastBit) {
  const TemporaryFolder folder;
  const std::vector<double> row{0.1, -1.0 / 3, 1e-300, 6.02214076e23, 0};
  { examples::CsvWriter(folder.path() / "t.csv", "a,b,c,d,e").add(row); }
  { examples::CsvWriter(folder.path() / "t.csv", "a,b,c,d,e", true).add(row); }
  const auto table = hmps::read_csv((folder.path() / "t.csv").string());
  EXPECT_EQ(table.names, (std::vector<std::string>{"a", "b", "c", "d", "e"}));
  std::vector<double> twice(row);
  twice.insert(twice.end(), row.begin(), row.end());
  EXPECT_EQ(table.values, twice);
}

}  // namespace files_test
