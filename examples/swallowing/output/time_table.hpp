// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../../common/csv_writer.hpp"
#include "../../common/error.hpp"
#include "output/digest.hpp"

namespace swallowing {

/// How far a table had come when a checkpoint was written: its first bytes, and their digest.
struct TableMark {
  std::uint64_t bytes = 0, digest = 0;
};

using TableRows = std::vector<std::vector<double>>;

/// The rows of numbers in `text`, whose first line is `header`; none if it is empty. Ignores a last line that was cut
/// short because the program that wrote it ended. Throws `InputError`, naming `path`, if it is not such a table.
[[nodiscard]] inline TableRows parse_table(std::string_view text, std::string_view header,
                                           const std::filesystem::path& path) {
  TableRows rows;
  text = text.substr(0, text.rfind('\n') == std::string_view::npos ? 0 : text.rfind('\n') + 1);
  if (text.empty()) return rows;
  examples::require(text.substr(0, text.find('\n')) == header, path.string(), " is not a ", path.filename().string(),
                    " of this program; remove it or choose another folder with --out");
  const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
  // A diverging run may leave inf and nan in its last lines, which are worth reading too.
  for (std::size_t begin = text.find('\n') + 1; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    std::vector<double> row;
    bool whole = true;
    for (const char *cell = text.data() + begin, *line_end = text.data() + end; whole && cell <= line_end; ++cell) {
      double value = 0;
      const auto [last, problem] = std::from_chars(cell, line_end, value);
      whole = problem == std::errc() && (last == line_end || *last == ',');
      row.push_back(value);
      cell = last;
    }
    examples::require(whole && row.size() == columns, path.string(), " has a malformed line after ", rows.size() + 1,
                      " lines; remove the file or choose another folder with --out");
    rows.push_back(std::move(row));
    begin = end + 1;
  }
  return rows;
}

/// The rows of the table at `path`; none if there is no file. Throws as `parse_table` does.
[[nodiscard]] inline TableRows read_table(const std::filesystem::path& path, std::string_view header) {
  if (!std::filesystem::exists(path)) return {};
  return parse_table(examples::read_file(path), header, path);
}

/// A table of a case that grows row by row. It can be read at any moment while the case runs.
class TimeTable {
 public:
  /// Begins the table; or continues it after the bytes of `resumed`, the mark in the checkpoint from which the run is
  /// resumed: later rows are dropped, because the run writes them again. Throws `InputError` if the file has lost or
  /// changed anything before the mark, which would not be written again.
  TimeTable(const std::filesystem::path& path, std::string_view header, const std::optional<TableMark>& resumed = {})
      : rows_(resumed ? kept(path, header, *resumed) : TableRows()),
        mark_(resumed.value_or(TableMark())),
        file_(path, header, resumed.has_value()) {
    if (!resumed) count(std::string(header) + '\n');
  }

  void add(std::span<const double> row) {
    rows_.emplace_back(row.begin(), row.end());
    count(examples::csv_line(row));
    file_.add(row);
  }
  /// All rows since the start of the case, including those from before it was resumed.
  [[nodiscard]] const TableRows& rows() const { return rows_; }
  /// Writes all rows to the disk. Only a checkpoint that is written afterwards may hold the returned mark.
  [[nodiscard]] TableMark flush_to_disk() {
    file_.flush_to_disk();
    return mark_;
  }

 private:
  void count(const std::string& text) {
    mark_.bytes += text.size();
    digest_.add(text);
    mark_.digest = digest_.value();
  }
  [[nodiscard]] TableRows kept(const std::filesystem::path& path, std::string_view header, const TableMark& mark) {
    const std::string text = std::filesystem::exists(path) ? examples::read_file(path) : std::string();
    examples::require(text.size() >= mark.bytes, path.string(), " has ", text.size(), " of the ", mark.bytes,
                      " bytes that were written before the checkpoint, and the rest would not be rewritten; put the "
                      "whole file back, or start anew without --resume");
    const std::string_view part = std::string_view(text).substr(0, mark.bytes);
    digest_.add(part);
    examples::require(digest_.value() == mark.digest, path.string(),
                      " is no longer what was written before the checkpoint; put that file back, or start anew without "
                      "--resume");
    if (text.size() > mark.bytes) examples::write_atomically(path, part);
    return parse_table(part, header, path);
  }

  Digest digest_;
  TableRows rows_;
  TableMark mark_;
  examples::CsvWriter file_;
};

}  // namespace swallowing
