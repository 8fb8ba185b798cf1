// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>

namespace scenes {

/// Seconds that this program has had of all processors.
[[nodiscard]] inline double processor_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace scenes
