// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
/// The number of the trial in which this thread is; 0 in none. What is called is a callable of the program, which hands
/// on positions and forces alone, so that no argument can tell contact of it.
inline thread_local std::uint64_t present_trial = 0;
/// How many trials there have been, on all threads.
inline std::atomic<std::uint64_t> trial_count{0};
}  // namespace detail

/// While one exists, the forces that this thread evaluates are trials, at states that the bodies do not go through:
/// what remembers earlier states, as contact with `SpringFriction` does, is afterwards as it was before. `stable_step`,
/// `step_causes` and `relax` make their own. A trial within a trial is part of it.
///
///     {
///       const Trial trial;                                  // a stiffness by differences, say
///       contact.add(vectors(displaced), v, F, f, dt);
///     }
class Trial {
 public:
  Trial() : is_first_(detail::present_trial == 0) {
    if (is_first_) detail::present_trial = ++detail::trial_count;
  }
  ~Trial() {
    if (is_first_) detail::present_trial = 0;
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

 private:
  bool is_first_;
};

}  // namespace hmps::inline HMPS_ABI
