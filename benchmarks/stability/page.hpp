// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "common/csv_writer.hpp"
#include "common/files.hpp"

namespace stability {

namespace fs = std::filesystem;

/// A number in three digits, for people.
[[nodiscard]] inline std::string digits(double value, int count = 3) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.*g", count, value);
  return text;
}
/// A number with so many places behind the point.
[[nodiscard]] inline std::string places(double value, int count = 3) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", count, value);
  return text;
}

/// What one group of problems gave: a table, and the properties that must hold and do not.
struct Table {
  std::string name;  ///< of the CSV file and of the marks in the page
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows = {};
  std::vector<std::string> broken = {};

  void check(bool holds, const std::string& what) {
    if (!holds) broken.push_back(name + ": " + what);
  }
  [[nodiscard]] std::string csv() const {
    std::string text = line(header, "", ",", "\n", true);
    for (const auto& row : rows) text += line(row, "", ",", "\n", true);
    return text;
  }
  [[nodiscard]] std::string markdown() const {
    std::string text = line(header, "| ", " | ", " |\n", false) + "|";
    for (std::size_t c = 0; c < header.size(); ++c) text += "---|";
    text += "\n";
    for (const auto& row : rows) text += line(row, "| ", " | ", " |\n", false);
    return text;
  }

 private:
  static std::string line(const std::vector<std::string>& cells, const char* begin, const char* between,
                          const char* end, bool quoted) {
    std::string text = begin;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (c > 0) text += between;
      const bool quote = quoted && cells[c].find_first_of(",\"") != std::string::npos;
      text += quote ? '"' + cells[c] + '"' : cells[c];
    }
    return text + end;
  }
};

/// Puts `content` between the lines `<!-- begin NAME -->` and `<!-- end NAME -->` of `page`. Throws `InputError` where
/// they are missing.
inline void replace_section(std::string& page, const std::string& name, const std::string& content) {
  const std::string begin = "<!-- begin " + name + " -->\n", end = "<!-- end " + name + " -->";
  const std::size_t from = page.find(begin), to = page.find(end);
  hmps::require(from != std::string::npos && to != std::string::npos && from < to, "the page has no section ", name);
  page.replace(from + begin.size(), to - from - begin.size(), content);
}

}  // namespace stability
