// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Limit for devices and pipes, which may never end: 1 GiB.
inline constexpr std::size_t most_streamed_bytes = std::size_t{1} << 30;

/// Reads the file `path`. Throws `InputError` if it cannot be read, or if it is not a regular file and holds more than
/// `most` bytes.
[[nodiscard]] inline std::string read_text(const std::string& path, std::size_t most = most_streamed_bytes) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  require(file.good(), "hmps: cannot open ", path, "; check that the file exists and may be read");
  require(!std::filesystem::is_directory(path, ignored), "hmps: ", path, " is a folder; give a file");
  const bool ends = std::filesystem::is_regular_file(path, ignored);
  // Read in pieces instead of by the file's size, so that pipes can be read too.
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::string text;
  while (file) {
    const std::size_t size = text.size();
    require(ends || size <= most, "hmps: ", path, " is not a regular file and has not ended after ", most,
            " bytes; write its output to a file, or check the name");
    text.resize(size + piece);
    file.read(text.data() + size, static_cast<std::streamsize>(piece));
    text.resize(size + static_cast<std::size_t>(file.gcount()));
  }
  require(file.eof() && !file.bad(), "hmps: ", path, " cannot be read to its end; check the file and its disk");
  return text;
}

/// A piece of a file for a message, cut after 40 characters; unprintable bytes become hexadecimal escapes.
[[nodiscard]] inline std::string printable(std::string_view text) {
  constexpr std::size_t most = 40;
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result;
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f)
      result += c;
    else
      result.append("\\x").append({digits[byte >> 4], digits[byte & 15]});
  }
  if (text.size() > most) result += "...";
  return result;
}

/// `text` without leading and trailing blanks, including carriage returns.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Removes and returns the first line of `text`, without the line break.
[[nodiscard]] inline std::string_view take_line(std::string_view& text) {
  const auto end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

/// Removes and returns the first word of `text`; empty at the end.
[[nodiscard]] inline std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r"));
  text.remove_prefix(word.size());
  return word;
}

/// Whether the decimal number `text`, which is out of the range of a type, is too small for it and not too large.
[[nodiscard]] inline bool is_below_range(std::string_view text) {
  const auto mark = text.find_first_of("eE");
  const std::string_view digits = text.substr(0, mark);
  double exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view rest = text.substr(mark + 1);
    if (rest.starts_with('+')) rest.remove_prefix(1);
    if (std::from_chars(rest.data(), rest.data() + rest.size(), exponent).ec != std::errc())
      return rest.starts_with('-');
  }
  const auto first = digits.find_first_of("123456789"), point = std::min(digits.find('.'), digits.size());
  return exponent + static_cast<double>(point) - static_cast<double>(first) < 0;
}

/// Parses all of `text` as a number, independently of the locale. Returns false if it is not one. A number too small
/// for `T` is zero.
template <class T>
[[nodiscard]] bool parse_number(std::string_view text, T& number) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (stop != text.data() + text.size()) return false;
  if constexpr (std::is_floating_point_v<T>)
    if (error == std::errc::result_out_of_range && is_below_range(text)) {
      number = 0;
      return true;
    }
  return error == std::errc();
}

}  // namespace hmps::inline HMPS_ABI::detail
