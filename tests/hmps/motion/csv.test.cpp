// SPDX-License-Identifier: MIT
#include "hmps/motion/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "../../reference/message_of.hpp"
#include "../../reference/temporary_folder.hpp"

namespace csv_test {

using hmps_test::message_of;

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\n  lacks: " << part;
}

TEST(Csv, ReadsNamedColumnsOfNumbers) {
  const auto table =
      hmps::parse_csv("\xEF\xBB\xBF# a trace\n\nt, x ,y z\r\n0,1,-2.5e-3\r\n 0.5 ,\t+2, 3 # remark\n1,4,5");
  EXPECT_EQ(table.names, (std::vector<std::string>{"t", "x", "y z"}));
  ASSERT_EQ(table.rows(), 3u);
  EXPECT_EQ(table.columns(), 3u);
  EXPECT_EQ(table(0, 2), -2.5e-3);
  EXPECT_EQ(table(1, table.column("x")), 2);
  EXPECT_EQ(table(2, 2), 5);
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{4, 5, 6}));
  EXPECT_TRUE(table.has("x"));
  EXPECT_FALSE(table.has("z"));
  EXPECT_EQ(hmps::parse_csv("a,b\n").rows(), 0u);
}

TEST(Csv, NamesSourceLineAndColumnOfWhatIsWrong) {
  const auto message = [](const char* text) { return message_of([&] { (void)hmps::parse_csv(text, "trace.csv"); }); };
  expect_contains(message("t,x\n0,1\n\n1,b\n"), "trace.csv, line 4: 'b' in column 'x' is not a finite number");
  expect_contains(message("t,x\n0,nan\n"), "line 2: 'nan'");
  expect_contains(message("t,x\n0,\n"), "line 2: '' in column 'x'");
  expect_contains(message("t,x\n0,1,2\n"), "line 2: the row has 3 cells but the header names 2 columns");
  expect_contains(message("t,x\n0\n"), "line 2: the row has 1 cells");
  expect_contains(message("t;x\n0,5;1\n"), "line 1: 't;x' is the name of one column; separate columns by commas");
  expect_contains(message("t\tx\n0\t1\n"), "line 1: 't\\x09x' is the name of one column");
  expect_contains(message("# only\nt,x,t\n"), "line 2: the column 't' is named twice");
  expect_contains(message("t,,x\n"), "line 1: column 2 has no name");
  expect_contains(message(""), "trace.csv is empty");
  expect_contains(message("# nothing\n"), "trace.csv is empty");
  expect_contains(message_of([] { (void)hmps::parse_csv("t,x\n", "trace.csv").column("y"); }),
                  "trace.csv has no column 'y'; it has t, x");
  expect_contains(message_of([] { (void)hmps::read_csv("no/such/trace.csv"); }), "cannot open no/such/trace.csv");
}

