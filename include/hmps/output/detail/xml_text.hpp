// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The number of bytes of the character in UTF-8 with which `text` begins; 0 if it begins with none, or with one that
/// XML cannot hold: a control character, a surrogate, U+FFFE or U+FFFF.
[[nodiscard]] inline std::size_t xml_character(std::string_view text) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80) return first < 0x20 ? 0 : 1;
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc0 || first > 0xf4) return 0;
  unsigned code = first & (0x7fU >> size);
  for (std::size_t k = 1; k < size; ++k) {
    if (byte(k) >> 6 != 2) return 0;
    code = code << 6 | (byte(k) & 0x3fU);
  }
  const unsigned least = size == 2 ? 0x80U : size == 3 ? 0x800U : 0x10000U;  // less has a shorter form
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < least || code > 0x10ffff || surrogate || code == 0xfffe || code == 0xffff ? 0 : size;
}

/// `text` with a question mark for each byte that XML cannot hold, which includes all that is not UTF-8.
[[nodiscard]] inline std::string xml_characters(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = xml_character(text);
    result += size > 0 ? text.substr(0, size) : "?";
    text.remove_prefix(size > 0 ? size : 1);
  }
  return result;
}

/// `text` escaped for XML between quotes. Bytes that XML cannot hold become question marks.
[[nodiscard]] inline std::string xml(std::string_view text) {
  std::string result;
  for (const char c : xml_characters(text)) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

/// The shortest digits that read back as the same number, in any locale.
[[nodiscard]] inline std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace hmps::inline HMPS_ABI::detail
