// SPDX-License-Identifier: MIT
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/first_failure.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI {

/// Executor on OpenMP threads. Opt-in: compile and link with OpenMP yourself. An exception thrown by a body reaches the
/// caller after the loop; of several, that of the lowest index does, so that the message is the same in every run.
///
/// The threads of most OpenMP runtimes spin while they wait for each other. On a machine that is busy with other
/// programs, spinning threads take time from each other: with two cores and a load of six, two threads were four times
/// as slow as one thread; with OMP_WAIT_POLICY=passive they were as fast as one. Leave a core to other programs, or
/// start the program with OMP_WAIT_POLICY=passive, which a header cannot set.
struct OpenMP {
  int threads = omp_get_max_threads();  ///< number of threads, from 1 to `most_threads()`

  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    detail::require(threads >= 1, "hmps: the number of OpenMP threads is ", threads, "; it must be at least 1");
    detail::require(threads <= most_threads(), "hmps: the number of OpenMP threads is ", threads, ", but there are ",
                    omp_get_num_procs(), " processors, for which at most ", most_threads(),
                    " are started: more would only wait for each other; check OMP_NUM_THREADS");
    detail::FirstFailure failure;
    const auto end = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (std::ptrdiff_t i = 0; i < end; ++i) {
      try {
        body(static_cast<std::size_t>(i));
      } catch (...) {
        failure.keep(static_cast<std::size_t>(i));
      }
    }
    failure.rethrow();
  }

  /// Four threads per available processor, at least 16.
  [[nodiscard]] static int most_threads() {
    static const int most = std::max(16, 4 * omp_get_num_procs());
    return most;
  }
};

}  // namespace hmps::inline HMPS_ABI
