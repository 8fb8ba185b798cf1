// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

namespace swallowing {

/// Shows how far a case has come: on a terminal by one line that is redrawn in place, otherwise (for log files) by a
/// plain line for every twentieth of the way.
class Progress {
 public:
  struct Settings {
    std::string name;           ///< of the case
    double start = 0;           ///< simulated time in s where this process begins, > 0 after --resume
    double until = 2.05;        ///< simulated time in s where it ends
    std::size_t particles = 0;  ///< of one step
    bool terminal = false;      ///< redraw the line in place; see `is_terminal`
    int width = 100;            ///< characters of the line
  };
  /// Seconds from any fixed moment.
  using Clock = std::function<double()>;

  Progress(std::ostream& out, Settings settings, Clock clock = steady_seconds);

  /// Reports that `steps` steps were taken since the start, up to `time`. Cheap enough for every step.
  void update(double time, std::uint64_t steps, double smallest_j);
  /// Draws the end of the line, so that other text can follow.
  void finish(double time, std::uint64_t steps, double smallest_j);

  [[nodiscard]] static double steady_seconds();

 private:
  void draw(double time, std::uint64_t steps, double smallest_j);

  std::ostream* out_;
  Settings settings_;
  Clock clock_;
  double began_, drawn_;
  int twentieths_;
};

/// Whether standard error is a terminal.
[[nodiscard]] bool is_terminal();

/// `seconds` as 42 s, 3 min 05 s or 2 h 07 min.
[[nodiscard]] std::string duration(double seconds);

/// `value` with three digits and k, M or G.
[[nodiscard]] std::string with_prefix(double value);

}  // namespace swallowing
