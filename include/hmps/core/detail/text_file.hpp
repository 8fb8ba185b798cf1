// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

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

/// Parses all of `text` as a number, independently of the locale. Returns false if it is not one.
template <class T>
[[nodiscard]] bool parse_number(std::string_view text, T& number) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size();
}

}  // namespace hmps::inline HMPS_ABI::detail
