// SPDX-License-Identifier: MIT
#include "report/page.hpp"

#include <gtest/gtest.h>

#include <string>

#include "hmps/core/error.hpp"

namespace page_test {

using namespace report;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Page, ReplacesItsOwnSectionOnly) {
  const std::string one = with_section("# Page\n", "a", "first\n");
  const std::string two = with_section(one, "b", "second\n");
  const std::string three = with_section(two, "a", "third\n");
  EXPECT_TRUE(has(two, "first") && has(two, "second"));
  EXPECT_TRUE(has(three, "third") && has(three, "second") && has(three, "# Page"));
  EXPECT_FALSE(has(three, "first"));
  EXPECT_LT(three.find("third"), three.find("second"));
  EXPECT_EQ(with_section(three, "a", "third\n"), three);
}
TEST(Page, KeepsWhatIsWrittenBetweenSections) {
  const std::string page = "# Title\n\nBy hand.\n\n<!-- begin a -->\nold\n<!-- end a -->\n\nBy hand too.\n";
  EXPECT_EQ(with_section(page, "a", "new\n"),
            "# Title\n\nBy hand.\n\n<!-- begin a -->\nnew\n<!-- end a -->\n\nBy hand too.\n");
}
TEST(Page, RefusesASectionWithoutEnd) {
  EXPECT_THROW((void)with_section("<!-- begin a -->\n", "a", "x\n"), hmps::InputError);
  EXPECT_THROW((void)with_section("<!-- end a -->\n<!-- begin a -->\n", "a", "x\n"), hmps::InputError);
}
TEST(Page, BeginsWithItsOpening) {
  EXPECT_EQ(with_opening("", "# New\n"), "# New\n");
  EXPECT_EQ(with_opening("# Old\n\n<!-- begin a -->\n<!-- end a -->\n", "# New\n"),
            "# New\n\n<!-- begin a -->\n<!-- end a -->\n");
}

}  // namespace page_test
