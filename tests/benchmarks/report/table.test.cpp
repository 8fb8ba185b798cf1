// SPDX-License-Identifier: MIT
#include "report/table.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hmps/core/error.hpp"

namespace table_test {

using namespace report;

TEST(Table, IsMarkdown) {
  const Table table{.header = {"a", "b", "c"}, .rows = {{"1", "", "3"}, {"x", spanning("failed", 1)}}};
  EXPECT_EQ(table.markdown(), "| a | b | c |\n|---|---|---|\n| 1 |  | 3 |\n| x | failed | |\n");
}
TEST(Table, QuotesCellsThatNeedIt) {
  const Table table{.header = {"a", "b, c"}, .rows = {{"say \"no\"", "two\nlines"}, {"1", ""}}};
  EXPECT_EQ(table.csv(), "a,\"b, c\"\n\"say \"\"no\"\"\",\"two\nlines\"\n1,\n");
}
TEST(Table, ReadsItsOwnOutput) {
  const Table table{.header = {"a", "b"}, .rows = {{"1", "\"\""}, {",", "\n"}, {"", "plain"}}};
  std::vector<Cells> expected = table.rows;
  expected.insert(expected.begin(), table.header);
  EXPECT_EQ(read_csv(table.csv()), expected);
  EXPECT_TRUE(read_csv("").empty());
}
TEST(Table, RecordsFailedChecks) {
  Table table{.name = "walls", .header = {"a"}};
  table.check(true, "one");
  EXPECT_TRUE(table.broken.empty());
  table.check(false, "two");
  EXPECT_EQ(table.broken, Cells{"walls: two"});
}

TEST(Cell, HoldsANumberInFull) {
  for (const double value : {0.1, 1.0 / 3, -2e-300, 12345678.9, 0.0}) EXPECT_EQ(number(in_full(value)), value);
  EXPECT_EQ(in_full(0.1), "0.1");
}
TEST(Cell, RejectsNonNumbers) {
  for (const char* cell : {"", "x", "1.5x", "1 2"}) EXPECT_THROW((void)number(cell), hmps::InputError) << cell;
}

}  // namespace table_test
