// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace swallowing {

/// Counts steps and time while the step changes now and then.
class StepClock {
 public:
  /// Time (s) that is a whole number of steps, so that samples and pictures fall on steps.
  static constexpr double beat = 1e-3;

  StepClock() = default;
  explicit StepClock(double step) : step_(step) {}

  /// The largest step not above `limit` that divides the beat.
  [[nodiscard]] static double dividing(double limit) { return beat / std::ceil(beat / limit); }

  [[nodiscard]] double step() const { return step_; }           ///< s
  [[nodiscard]] std::uint64_t steps() const { return steps_; }  ///< taken
  [[nodiscard]] double time() const { return origin_ + static_cast<double>(steps_ - steps_at_origin_) * step_; }

  void advance() { ++steps_; }
  /// From now on, takes steps of `step`. Call this on a beat; the time is rounded to it.
  void change(double step) {
    origin_ = std::round(time() / beat) * beat;
    steps_at_origin_ = steps_;
    step_ = step;
  }

 private:
  double origin_ = 0;
  std::uint64_t steps_at_origin_ = 0, steps_ = 0;
  double step_ = 0;
};

}  // namespace swallowing
