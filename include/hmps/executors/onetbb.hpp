// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/first_failure.hpp"

namespace hmps::inline HMPS_ABI {

/// Executor on oneTBB's current task arena. Opt-in: link TBB::tbb yourself. An exception thrown by a body reaches the
/// caller after the loop; of several, that of the lowest index does, so that the message is the same in every run.
struct OneTBB {
  std::size_t grain = 1;  ///< smallest number of loop iterations per task

  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    detail::FirstFailure failure;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const auto& range) {
      std::size_t i = range.begin();
      try {
        for (; i != range.end(); ++i) body(i);
      } catch (...) {  // here, because oneTBB would cancel ranges of lower indices
        failure.keep(i);
      }
    });
    failure.rethrow();
  }
};

}  // namespace hmps::inline HMPS_ABI
