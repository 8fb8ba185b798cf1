// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Takes the place of the elastic slip for friction laws without one.
struct NoSlip {};
/// The elastic slip of a slave at a wall.
template <class S, int D>
struct ElasticSlip {
  Vector<S, D> value = Vector<S, D>::Zero();  ///< In m, of the wall relative to the slave.
  bool starts = true;                         ///< The slave did not touch in the previous call.
};

/// Contact history: for each slave and wall in contact, the side of the wall on which the slave was, and its elastic
/// slip. A fast slave may jump across the middle of a thin wall, where the direction outwards is undefined, within one
/// step; it is detected because the wall then pushes it to the other side. Different slaves may be updated
/// concurrently.
template <int D, class Slip = NoSlip>
class ContactHistory {
 public:
  /// For `size` pairs of a slave and a wall.
  void resize(std::size_t size) { entries_.resize(size); }

  /// Begins a new call. A call without evaluations clears the history.
  void next_call() { ++call_; }

  /// Records that entry `k` touches in this call. `outward` is the direction in which the wall pushes, before the
  /// rotation of the masters; `inside` is whether the slave is so close that this direction may be wrong. Returns
  /// whether the direction has reversed since the slave, in contact ever since, was last not inside.
  [[nodiscard]] bool turned_round(std::size_t k, const Vector<float, D>& outward, bool inside) {
    Entry& entry = entries_[k];
    const bool known = entry.call + 1 == call_, turned = known && entry.outward.dot(outward) < -0.5F;
    if (!known || !inside) entry.outward = outward;
    if (!known) entry.slip = Slip{};
    entry.call = call_;
    return turned;
  }
  /// The elastic slip of entry `k`, which touches in this call by the function above.
  [[nodiscard]] Slip& slip(std::size_t k) { return entries_[k].slip; }

 private:
  struct Entry {
    Vector<float, D> outward;
    std::uint32_t call = 0;  // the call in which it last touched
    [[no_unique_address]] Slip slip;
  };
  std::vector<Entry> entries_;
  std::uint32_t call_ = 1;
};

}  // namespace hmps::inline HMPS_ABI::detail
