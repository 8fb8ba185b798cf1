// SPDX-License-Identifier: MIT
#include "hmps/shapes/stl_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/message_of.hpp"

namespace stl_file_test {

using hmps_test::message_of;
using namespace hmps::detail;

/// The corners in an ASCII file, three for each triangle.
std::vector<hmps::Vector<double, 3>> corners_in(const std::string& text, bool closed = false) {
  hmps::SurfaceMesh<double> mesh;
  mesh.source = "a.stl";
  const hmps::SurfaceFileSettings settings{.closed = closed};
  AsciiStlParser<double>(mesh, settings)(text);
  return mesh.vertices;
}

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

const std::string one_facet =
    "facet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 4 5 6\nvertex 7 8 9.5\nendloop\nendfacet\n";

TEST(StlFile, ReadsWordsWhateverTheLinesOfAnAsciiFile) {
  const std::string usual = "solid a\n" + one_facet + one_facet + "endsolid a\n";
  const auto expected = corners_in(usual);
  ASSERT_EQ(expected.size(), 6U);
  EXPECT_EQ(expected[2], (hmps::Vector<double, 3>(7, 8, 9.5)));
  const auto with_joined_lines = [](std::string text, const std::string& word, char by) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
      for (std::size_t k = at; k < at + word.size(); ++k)
        if (text[k] == '\n') text[k] = by;
    return text;
  };
  for (const std::string& text :
       {with_joined_lines(usual, "\n", ' '), with_joined_lines(usual, "loop\n", '\t'),
        with_joined_lines(usual, "endfacet\n", ' '), with_joined_lines(usual, "solid a\n", ' '),
        "solid a\n" + one_facet + "endsolid a solid b " + one_facet + "endsolid b",
        "solid facet normal\n" + one_facet + one_facet + "endsolid facet outer vertex\n",
        "solid facet vertex end\n" + one_facet + one_facet + "endsolid a facet\n",
        "solid facet normal 3mm plate\n" + one_facet + one_facet + "endsolid a facet normal 3",
        "solid facet outer loop\n" + one_facet + one_facet + "endsolid\n",
        "solid a facet\n" + one_facet.substr(6) + one_facet + "endsolid a\n",
        "solid a\nfacet normal 0,0,1\n" + one_facet.substr(19) + one_facet + "endsolid a\n",
        "solid a facet normal -nan(ind) 0 0 " + one_facet.substr(19) + one_facet + "endsolid a\n",
        "solid\n" + one_facet + "facet normal nan -nan(ind) 1.#QNAN\n" + one_facet.substr(19) + "endsolid\n"})
    EXPECT_EQ(corners_in(text), expected) << text;
  std::string one_number_a_line = usual;
  for (std::size_t at = usual.find('\n'); at < usual.rfind("endsolid"); ++at)
    if (one_number_a_line[at] == ' ') one_number_a_line[at] = '\n';
  EXPECT_EQ(corners_in(one_number_a_line), expected);
}

// What does not belong to an ASCII file used to be dropped with the rest of its line.
TEST(StlFile, NamesTheLineOfWhatDoesNotBelongToAnAsciiFile) {
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string text = "solid a\n" + one_facet + "endsolid a\n";
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [text, part] :
       {std::pair{replaced("4 5 6", "4 5 6 7"), "line 5: the number '7' does not belong there"},
        std::pair{replaced("4 5 6", "4 5, 6"), "line 5: '5,' is not a finite number"},
        std::pair{replaced("4 5 6", "4 5"), "line 5: a vertex has only 2 coordinates"},
        std::pair{replaced("4 5 6", "4 nan 6"), "line 5: 'nan' is not a finite number"},
        std::pair{replaced("outer loop", "outer"), "'outer' is not followed by 'loop'"},
        std::pair{replaced("outer loop", "outer loop 1"), "line 3: the number '1' does not belong there"},
        std::pair{replaced("endloop", "endloop vertex 1 1 1"), "line 7: a facet has more than three vertices"},
        std::pair{replaced("endfacet", "endfacet red"), "line 8: 'red' is not a keyword"},
        std::pair{replaced("endfacet", "endfacet vertex 1 1 1"), "line 8: 'vertex' outside of a facet"},
        std::pair{"solid a " + one_facet + "endsolid a " + one_facet, "line 14: the file ends without 'endsolid'"}}) {
    const std::string message = message_of([&, &bytes = text] { (void)corners_in(bytes); });
    EXPECT_NE(message.find(part), std::string::npos) << message << "\n  lacks: " << part;
  }
}

}  // namespace stl_file_test