TEST(Csv, QuotesNoRawBytesAndNotEveryColumn) {
  std::string header = "t";
  for (int k = 1; k < 50'000; ++k) header += ",c" + std::to_string(k);
  const auto table = hmps::parse_csv(header + "\n", "wide.csv");
  EXPECT_EQ(table.columns(), 50'000u);
  const std::string text = message_of([&] { (void)table.column("x"); });
  expect_contains(text, "it has t, c1");
  expect_contains(text, "c19 and 49980 more");
  expect_contains(message_of([&] { (void)hmps::parse_csv(header + ",c7\n", "wide.csv"); }), "'c7' is named twice");
  expect_contains(message_of([] { (void)hmps::parse_csv("t\x1b\n\xff\n", "raw.csv"); }), "'\\xff' in column 't\\x1b'");
}

TEST(Csv, ReadsFiles) {
  const hmps_test::TemporaryFolder folder;
  const auto path = (folder.path() / "a.csv").string();
  std::ofstream(path) << "t,x\n0,1\n2,3\n";
  const auto table = hmps::read_csv(path);
  EXPECT_EQ(table.source, path);
  EXPECT_EQ(table.rows(), 2u);
}

TEST(Csv, MakesKeyframesInMetres) {
  const auto table = hmps::parse_csv("t,ant,sup,turn\n0,0,0,0\n1,2,4,90\n", "hyoid.csv");
  const auto path = hmps::keyframes<2>(table, {"sup", "ant"}, 1e-3);
  EXPECT_DOUBLE_EQ(path.value(1)[0], 4e-3);
  EXPECT_DOUBLE_EQ(path.value(0.5)[1], 1e-3);
  EXPECT_DOUBLE_EQ(hmps::track(table, "turn", 2).value(1), 180);
  EXPECT_DOUBLE_EQ(hmps::track(table, "turn", 1, "ant").value(2), 90);
  expect_contains(message_of([&] { (void)hmps::track(table, "left"); }), "no column 'left'");
  const auto disorder = hmps::parse_csv("t,x\n0,0\n# pause\n0,1\n", "hyoid.csv");
  expect_contains(message_of([&] { (void)hmps::track(disorder, "x"); }),
                  "hyoid.csv, line 4: the time 0 s does not follow 0 s");
  expect_contains(message_of([&] { (void)hmps::track(hmps::parse_csv("t,x\n", "hyoid.csv"), "x"); }), "no row");
}

TEST(KeyframesOfATable, RefuseAScaleOfZero) {
  const hmps::Table table = hmps::parse_csv("t,x\n0,1\n1,2\n");
  for (const double scale : {0.0, static_cast<double>(NAN)})
    expect_contains(message_of([&] { (void)hmps::track(table, "x", scale); }), "scaled by");
}

TEST(Csv, RefusesAHeaderOfNumbersAndATimeAsItsOwnValue) {
  EXPECT_THROW((void)hmps::parse_csv("0,1\n1,3\n2,4\n"), hmps::InputError) << "its first row would be lost";
  EXPECT_NO_THROW((void)hmps::parse_csv("t,1\n1,3\n"));
  const auto table = hmps::parse_csv("t,x\n0,1\n1,3\n");
  EXPECT_THROW((void)hmps::track(table, "t"), hmps::InputError);
  EXPECT_THROW((void)hmps::track(table, "x", 1, "x"), hmps::InputError);
  EXPECT_NO_THROW((void)hmps::track(table, "x"));
}

TEST(Csv, RefusesCellsThatDoNotExist) {
  const auto table = hmps::parse_csv("t,x\n0,1\n1,3\n");
  EXPECT_EQ(table(1, 1), 3);
  expect_contains(message_of([&] { (void)table(2, 0); }), "CSV has 2 rows and 2 columns");
  EXPECT_THROW((void)table(1, 2), hmps::InputError) << "the column counted from 1";
}

TEST(Csv, RefusesOtherLineEndsAndEncodings) {
  expect_contains(message_of([] { (void)hmps::parse_csv("t,x\r0,1\r1,3\r"); }), "CR alone");
  // A single LF elsewhere does not make lines of the others.
  for (const char* text :
       {"t,x\r0,1\n", "t,x\n0,1\r1,3", "t,x\r\n0,1 # one\r1,3\r\n", "t,x\n\r0,1\n", "t,x\n0,1\r \r1,3\n"})
    expect_contains(message_of([&] { (void)hmps::parse_csv(text); }), "CR alone");
  for (const char* text : {"t,x\r\n0,1\r\n", "t,x\r\r\n0,1\r", "t,x\n0,1\r\r"})
    EXPECT_EQ(hmps::parse_csv(text).rows(), 1U) << text;
  EXPECT_EQ(hmps::parse_csv("t,x\r").rows(), 0u);
  EXPECT_EQ(hmps::parse_csv("t,x\r\n0,1\r\n").rows(), 1u);
  expect_contains(message_of([] { (void)hmps::parse_csv(std::string("\xFF\xFEt\0,\0x\0\n\0", 10)); }), "UTF-16");
}

}  // namespace csv_test
