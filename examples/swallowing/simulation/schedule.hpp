// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace swallowing {

/// The times k * interval in turn; `due` is true once for each.
class Every {
 public:
  explicit Every(double interval) : interval_(interval) {}
  /// Whether the next of them is due at `time`, at which a step of `step` begins.
  [[nodiscard]] bool due(double time, double step) {
    if (time < static_cast<double>(next_) * interval_ - step / 2) return false;
    skip(time, step);
    return true;
  }
  /// Skips all up to `time`.
  void skip(double time, double step) {
    next_ = static_cast<std::uint64_t>(std::floor((time + step / 2) / interval_)) + 1;
  }

 private:
  double interval_;
  std::uint64_t next_ = 0;
};

}  // namespace swallowing
