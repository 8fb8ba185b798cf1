// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The normal of the wall that one slave faces, from check to check, and a bound on the angle by which it turns until
/// the next check. The bound is a multiple of the latest turn; it falls by no more than half from check to check, and
/// never below `least_turn`.
///
/// A slave may sleep because its wall is trusted not to turn further. If the next check finds that it has, the slave
/// may have touched it unnoticed: that check is late.
template <class S, int D>
class Facing {
 public:
  using Point = Vector<S, D>;
  static constexpr S least_turn = S(0.03), first_turn = S(0.2);  // rad

  /// To be called at a check that needs no normal, or finds none.
  void forget() {
    outward_.setZero();
    trusted_ = late_ = false;
  }
  /// To be called at a check that finds the normal `outward`. `ratio` is the time until the next check over the time
  /// since the previous one.
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
  /// To be called after `update`: whether the slave sleeps because of the bound `turn`.
  void trust(bool trusted) { trusted_ = trusted; }

  /// The angle in rad by which the normal may turn until the next check.
  [[nodiscard]] S turn() const { return turn_; }
  /// Whether the latest check found that the normal had turned further than it was trusted to.
  [[nodiscard]] bool is_late() const { return late_; }

 private:
  Point outward_ = Point::Zero();  // zero: unknown
  S turn_ = first_turn;
  bool trusted_ = false, late_ = false;
};

}  // namespace hmps::inline HMPS_ABI::detail
