// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace swallowing {

/// Times k * interval that come one after the other; `due` is true once for each.
class Every {
 public:
  explicit Every(double interval) : interval_(interval) {}
  /// At `time`, from which on steps of `step` are taken.
  [[nodiscard]] bool due(double time, double step) {
    if (time < static_cast<double>(next_) * interval_ - step / 2) return false;
    skip(time, step);
    return true;
  }
  /// Leaves out all until `time`.
  void skip(double time, double step) {
    next_ = static_cast<std::uint64_t>(std::floor((time + step / 2) / interval_)) + 1;
  }

 private:
  double interval_;
  std::uint64_t next_ = 0;
};

}  // namespace swallowing
