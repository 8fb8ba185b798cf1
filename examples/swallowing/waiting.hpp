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

/// Threads of GCC's OpenMP spin for milliseconds while they wait for each other, and where other programs are busy they
/// take the processors from those that they wait for: two threads then take several times as long as one. So this
/// starts the program anew with short waits if `threads` more than the load leave no processor free, unless the user
/// has chosen how to wait. The runtime reads that once, before `main`. Returns where there is nothing to do, or where
/// it cannot be done.
inline void wait_shortly_if_busy([[maybe_unused]] int threads, [[maybe_unused]] char** argv) {
#if defined(__linux__)
  double load = 0;
  if (threads < 2 || std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr ||
      getloadavg(&load, 1) != 1 || load + threads <= std::thread::hardware_concurrency() + 0.5)
    return;
  std::error_code failure;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failure);  // whose name lists of processes show
  if (!failure && setenv("GOMP_SPINCOUNT", "10000", 1) == 0) execv(program.c_str(), argv);
#endif
}

}  // namespace swallowing
