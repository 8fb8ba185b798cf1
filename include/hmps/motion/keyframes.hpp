// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// A time, and the value of a track at that time: a number for `N` = 1, otherwise an array of `N` numbers.
template <int N>
struct Keyframe {
  using Value = std::conditional_t<N == 1, double, Vector<double, N>>;
  double time = 0;  ///< s
  Value value{};    ///< in m or rad, depending on the motion
};

/// Interpolates keyframes. Each component is the monotone cubic of Fritsch and Carlson (slopes from the weighted
/// harmonic mean of Fritsch and Butland), with zero slope at both ends, and constant before the first and after the
/// last keyframe. Value and rate are continuous; no component overshoots a keyframe, and a component that is equal in
/// two neighbouring keyframes is constant between them. Always in double: evaluating a motion is cheap, and a time in
/// float loses steps.
///
/// A run that starts after the first keyframe starts in the middle of the motion. Move its regions to that time first
/// (`ControlRegion::place`); otherwise the first step catches up on all the motion before it.
template <int N>
class Keyframes {
 public:
  using Value = typename Keyframe<N>::Value;

  /// Takes keyframes with strictly increasing times. Throws `InputError` if there is none, and at the first one,
  /// counted from 0, that is not finite or out of order, or to which the rate exceeds the range of a double.
  explicit Keyframes(std::vector<Keyframe<N>> keys) : keys_(std::move(keys)), slopes_(keys_.size(), zero()) {
    detail::require(!keys_.empty(), "hmps: a track has no keyframe; give at least one time and value");
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      detail::require(detail::is_finite(keys_[k].time), "hmps: keyframe ", k, " has the time ", keys_[k].time,
                      "; give finite seconds");
      for (int c = 0; c < N; ++c)
        detail::require(detail::is_finite(at(keys_[k].value, c)), "hmps: component ", c, " of keyframe ", k, " at ",
                        keys_[k].time, " s is ", at(keys_[k].value, c), "; give finite values");
      detail::require(k == 0 || keys_[k - 1].time < keys_[k].time, "hmps: keyframe ", k, " at ", keys_[k].time,
                      " s follows one at ", k == 0 ? 0.0 : keys_[k - 1].time,
                      " s; sort the keyframes by time and give each time once");
      if (k > 0) require_rates(k);
    }
    for (std::size_t k = 1; k + 1 < keys_.size(); ++k)
      for (int c = 0; c < N; ++c) {
        at(slopes_[k], c) = slope(k, c);
        detail::require(detail::is_finite(at(slopes_[k], c)), "hmps: the rate of component ", c, " at keyframe ", k,
                        " at ", keys_[k].time, " s exceeds the range of a double: check times and values");
      }
  }
  Keyframes(std::initializer_list<Keyframe<N>> keys) : Keyframes(std::vector<Keyframe<N>>(keys)) {}

  /// The value at `time` (s). Throws `InputError` for NaN, and after a move.
  [[nodiscard]] Value value(double time) const {
    require_time(time);
    if (!(time > keys_.front().time)) return keys_.front().value;
    if (time >= keys_.back().time) return keys_.back().value;
    const std::size_t k = piece(time);
    const double h = keys_[k + 1].time - keys_[k].time;
    const double s = (time - keys_[k].time) / h;
    // Evaluated relative to the nearer keyframe, so that equal neighbours reproduce their value exactly.
    const double rise = s * s * (3 - 2 * s);
    return keys_[k].value + rise * (keys_[k + 1].value - keys_[k].value) +
           h * s * (1 - s) * ((1 - s) * slopes_[k] - s * slopes_[k + 1]);
  }
  [[nodiscard]] Value operator()(double time) const { return value(time); }

  /// The derivative of the value with respect to time at `time` (s). Throws `InputError` for NaN, and after a move.
  [[nodiscard]] Value rate(double time) const {
    require_time(time);
    if (!(time > keys_.front().time) || time >= keys_.back().time) return zero();
    const std::size_t k = piece(time);
    const double h = keys_[k + 1].time - keys_[k].time;
    const double s = (time - keys_[k].time) / h;
    return 6 * s * (1 - s) / h * (keys_[k + 1].value - keys_[k].value) + (1 - s) * (1 - 3 * s) * slopes_[k] +
           s * (3 * s - 2) * slopes_[k + 1];
  }

  [[nodiscard]] const std::vector<Keyframe<N>>& keys() const { return keys_; }

 private:
  [[nodiscard]] static Value zero() {
    if constexpr (N == 1)
      return 0.0;
    else
      return Value::Zero();
  }
  template <class V>
  [[nodiscard]] static auto& at(V& value, [[maybe_unused]] int c) {
    if constexpr (N == 1)
      return value;
    else
      return value[c];
  }
  /// Throws unless all that is computed between the keyframes `k` - 1 and `k` is finite. The largest factor of a
  /// difference or a rate is 6, in the sum of the weights in `slope`.
  void require_rates(std::size_t k) const {
    const Keyframe<N>&from = keys_[k - 1], &to = keys_[k];
    const double step = 6 * (to.time - from.time);
    for (int c = 0; c < N; ++c) {
      const double change = 6 * (at(to.value, c) - at(from.value, c));
      detail::require(detail::is_finite(step) && detail::is_finite(36 / step) && detail::is_finite(change) &&
                          detail::is_finite(36 / step * change),
                      "hmps: from keyframe ", k - 1, " at ", from.time, " s to keyframe ", k, " at ", to.time,
                      " s, component ", c, " changes from ", at(from.value, c), " to ", at(to.value, c),
                      "; these differences or their rate exceed the range of a double: check times and values");
    }
  }
  void require_time(double time) const {
    detail::require(!keys_.empty(), "hmps: a track that was moved from has no keyframes; use the one it was moved to");
    detail::require(!detail::is_nan(time),
                    "hmps: the time at which a track is evaluated is NaN; it must be a number in s");
  }
  [[nodiscard]] std::size_t piece(double time) const {
    const auto above = std::upper_bound(keys_.begin(), keys_.end(), time,
                                        [](double t, const Keyframe<N>& key) { return t < key.time; });
    return static_cast<std::size_t>(above - keys_.begin()) - 1;
  }
  [[nodiscard]] double slope(std::size_t k, int c) const {
    const double before = keys_[k].time - keys_[k - 1].time;
    const double behind = keys_[k + 1].time - keys_[k].time;
    const double left = (at(keys_[k].value, c) - at(keys_[k - 1].value, c)) / before;
    const double right = (at(keys_[k + 1].value, c) - at(keys_[k].value, c)) / behind;
    if (!(left * right > 0)) return 0;
    const double w1 = 2 * behind + before;
    const double w2 = behind + 2 * before;
    return (w1 + w2) / (w1 / left + w2 / right);
  }

  std::vector<Keyframe<N>> keys_;
  std::vector<Value> slopes_;
};

/// A track of one number.
using Track = Keyframes<1>;

}  // namespace hmps::inline HMPS_ABI
