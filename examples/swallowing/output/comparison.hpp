// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/series.hpp"
#include "output/summary.hpp"
#include "scene/cases.hpp"

namespace swallowing {

/// The content of contacts.csv.
struct ContactTable {
  std::vector<std::string> names;
  TableRows rows;
  /// The index of the column `name`; nothing if there is none.
  [[nodiscard]] std::optional<std::size_t> column(const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
  }
};

/// The results of one of the paper's cases in an output folder.
struct CaseResult {
  std::optional<Summary> summary;
  std::vector<Sample> samples;
  ContactTable contacts = {};
  std::string left_out = {};  ///< why there is nothing although the case was run: how its settings differed
};

/// Reads the results of the paper's four cases from `out`, in the order of `cases`. Cases that were not run, or that
/// were run with other `settings` (see `shared_settings`), are empty.
[[nodiscard]] std::array<CaseResult, 4> read_results(const std::filesystem::path& out, const RunSettings& settings);

/// Writes table2.md to `path`: our times of downfolding beside the paper's Table 2.
void write_table2(const std::filesystem::path& path, const std::array<CaseResult, 4>& results);

/// Draws fold.png at `path`: the tip angle of the cases over time, the times of the paper's Table 2 as marks, and a
/// table of the fold times of both.
void draw_fold(const std::filesystem::path& path, const std::array<CaseResult, 4>& results);

}  // namespace swallowing
