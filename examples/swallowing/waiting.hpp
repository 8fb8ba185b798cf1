// SPDX-License-Identifier: MIT
#pragma once

#if defined(__linux__)
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <thread>
#endif

namespace swallowing {

/// Threads of GCC's OpenMP spin for milliseconds while they wait for each other. If other programs are busy, the
/// waiting threads take the processors from those that they wait for, and two threads take several times as long as
/// one. Therefore this function restarts the program with short waits if the load and `threads` together leave no
/// processor free, unless the user has chosen how to wait. A restart is necessary because the runtime reads the choice
/// once, before `main`. Returns if no restart is needed or possible.
inline void wait_shortly_if_busy([[maybe_unused]] int threads, [[maybe_unused]] char** argv) {
#if defined(__linux__)
  double load = 0;
  if (threads < 2 || std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr ||
      getloadavg(&load, 1) != 1 || load + threads <= std::thread::hardware_concurrency() + 0.5)
    return;
  std::error_code failure;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failure);  // the name that process lists show
  if (!failure && setenv("GOMP_SPINCOUNT", "10000", 1) == 0) execv(program.c_str(), argv);
#endif
}

}  // namespace swallowing
