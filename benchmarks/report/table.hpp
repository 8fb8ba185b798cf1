// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace report {

using Cells = std::vector<std::string>;

/// A table, and the expectations that it does not meet.
struct Table {
  std::string name = "";  ///< of its file and of its section
  Cells header;
  std::vector<Cells> rows = {};
  std::vector<std::string> broken = {};

  /// Records `what` as not met unless `holds`.
  void check(bool holds, const std::string& what);
  /// The table in Markdown.
  [[nodiscard]] std::string markdown() const;
  /// The table as comma-separated values, with quotes around cells that need them.
  [[nodiscard]] std::string csv() const;
};

/// The text of a cell that leaves the next `columns` cells empty.
[[nodiscard]] std::string spanning(std::string text, std::size_t columns);

/// `cells` as a line of comma-separated values, without quotes.
[[nodiscard]] std::string csv_line(const Cells& cells);
/// `text` in quotes; quotes inside it are doubled.
[[nodiscard]] std::string in_quotes(std::string_view text);
/// A number with the fewest digits that read back as the same number.
[[nodiscard]] std::string in_full(double value);

/// The cells of comma-separated values, line by line, without their quotes.
[[nodiscard]] std::vector<Cells> read_csv(std::string_view text);
/// The number in a cell. Throws `InputError` if the cell is not a number.
[[nodiscard]] double number(const std::string& cell);

}  // namespace report
