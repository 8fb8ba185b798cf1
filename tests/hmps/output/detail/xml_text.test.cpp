// SPDX-License-Identifier: MIT
#include "hmps/output/detail/xml_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace xml_text_test {

using namespace hmps;

TEST(XmlText, KeepsEveryCharacterOfXml) {
  for (const std::string text : {"J", "press\u00e3o", "\u820c", "\ud7ff\ue000\ufffd", "\U00010000\U0010ffff", "\x7f '"})
    EXPECT_EQ(detail::xml(text), text);
  EXPECT_EQ(detail::xml("<a&\"b\">"), "&lt;a&amp;&quot;b&quot;&gt;");
}

TEST(XmlText, ReplacesEveryOtherByte) {
  EXPECT_EQ(detail::xml("press\xe3o"), "press?o");                         // Latin-1
  EXPECT_EQ(detail::xml(std::string("a\n\t\0b", 5)), "a???b");             // control characters
  EXPECT_EQ(detail::xml("\xef\xbf\xbe\xef\xbf\xbf"), "??????");            // U+FFFE and U+FFFF
  EXPECT_EQ(detail::xml("\xed\xa0\x80\xed\xbf\xbf"), "??????");            // surrogates
  EXPECT_EQ(detail::xml("\xc0\xaf\xc1\xbf\xe0\x9f\xbf"), "???????");       // longer than they need be
  EXPECT_EQ(detail::xml("\xf0\x8f\xbf\xbf"), "????");                      // the same
  EXPECT_EQ(detail::xml("\xf4\x90\x80\x80\xf5\x80\x80\x80"), "????????");  // beyond Unicode
  EXPECT_EQ(detail::xml("\x80\xbf\xfe\xff"), "????");                      // begin no character
  EXPECT_EQ(detail::xml("a\xc3"), "a?");                                   // cut short
  EXPECT_EQ(detail::xml("\xe8\x88<\xe8\x88\x8c"), "??&lt;\xe8\x88\x8c");
}

}  // namespace xml_text_test
