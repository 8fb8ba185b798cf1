// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The normal of the wall that one slave faces, from check to check, and a bound of the angle by which it turns until
/// the next check. The bound is a multiple of the latest turn; it falls by no more than half from check to check, and
/// never below `least_turn`.
///
/// A slave may sleep because its wall is trusted not to turn further. If the next check finds that it has, the slave
/// may have touched unseen: that check is late.
template <class S, int D>
class Facing {
 public:
  using Point = Vector<S, D>;
  static constexpr S least_turn = S(0.03), first_turn = S(0.2);  // rad

  /// At a check that asks for no normal, or finds none.
  void forget() {
    outward_.setZero();
    trusted_ = late_ = false;
  }
  /// At a check that finds the normal `outward`. `ratio`: how many times as long it is until the next check as since
  /// the latest.
  void update(const Point& outward, S ratio) {
    late_ = false;
    if (outward_.isZero()) {
      turn_ = first_turn;
    } else {
      const S turn = (outward - outward_).norm();
      late_ = trusted_ && turn > turn_;
      turn_ = std::max({least_turn, S(4) * ratio * turn, S(0.5) * turn_});
    }
    outward_ = outward;
  }
  /// After `update`: whether its slave sleeps because of what `turn` says.
  void trust(bool trusted) { trusted_ = trusted; }

  /// By which the normal may turn until the next check, in rad.
  [[nodiscard]] S turn() const { return turn_; }
  /// Whether the latest check found that the normal had turned further than it was trusted to.
  [[nodiscard]] bool is_late() const { return late_; }

 private:
  Point outward_ = Point::Zero();  // zero: unknown
  S turn_ = first_turn;
  bool trusted_ = false, late_ = false;
};

}  // namespace hmps::inline HMPS_ABI::detail
