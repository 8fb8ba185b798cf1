// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The calls between two checks of the lists.
struct CheckInterval {
  std::size_t since;  // calls since the latest check; in a check, since the previous one
  std::size_t until;  // calls from the latest check to the next; in a check, from now on
  /// At the same rate, what changed by `c` since the latest check changes by `ratio()` times `c` until the next.
  template <class S>
  [[nodiscard]] S ratio() const {
    return static_cast<S>(until) / static_cast<S>(std::max<std::size_t>(since, 1));
  }
};

/// Decides when the lists of contact are checked again: when rows that woke since the latest check have cost more than
/// a check, or else after an interval of `shortest` to `longest` calls. Deformation gradients are read only in checks,
/// so the interval is limited even if nothing moves.
///
/// All costs are counted in evaluations of one candidate.
class CheckSchedule {
 public:
  static constexpr std::size_t shortest = 8, longest = 64;

  /// Counts a call. `woken` is the number of candidates that are awake now but slept at the latest check, `cost` the
  /// cost of a check. Returns whether a check is due.
  [[nodiscard]] bool count_call(std::size_t woken, std::size_t cost) {
    woken_work_ += woken;
    return ++age_ >= interval_ || woken_work_ > cost;
  }

  /// In a check: chooses the interval that begins then, from the cost of a check and the number of active candidates.
  void choose_interval(std::size_t active, std::size_t cost) {
    // Sharper lists are worth about a tenth of the cost of evaluating them.
    interval_ = std::clamp<std::size_t>(8 * cost / (active + 1), shortest, longest);
  }
  /// Shortens that interval so that a particle that moves by `speed` per call moves by at most `most`, but not below
  /// `shortest`.
  template <class S>
  void limit_travel(S speed, S most) {
    if (static_cast<S>(interval_) * speed > most)
      interval_ = std::max(shortest, static_cast<std::size_t>(most / speed));
  }
  /// Ends a check: the interval begins.
  void start_interval() { age_ = woken_work_ = 0; }

  [[nodiscard]] CheckInterval interval() const { return {age_, interval_}; }

 private:
  std::size_t age_ = 0, interval_ = longest, woken_work_ = 0;
};

}  // namespace hmps::inline HMPS_ABI::detail
