// SPDX-License-Identifier: MIT
#include "hmps/core/detail/text_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>

#include "../../../reference/temporary_folder.hpp"
#if defined(__unix__) || defined(__APPLE__)
#include <sys/stat.h>
#endif

namespace text_file_test {

using namespace hmps::detail;

TEST(TextFile, ReadsAllBytesAndNamesWhatItCannotRead) {
  const hmps_test::TemporaryFolder folder;
  const auto path = (folder.path() / "a.txt").string();
  std::string bytes(3'000'000, 'x');
  bytes[1'500'000] = '\0';
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_EQ(read_text(path), bytes);
  std::ofstream(path, std::ios::binary) << "";
  EXPECT_EQ(read_text(path), "");
  std::filesystem::remove(path);
  EXPECT_THROW((void)read_text(path), hmps::InputError);
  EXPECT_THROW((void)read_text(folder.path().string()), hmps::InputError);
}

TEST(TextFile, StopsAtEndlessFiles) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP() << "no endless file here";
  try {
    (void)read_text("/dev/zero", 3'000'000);
    FAIL() << "an endless file has ended";
  } catch (const hmps::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/zero is not a regular file and has not ended after 3000000 bytes"),
              std::string::npos)
        << error.what();
  }
}

#if defined(__unix__) || defined(__APPLE__)
TEST(TextFile, ReadsPipes) {
  const hmps_test::TemporaryFolder folder;
  const auto path = (folder.path() / "pipe").string();
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  const std::string bytes(200'000, 'y');
  std::thread writer([&] { std::ofstream(path, std::ios::binary) << bytes; });
  const std::string text = read_text(path);
  writer.join();
  EXPECT_EQ(text, bytes);
}
#endif

TEST(TextFile, QuotesOnlyPrintableText) {
  EXPECT_EQ(printable("vertex 1"), "vertex 1");
  EXPECT_EQ(printable(std::string_view("a\0\n\xff\x1b[2J", 8)), "a\\x00\\x0a\\xff\\x1b[2J");
  // Not with +, about which g++ 12 warns falsely.
  EXPECT_EQ(printable(std::string(41, 'q')), std::string(40, 'q').append("..."));
}

TEST(TextFile, CutsLinesAndWords) {
  std::string_view text = "one  two\r\n\n last";
  std::string_view line = take_line(text);
  EXPECT_EQ(take_word(line), "one");
  EXPECT_EQ(take_word(line), "two");
  EXPECT_EQ(take_word(line), "");
  EXPECT_EQ(take_line(text), "");
  EXPECT_EQ(trimmed(take_line(text)), "last");
  EXPECT_TRUE(text.empty());
}

TEST(TextFile, NumbersMustBeWhole) {
  double number{};
  for (const char* good : {"1", "+1", "-2.5e-3", ".5", "1e300"}) EXPECT_TRUE(parse_number(good, number)) << good;
  for (const char* bad : {"", "+", "+-1", "1 ", "1,5", "0x10", "1e", "a", "1e999"})
    EXPECT_FALSE(parse_number(bad, number)) << bad;
  EXPECT_TRUE(parse_number("+1.25", number));
  EXPECT_EQ(number, 1.25);
}

// They used to be refused, as if they were too large.
TEST(TextFile, NumbersTooSmallForADoubleAreZero) {
  const std::string zeros(400, '0');
  for (const std::string& text :
       {std::string("1e-400"), std::string("-2.5E-400"), std::string("+1e-99999999999999999999"), "0." + zeros + "1",
        "0." + zeros + "1e+50", "1" + zeros + "e-900"}) {
    double number = 1;
    EXPECT_TRUE(parse_number(text, number)) << text;
    EXPECT_EQ(number, 0) << text;
  }
  double number{};
  for (const std::string& text : {std::string("1e400"), std::string("-0.01e+400"), "1" + zeros, "1" + zeros + ".5",
                                  "0." + zeros + "1e+900", std::string("1e99999999999999999999")})
    EXPECT_FALSE(parse_number(text, number)) << text;
  EXPECT_TRUE(parse_number("0." + zeros + "1e+401", number));
  EXPECT_EQ(number, 1);
}

}  // namespace text_file_test
