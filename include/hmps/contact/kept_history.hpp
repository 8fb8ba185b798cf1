// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/trial.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Takes the place of the kept history for friction laws without one.
struct NothingKept {};

/// The history of a contact as it was before a `Trial`. The first evaluation of a trial keeps it, the first one after
/// the trial, or of another, returns it.
template <int D, class History, class Motion>
class KeptHistory {
 public:
  /// To be called before each evaluation, and before the history is changed in another way.
  void settle(History& history, Motion& motion) {
    if (present_trial == trial_) return;
    if (kept_) {
      history.restore(std::move(kept_->first));
      motion.restore(std::move(kept_->second));
      kept_.reset();
    }
    trial_ = present_trial;
    if (trial_ != 0) kept_.emplace(history, motion.places());
  }

 private:
  std::uint64_t trial_ = 0;
  std::optional<std::pair<History, std::vector<Vector<double, D>>>> kept_;
};

}  // namespace hmps::inline HMPS_ABI::detail
