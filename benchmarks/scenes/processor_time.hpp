// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>

namespace scenes {

/// Processor time of this program in seconds, summed over all processors.
[[nodiscard]] inline double processor_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace scenes
