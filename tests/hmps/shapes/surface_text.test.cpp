// SPDX-License-Identifier: MIT
#include "hmps/shapes/surface_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace surface_text_test {

using namespace hmps::detail;

TEST(SurfaceText, CleansMarksAndEnds) {
  std::string text =
      "\xEF\xBB\xBF"
      "v 1\rv 2\r";
  clean_text(text, "a.obj");
  EXPECT_EQ(text, "v 1\nv 2\n");
  text = "v 1\r\nv 2\r\n";
  clean_text(text, "a.obj");
  EXPECT_EQ(text, "v 1\r\nv 2\r\n");
  text = "\xFE\xFFv";
  EXPECT_THROW(clean_text(text, "a.obj"), hmps::InputError);
}

TEST(SurfaceText, TakesPointsOfFiniteNumbers) {
  const std::string source = "a.obj";
  std::string_view line = " 1 -2e3\t3 4";
  EXPECT_EQ(take_point<double>(line, 1e-3, {source, 1}), (hmps::Vector<double, 3>(1e-3, -2, 3e-3)));
  EXPECT_EQ(take_word(line), "4");
  line = "1 nan 3";
  EXPECT_THROW((void)take_point<double>(line, 1, {source, 1}), hmps::InputError);
}

}  // namespace surface_text_test
