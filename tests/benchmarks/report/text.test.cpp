// SPDX-License-Identifier: MIT
#include "report/text.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace text_test {

using namespace report;

TEST(Text, FormatsNumbers) {
  EXPECT_EQ(digits(0.021049), "0.021");
  EXPECT_EQ(digits(1000), "1e+03");
  EXPECT_EQ(digits(1.5, 1), "2");
  EXPECT_EQ(places(0.021049), "0.021");
  EXPECT_EQ(places(-1.25, 1), "-1.2");
  EXPECT_EQ(rounded(1.2345), "1.23");
  EXPECT_EQ(rounded(0.0123456), "0.0123");
  EXPECT_EQ(rounded(123456), "123000");
  EXPECT_EQ(rounded(-12.0), "-12");
  EXPECT_EQ(rounded(0), "0");
  EXPECT_EQ(counted(15.8e9), "15.8 G");
  EXPECT_EQ(counted(3.3e6), "3.3 M");
  EXPECT_EQ(counted(120e3), "120 k");
  EXPECT_EQ(counted(12), "12");
  EXPECT_EQ(bytes(7.61e6), "7.61 MB");
  EXPECT_EQ(bytes(12e3), "12 kB");
}

TEST(Text, KeepsAllWordsInLinesOf120) {
  std::string text;
  for (int k = 0; k < 200; ++k) text += "word" + std::to_string(k) + (k % 7 == 0 ? "\n  " : " ");
  const std::string lines = wrapped(text, "  ");
  std::istringstream one(text), other(lines), line_by_line(lines);
  for (std::string a, b; one >> a;) {
    ASSERT_TRUE(other >> b);
    EXPECT_EQ(a, b);
  }
  std::string line;
  for (int k = 0; std::getline(line_by_line, line); ++k) {
    EXPECT_LE(line.size(), 120U);
    EXPECT_EQ(line.substr(0, 2) == "  ", k > 0) << line;
  }
  EXPECT_EQ(lines.back(), '\n');
}
TEST(Text, BreaksAfterTheLastWordThatFits) {
  const std::string full(60, 'a'), fits(59, 'b'), not_any_more(60, 'b');
  EXPECT_EQ(wrapped(full + ' ' + fits), full + ' ' + fits + '\n');
  EXPECT_EQ(wrapped(full + ' ' + not_any_more), full + '\n' + not_any_more + '\n');
}

TEST(Text, ListsSentences) {
  EXPECT_EQ(bullets({"one", "two"}), "- one\n- two\n");
  EXPECT_EQ(bullets({}), "- nothing\n");
  EXPECT_EQ(bullets({std::string(118, 'a') + " b"}), "- " + std::string(118, 'a') + "\n  b\n");
}

}  // namespace text_test
