// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/text_file.hpp"
#include "hmps/core/error.hpp"
#include "hmps/motion/keyframes.hpp"

namespace hmps::inline HMPS_ABI {

/// A table of numbers with named columns, as read from a CSV file.
struct Table {
  std::string source;              ///< file name, for error messages
  std::vector<std::string> names;  ///< column names
  std::vector<double> values;      ///< values in row-major order
  std::vector<std::size_t> lines;  ///< line number in the file (from 1) of each row

  [[nodiscard]] std::size_t rows() const { return lines.size(); }
  [[nodiscard]] std::size_t columns() const { return names.size(); }
  /// The number in a cell, counted from 0. Throws `InputError` for a cell that does not exist.
  [[nodiscard]] double operator()(std::size_t row, std::size_t column) const {
    detail::require(row < rows() && column < columns(), "hmps: row ", row, ", column ", column,
                    " is out of range: ", source, " has ", rows(), " rows and ", columns(),
                    " columns (indices start at 0)");
    return values[row * names.size() + column];
  }

  [[nodiscard]] bool has(std::string_view name) const {
    return std::find(names.begin(), names.end(), name) != names.end();
  }

  /// The index of the column `name`. Throws `InputError` if there is none, with a list of the first twenty columns.
  [[nodiscard]] std::size_t column(std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      constexpr std::size_t most = 20;
      std::string all;
      for (std::size_t k = 0; k < std::min(names.size(), most); ++k)
        all += (k == 0 ? "" : ", ") + detail::printable(names[k]);
      if (names.size() > most) all += detail::message(" and ", names.size() - most, " more");
      detail::throw_input_error({"hmps: ", source, " has no column '", name, "'; it has ", all});
    }
    return static_cast<std::size_t>(found - names.begin());
  }
};

namespace detail {

/// Calls `use(cell)` for each cell of a line, trimmed.
template <class Use>
void for_each_cell(std::string_view line, Use&& use) {
  for (;;) {
    const auto comma = line.find(',');
    use(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace detail

/// Parses comma-separated numbers: a header line of distinct column names, then one row per line with one finite number
/// per column, with zero for one too small for a double. Ignores blank lines, text after `#` and blanks around
/// cells; lines may end in CR LF. `source` names the text in messages. Throws `InputError` with source, line and column
/// at the first cell that is not a finite number, and for rows with too few or too many cells, empty or repeated column
/// names, columns separated by something other than commas, text in UTF-16 or with a line that ends in CR alone, and
/// text without a header.
[[nodiscard]] inline Table parse_csv(std::string_view text, std::string source = "CSV") {
  Table table;
  table.source = std::move(source);
  std::unordered_set<std::string_view> named;  // into `text`
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  detail::require(!text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF"), "hmps: ", table.source,
                  " is a text in UTF-16; save it in UTF-8 or ASCII");
  for (std::size_t at = text.find('\r'); at < text.size(); at = text.find('\r', at)) {
    at = text.find_first_not_of('\r', at);
    detail::require(at >= text.size() || text[at] == '\n', "hmps: ", table.source,
                    " has a line that ends in CR alone; save it with line ends of LF or CR LF");
  }
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = detail::take_line(text);
    line = detail::trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const auto fail = [&](const auto&... parts) {
      throw InputError(detail::message("hmps: ", table.source, ", line ", line_number, ": ", parts...));
    };
    if (table.names.empty()) {
      detail::for_each_cell(line, [&](std::string_view name) {
        if (name.empty()) fail("column ", table.names.size() + 1, " has no name; the first line names every column");
        if (!named.insert(name).second)
          fail("the column '", detail::printable(name), "' is named twice; name each column once");
        table.names.emplace_back(name);
      });
      if (std::all_of(table.names.begin(), table.names.end(), [](const std::string& name) {
            double number{};
            return detail::parse_number(std::string_view(name), number);
          }))
        fail("the first line, '", detail::printable(line), "', holds only numbers; it must name the columns");
      if (table.names.size() == 1 && line.find_first_of(";\t") != std::string_view::npos)
        fail("'", detail::printable(line),
             "' is the name of one column; separate columns by commas, and use points as "
             "decimal marks");
      continue;
    }
    std::size_t cell_number = 0;
    detail::for_each_cell(line, [&](std::string_view cell) {
      if (cell_number < table.names.size()) {
        double number{};
        if (!detail::parse_number(cell, number) || !detail::is_finite(number))
          fail("'", detail::printable(cell), "' in column '", detail::printable(table.names[cell_number]),
               "' is not a finite number");
        table.values.push_back(number);
      }
      ++cell_number;
    });
    if (cell_number != table.names.size())
      fail("the row has ", cell_number, " cells but the header names ", table.names.size(),
           " columns; separate cells by commas");
    table.lines.push_back(line_number);
  }
  detail::require(!table.names.empty(), "hmps: ", table.source, " is empty; its first line must name the columns");
  return table;
}

/// Reads the file `path` with `parse_csv`. Also throws `InputError` if the file cannot be read.
[[nodiscard]] inline Table read_csv(const std::string& path) { return parse_csv(detail::read_text(path), path); }

/// Makes keyframes from the columns `names` of a table, with the times in its column `time` (s). Multiplies the values
/// by `scale` (1e-3 for millimetres, pi/180 for degrees). Throws `InputError`, with the line, for a missing column, an
/// empty table, a scale of zero, and times that do not increase.
template <std::size_t N>
[[nodiscard]] Keyframes<static_cast<int>(N)> keyframes(const Table& table, const std::array<std::string_view, N>& names,
                                                       double scale = 1, std::string_view time = "t") {
  detail::require(detail::is_finite(scale) && scale != 0, "hmps: the keyframes of ", table.source,
                  " are to be scaled by ", scale, "; give a factor that is not zero, such as 1e-3 for millimetres");
  const std::size_t clock = table.column(time);
  std::array<std::size_t, N> columns{};
  for (std::size_t c = 0; c < N; ++c) {
    columns[c] = table.column(names[c]);
    detail::require(columns[c] != clock, "hmps: the column '", time, "' of ", table.source,
                    " is to be both time and value of keyframes; name another column for one of them");
  }
  detail::require(table.rows() > 0, "hmps: ", table.source, " has a header but no row; give at least one keyframe");
  std::vector<Keyframe<static_cast<int>(N)>> keys(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    keys[row].time = table(row, clock);
    detail::require(row == 0 || keys[row - 1].time < keys[row].time, "hmps: ", table.source, ", line ",
                    table.lines[row], ": the time ", keys[row].time, " s does not follow ",
                    row == 0 ? 0.0 : keys[row - 1].time, " s; sort the rows and give each time once");
    for (std::size_t c = 0; c < N; ++c) {
      if constexpr (N == 1)
        keys[row].value = scale * table(row, columns[c]);
      else
        keys[row].value[static_cast<Eigen::Index>(c)] = scale * table(row, columns[c]);
    }
  }
  return Keyframes<static_cast<int>(N)>(std::move(keys));
}

/// The column `name` of a table as a track of one number; see `keyframes`.
[[nodiscard]] inline Track track(const Table& table, std::string_view name, double scale = 1,
                                 std::string_view time = "t") {
  return keyframes<1>(table, {name}, scale, time);
}

}  // namespace hmps::inline HMPS_ABI
