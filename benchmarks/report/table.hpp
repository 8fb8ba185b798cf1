// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace report {

using Cells = std::vector<std::string>;

/// A table, and what it should show but does not.
struct Table {
  std::string name = "";  ///< of its file and of its section
  Cells header;
  std::vector<Cells> rows = {};
  std::vector<std::string> broken = {};

  /// Notes `what` as broken unless it holds.
  void check(bool holds, const std::string& what);
  /// The table in Markdown.
  [[nodiscard]] std::string markdown() const;
  /// The table as comma-separated values, cells quoted where they need it.
  [[nodiscard]] std::string csv() const;
};

/// The text of a cell that leaves the `columns` cells behind it empty.
[[nodiscard]] std::string spanning(std::string text, std::size_t columns);

/// `cells` as a line of comma-separated values, as they are.
[[nodiscard]] std::string csv_line(const Cells& cells);
/// `text` in quotes, those in it doubled.
[[nodiscard]] std::string in_quotes(std::string_view text);
/// A number in the fewest digits that read back as the same.
[[nodiscard]] std::string in_full(double value);

/// The cells of comma-separated values, line by line, without their quotes.
[[nodiscard]] std::vector<Cells> read_csv(std::string_view text);
/// The number in a cell. Throws `InputError` where there is none.
[[nodiscard]] double number(const std::string& cell);

}  // namespace report
