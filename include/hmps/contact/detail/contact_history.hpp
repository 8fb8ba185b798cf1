// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
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
/// slip. Within one step, a fast slave may jump across the middle of a thin wall, where the outward direction is
/// undefined; this is detected because the wall then pushes it to the other side. Different slaves may be updated
/// concurrently.
template <int D, class Slip = NoSlip>
class ContactHistory {
 public:
  /// Makes room for `size` pairs of a slave and a wall.
  void resize(std::size_t size) { entries_.resize(size); }

  /// Begins a new call. A call without evaluations clears the history.
  void next_call() { ++call_; }
  /// Ends a call that failed: what touched before it or in it counts as touching in the previous call.
  void take_back_call() {
    for (Entry& entry : entries_)
      if (entry.call == call_) --entry.call;
    --call_;
  }

  /// Records that entry `k` touches in this call. `outward` is the direction in which the wall pushes, before the
  /// rotation of the masters; `inside` is whether the slave is so close that this direction may be wrong. Returns
  /// whether the direction has reversed since `inside` was last false, if the slave has been in contact ever since.
  [[nodiscard]] bool turned_round(std::size_t k, const Vector<float, D>& outward, bool inside) {
    Entry& entry = entries_[k];
    const bool known = entry.call + 1 == call_, turned = known && entry.outward.dot(outward) < -0.5F;
    if (!known || !inside) entry.outward = outward;
    if (!known) entry.slip = Slip{};
    entry.call = call_;
    return turned;
  }
  /// The elastic slip of entry `k`, for which `turned_round` must have been called in this call.
  [[nodiscard]] Slip& slip(std::size_t k) { return entries_[k].slip; }

  /// Appends the number, `outward` and the elastic slip of each entry that touched in the latest call. A half is added
  /// to the number of an entry whose slip has not begun, because its pair has no friction.
  void append_to(std::vector<double>& numbers) const {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const Entry& entry = entries_[k];
      if (entry.call != call_) continue;
      double number = static_cast<double>(k);
      if constexpr (has_slip) number += entry.slip.starts ? 0.5 : 0;
      numbers.push_back(number);
      for (int c = 0; c < D; ++c) numbers.push_back(static_cast<double>(entry.outward[c]));
      if constexpr (has_slip)
        for (int c = 0; c < D; ++c) numbers.push_back(static_cast<double>(entry.slip.value[c]));
    }
  }
  /// Replaces the history by the numbers that `append_to` wrote for `size` entries. For any other numbers it throws
  /// `InputError` and leaves the history unchanged.
  void restore(std::span<const double> numbers, std::size_t size) {
    constexpr std::size_t width = 1 + D + (has_slip ? D : 0);
    const auto require_history = [](bool holds) {
      require(holds,
              "hmps: these numbers are not the history of a contact with this friction law; give restore_history "
              "what history() returned, all of it and unchanged");
    };
    require_history(numbers.size() % width == 0);
    std::vector<Entry> entries(size);
    double next = 0;
    for (std::size_t at = 0; at < numbers.size(); at += width) {
      const double k = std::floor(numbers[at]), half = numbers[at] - k;
      require_history(is_finite(k) && k >= next && k < static_cast<double>(size) &&
                      (half == 0 || (has_slip && half == 0.5)));
      next = k + 1;
      Entry& entry = entries[static_cast<std::size_t>(k)];
      entry.call = call_;
      for (std::size_t c = 0; c < width - 1; ++c) require_history(is_finite(static_cast<float>(numbers[at + 1 + c])));
      for (std::size_t c = 0; c < D; ++c) {
        entry.outward[static_cast<int>(c)] = static_cast<float>(numbers[at + 1 + c]);
        if constexpr (has_slip) {
          using S = std::remove_cvref_t<decltype(entry.slip.value[0])>;
          entry.slip.value[static_cast<int>(c)] = static_cast<S>(numbers[at + 1 + D + c]);
        }
      }
      if constexpr (has_slip) entry.slip.starts = half > 0;
    }
    entries_ = std::move(entries);
  }

 private:
  static constexpr bool has_slip = !std::is_same_v<Slip, NoSlip>;
  struct Entry {
    Vector<float, D> outward;
    std::uint32_t call = 0;  // the call in which it last touched
    [[no_unique_address]] Slip slip;
  };
  std::vector<Entry> entries_;
  std::uint32_t call_ = 1;
};

}  // namespace hmps::inline HMPS_ABI::detail
