// SPDX-License-Identifier: MIT
#include "hmps/shapes/stl_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace stl_file_test {

using namespace hmps::detail;

/// A binary file of `triangles` zeros that announces `count`.
std::string binary(std::uint32_t count, std::size_t triangles, std::string name = "binary") {
  name.resize(84 + 50 * triangles, '\0');
  std::memcpy(name.data() + 80, &count, sizeof count);
  return name;
}

TEST(StlFile, DistinguishesAsciiFromBinary) {
  for (const char* text : {"solid", "solid\n", "\n\t solid a", "\xEF\xBB\xBFsolid\r\n", "SOLID a"})
    EXPECT_TRUE(is_ascii_stl(text)) << text;
  for (const char* text : {"", "\n", "solids", "PK", "facet"}) EXPECT_FALSE(is_ascii_stl(text)) << text;
  std::string filled = "solid with a name";
  filled.resize(80, ' ');
  EXPECT_FALSE(is_ascii_stl(binary(2, 2, filled)));
  EXPECT_FALSE(is_ascii_stl(binary(2, 2, filled) + "tail"));
  EXPECT_TRUE(is_ascii_stl(filled + std::string(300, ' ')));
}

TEST(StlFile, CountsTrianglesOfBinaryFiles) {
  EXPECT_EQ(count_binary_stl(binary(2, 2), "a.stl"), 2u);
  EXPECT_EQ(count_binary_stl(binary(2, 9), "a.stl"), 2u);  // zeros at the end
  std::string damaged = binary(2, 3);
  damaged.back() = 1;
  EXPECT_THROW((void)count_binary_stl(damaged, "a.stl"), hmps::InputError);
  EXPECT_THROW((void)count_binary_stl(binary(3, 2), "a.stl"), hmps::InputError);
  EXPECT_THROW((void)count_binary_stl(binary(0xffffffffu, 2), "a.stl"), hmps::InputError);
}

}  // namespace stl_file_test
