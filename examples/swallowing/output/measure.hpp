// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

namespace swallowing {

/// The angle above the horizontal, in degrees, of the line from `from` to `to`: positions with x posterior and z
/// superior, in m; y does not count. The angle of an upright epiglottis that leans back is below 90, that of one that
/// has folded below the horizontal is below 0.
template <class Point>
[[nodiscard]] double angle_above_horizontal(const Point& from, const Point& to) {
  const double posterior = static_cast<double>(to[0]) - static_cast<double>(from[0]);
  const double superior = static_cast<double>(to[2]) - static_cast<double>(from[2]);
  return std::atan2(superior, posterior) * 180 / std::numbers::pi;
}

/// The first time at which an angle, given sample by sample, passes below zero: the definition of the times of
/// downfolding in the paper's Table 2.
class FoldTime {
 public:
  /// Adds the sample `angle` at `time`, which must be later than the times before.
  void add(double time, double angle) {
    if (!found_ && angle < 0) {
      // Between two samples the angle is taken as linear.
      const bool first = !(last_angle_ >= 0);
      found_ = first ? time : last_time_ + (time - last_time_) * last_angle_ / (last_angle_ - angle);
    }
    last_time_ = time;
    last_angle_ = angle;
    if (!(angle >= smallest_)) smallest_ = angle;
  }
  /// The time in s, or nothing if the angle was never below zero.
  [[nodiscard]] std::optional<double> time() const { return found_; }
  /// The smallest angle of all samples; NaN if there are none.
  [[nodiscard]] double smallest() const { return smallest_; }

 private:
  std::optional<double> found_;
  double last_time_ = 0;
  double last_angle_ = std::nan("");
  double smallest_ = std::nan("");
};

}  // namespace swallowing
