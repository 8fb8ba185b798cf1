// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI {

/// Executor on oneTBB's current task arena. Opt-in: link TBB::tbb yourself.
struct OneTBB {
  std::size_t grain = 1;  ///< smallest number of loop iterations per task

  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
    });
  }
};

}  // namespace hmps::inline HMPS_ABI
