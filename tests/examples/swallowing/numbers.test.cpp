// SPDX-License-Identifier: MIT
#include "../common/numbers.hpp"

#include <gtest/gtest.h>

#include <string>

namespace numbers_test {

using examples::decimal;

TEST(Numbers, AreReadCompletely) {
  EXPECT_EQ(decimal<double>("1.5"), 1.5);
  EXPECT_EQ(decimal<double>("+.5"), 0.5);
  EXPECT_EQ(decimal<double>("-2e-3"), -2e-3);
  EXPECT_EQ(decimal<double>("010"), 10);
  EXPECT_EQ(decimal<int>("010"), 10);
  EXPECT_EQ(decimal<int>("+3"), 3);
  EXPECT_EQ(decimal<long>("-3"), -3);
}

TEST(Numbers, RejectOtherNotationsAndTrailingText) {
  for (const std::string text :
       {"",      "+",    "-",   ".",   "e5",  "0x1", "0X1p3",     "1 ",  " 1",    "1,5",    "1_000",
        "1'000", "1.5x", "--1", "+-1", "++1", "inf", "-infinity", "nan", "1e400", "1e-400", "1\n"})
    EXPECT_FALSE(decimal<double>(text)) << '"' << text << '"';
  EXPECT_FALSE(decimal<double>(std::string("1\0", 2)));
  for (const std::string text : {"1.0", "1e3", "0b1", "0x1", "9999999999", ""})
    EXPECT_FALSE(decimal<int>(text)) << '"' << text << '"';
}

}  // namespace numbers_test
