// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <exception>
#include <mutex>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Of the exceptions of a loop that runs on several threads, the one with the lowest index: that of a loop in order, if
/// the bodies are independent.
class FirstFailure {
 public:
  /// Call it in the handler of an exception that the body threw at `index`. Thread-safe.
  HMPS_COLD void keep(std::size_t index) noexcept {
    const std::lock_guard lock(mutex_);
    if (failure_ && index_ <= index) return;
    index_ = index;
    failure_ = std::current_exception();
  }
  /// Throws what was kept, if there is any. Call it after the loop.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t index_ = 0;
};

}  // namespace hmps::inline HMPS_ABI::detail
