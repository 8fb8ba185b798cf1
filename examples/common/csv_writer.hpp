// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "error.hpp"
#include "files.hpp"

namespace examples {

/// The shortest decimal text that reads back as the same number. Independent of the locale.
[[nodiscard]] inline std::string to_text(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof(digits), value).ptr;
  return {digits, end};
}

/// `values` separated by commas and ended by a newline.
[[nodiscard]] inline std::string csv_line(std::span<const double> values) {
  std::string line;
  for (const double value : values) (line += to_text(value)) += ',';
  line.empty() ? line.push_back('\n') : void(line.back() = '\n');
  return line;
}

/// A table of numbers in a text file that can be read at any moment while it grows: each row is passed to the system
/// as a whole.
class CsvWriter {
 public:
  /// Opens the table at `path`. With `keep`, rows are appended to the file; otherwise the file is replaced and starts
  /// with the line `header`.
  CsvWriter(const fs::path& path, std::string_view header, bool keep = false) : path_(path) {
    file_ = std::fopen(path.c_str(), keep ? "ab" : "wb");
    require(file_ != nullptr, "cannot write ", path.string(), ": ", std::strerror(errno));
    if (!keep) put(std::string(header) + '\n');
    flush_folder(path.parent_path());
  }
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;
  ~CsvWriter() { std::fclose(file_); }

  void add(std::span<const double> row) { put(csv_line(row)); }
  /// Flushes the rows added so far to the disk, so that they survive a loss of power.
  void flush_to_disk() {
    require(::fsync(::fileno(file_)) == 0, "cannot write ", path_.string(), " to the disk: ", std::strerror(errno));
  }

 private:
  void put(const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), file_) == text.size() && std::fflush(file_) == 0;
    require(written, "cannot write ", path_.string(), ": ", std::strerror(errno));
  }

  fs::path path_;
  std::FILE* file_ = nullptr;
};

}  // namespace examples
