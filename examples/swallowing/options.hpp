// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swallowing {

/// The end of the paper's swallow in s.
inline constexpr double end_of_swallow = 2.05;

/// A named choice of the settings that decide accuracy and cost. docs/swallowing.md gives the measured error and cost
/// of each.
struct Quality {
  std::string_view name;
  double spacing;         ///< l0 in m
  double time_step;       ///< in s; 0: from the estimate of the largest stable step
  bool single_precision;  ///< kernels and velocities in float; positions are in double either way
  bool operator==(const Quality&) const = default;
};

/// From the cheapest, the default, to the most expensive. Single precision moves no fold time by more than 0.3
/// ms.
inline constexpr std::array qualities{Quality{"draft", 2.4e-3, 0, true}, Quality{"standard", 1.8e-3, 0, true},
                                      Quality{"paper", 1.2e-3, 1e-5, true}, Quality{"fine", 1e-3, 0, true}};
inline constexpr Quality default_quality = qualities[0];

/// What the command line asks for.
struct Options {
  std::vector<std::string> cases{"X1", "X3", "Y1", "Y3"};  ///< in the order in which they are run
  double spacing = default_quality.spacing;                ///< l0 in m
  double time_step = default_quality.time_step;            ///< in s; 0: follows the largest stable step
  double step_share = 0.8;                                 ///< of the largest stable step, if the step follows it
  double until = end_of_swallow;                           ///< in s
  std::optional<double> friction;                          ///< overrules the friction coefficient of the cases
  double stiffness = 1;                                    ///< factor on Young's moduli of all organs
  bool paper_contact = false;                              ///< contact as in the paper, in place of ours
  std::optional<double> penalty;                           ///< fixed k in N/m4, whatever the step
  std::optional<double> penalty_ratio;                     ///< k~ of \paper{25}
  bool single_precision = default_quality.single_precision;
  bool fitted = false;           ///< particles that are fitted to the organs, in place of those of a lattice
  int threads = 0;               ///< at least 1 after parsing: as given, or all cores
  double lattice_shift = 0;      ///< of the particle lattice along x and z, in spacings
  bool constrictors = true;      ///< false: region H is left out
  bool bar = true;               ///< on a terminal, show progress as a bar in one line
  bool frames = true;            ///< write frames for ParaView
  bool surfaces = true;          ///< draw the surfaces of the organs, also in frames if there are any
  double frame_interval = 0.01;  ///< in s
  std::string out = "results";   ///< the output folder
  std::string data;              ///< folder of the motion tracks; empty: those of the example
  bool resume = false;
};

/// The folder of the tracks of the motion: that of the example, unless the options name another.
[[nodiscard]] std::filesystem::path data_folder(const Options& options);

/// Reads the command line. Returns nothing if the program should end at once with `exit_code`: 0 after --help, 2 after
/// a mistake, which is explained on `err`.
[[nodiscard]] std::optional<Options> parse_options(int argc, const char* const* argv, std::ostream& out,
                                                   std::ostream& err, int& exit_code);

}  // namespace swallowing
