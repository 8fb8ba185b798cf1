// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// What stands for the elastic slip where friction has none.
struct NoSlip {};
/// The elastic slip of a slave at a wall.
template <class S, int D>
struct ElasticSlip {
  Vector<S, D> value = Vector<S, D>::Zero();  ///< In m, of the wall relative to the slave.
  bool starts = true;                         ///< The slave did not touch in the call before.
};

/// What is remembered of each slave of each wall from call to call, while it touches: on which side of the wall it was,
/// and its elastic slip. What is fast may jump over the place in a thin wall at which the wall does not tell which way
/// is out; but then the wall has come to push it to the other side since it was last that far off. Entries of different
/// slaves may be used at once.
template <int D, class Slip = NoSlip>
class ContactHistory {
 public:
  /// For `size` pairs of a slave and a wall.
  void resize(std::size_t size) { entries_.resize(size); }

  /// A new call begins. One without evaluations in between forgets all.
  void next_call() { ++call_; }

  /// Notes that entry `k` touches in this call, with `outward` the direction in which the wall pushes, before the
  /// masters turned; `inside`: whether it is so near that this may be the wrong one. Whether the direction has turned
  /// round since the slave, in touch ever since, was last not inside.
  [[nodiscard]] bool turned_round(std::size_t k, const Vector<float, D>& outward, bool inside) {
    Entry& entry = entries_[k];
    const bool known = entry.call + 1 == call_, turned = known && entry.outward.dot(outward) < -0.5F;
    if (!known || !inside) entry.outward = outward;
    if (!known) entry.slip = Slip{};
    entry.call = call_;
    return turned;
  }
  /// Of entry `k`, which touches in this call by the function above.
  [[nodiscard]] Slip& slip(std::size_t k) { return entries_[k].slip; }

 private:
  struct Entry {
    Vector<float, D> outward;
    std::uint32_t call = 0;  // in which it touched
    [[no_unique_address]] Slip slip;
  };
  std::vector<Entry> entries_;
  std::uint32_t call_ = 1;
};

}  // namespace hmps::inline HMPS_ABI::detail
