// SPDX-License-Identifier: MIT
#pragma once

#include <omp.h>

#include <cstddef>
#include <exception>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI {

/// Executor on OpenMP threads; opt-in: compile and link with OpenMP yourself. An exception thrown
/// by a body reaches the caller after the loop.
struct OpenMP {
  int threads = omp_get_max_threads();  ///< Number of threads, at least 1.

  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    require(threads >= 1, "hmps: the number of OpenMP threads is ", threads, "; it must be at least 1");
    std::exception_ptr failure;
    const auto end = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::ptrdiff_t i = 0; i < end; ++i) {
      try {
        body(static_cast<std::size_t>(i));
      } catch (...) {
#pragma omp critical(hmps_executor_failure)
        if (!failure) failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
  }
};

}  // namespace hmps::inline HMPS_ABI
