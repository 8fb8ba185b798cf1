// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "series.hpp"
#include "summary.hpp"

namespace swallowing {

/// A line of the paper's Tables 1 and 2.
struct PaperCase {
  const char* name;
  const char* motion;
  double friction;
  std::optional<double> fold_time;  ///< s, nothing: did not fold
};
inline constexpr std::array<PaperCase, 4> paper_cases{PaperCase{"X1", "X", 0.1, 1.65}, PaperCase{"X3", "X", 0.3, 1.70},
                                                      PaperCase{"Y1", "Y", 0.1, 1.70},
                                                      PaperCase{"Y3", "Y", 0.3, std::nullopt}};

/// What there is of one of the paper's cases in an output folder.
struct CaseResult {
  std::optional<Summary> summary;
  std::vector<Sample> samples;
};

/// Reads the results of the paper's four cases from `out`, in the order of `paper_cases`; those that
/// were not run are empty.
[[nodiscard]] std::array<CaseResult, 4> read_results(const std::filesystem::path& out);

/// Writes table2.md at `path`: our times of downfolding beside the paper's Table 2.
void write_table2(const std::filesystem::path& path, const std::array<CaseResult, 4>& results);

/// Draws fold.png at `path`: the tip angle of the cases over time, the times of the paper's Table 2 as
/// marks, and both in a table.
void draw_fold(const std::filesystem::path& path, const std::array<CaseResult, 4>& results);

}  // namespace swallowing
