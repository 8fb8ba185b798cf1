// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>

#include "report/table.hpp"

namespace report {

/// A picture that goes with a table.
struct Picture {
  std::string file = "";   ///< its name in the folder of pictures; none if empty
  std::string words = "";  ///< what it shows
  std::function<void(const std::filesystem::path&)> draw = {};
};

/// A program that measures: its command line, which every study shares, and where its results go.
class Study {
 public:
  /// `quick` describes what a run with --quick includes.
  Study(const std::string& name, const std::string& description, const std::string& quick);
  Study(const Study&) = delete;
  Study& operator=(const Study&) = delete;

  /// Reads the arguments, creates the folder `out` and calls `measure()`. Returns the exit code: 0, or 1 if a published
  /// table does not show what it should, or 2 after an error, with the reason on standard error.
  [[nodiscard]] int run(int argc, char** argv, const std::function<void()>& measure);

  /// Prints a table, writes it to `out`, and puts it and its picture into its section of the document.
  void publish(const Table& table, const Picture& picture = {});
  /// Puts `text` into a section of the document.
  void publish(const std::string& section, const std::string& text);
  /// The current text of the document; empty if no document is requested or it does not exist.
  [[nodiscard]] std::string page() const;
  /// Writes the document and draws its pictures in the folder `images` beside it, if a document is requested.
  void save(const std::string& page) const;
  void draw(const Picture& picture) const;

  CLI::App app;
  bool quick = false;
  std::filesystem::path out;  ///< folder of tables
  std::string document = "";  ///< page to write

 private:
  bool whole_ = true;
};

}  // namespace report
