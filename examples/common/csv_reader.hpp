// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "files.hpp"

namespace examples {

/// A table of numbers: `rows[r][c]` stands in column `header[c]`.
struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<double>> rows;
};

namespace detail {

[[nodiscard]] inline std::vector<std::string_view> split(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string_view> cells;
  for (std::size_t comma = 0; comma != std::string_view::npos; line.remove_prefix(std::min(comma + 1, line.size()))) {
    comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t')) cell.remove_suffix(1);
    cells.push_back(cell);
    if (comma == std::string_view::npos) break;
  }
  return cells;
}

}  // namespace detail

/// Reads a table of finite numbers with one header line from `text`, which is called `name` in
/// messages. Lines that are empty or begin with # are skipped. Throws `InputError` with the line
/// number at a cell that is no finite number and at a row of the wrong length.
[[nodiscard]] inline CsvTable parse_csv(std::string_view text, std::string_view name) {
  CsvTable table;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.find_first_not_of(" \t\r") == std::string_view::npos || line.front() == '#') continue;
    const auto cells = detail::split(line);
    if (table.header.empty()) {
      table.header.assign(cells.begin(), cells.end());
      continue;
    }
    hmps::require(cells.size() == table.header.size(), name, " line ", number, " has ", cells.size(),
                  " cells, but the header names ", table.header.size(), " columns");
    std::vector<double>& row = table.rows.emplace_back(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto [last, problem] = std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), row[c]);
      hmps::require(problem == std::errc() && last == cells[c].data() + cells[c].size() && std::isfinite(row[c]), name,
                    " line ", number, ", column ", table.header[c], ": '", cells[c], "' is not a finite number");
    }
  }
  hmps::require(!table.header.empty(), name, " is empty; a line with the names of the columns must come first");
  return table;
}

}  // namespace examples
