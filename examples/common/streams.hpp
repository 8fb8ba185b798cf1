// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

namespace examples {

namespace detail {

/// Flushes `stream`. Returns the reason if anything written to it was lost, otherwise an empty string.
[[nodiscard]] inline std::string what_was_lost(std::ostream& stream, std::FILE* file) {
  errno = 0;
  const bool arrived = std::fflush(file) == 0 && std::ferror(file) == 0 && stream.flush().good();
  if (arrived) return {};
  return errno != 0 ? std::strerror(errno) : "an earlier write failed";
}

inline std::string& name_of_program() {
  static std::string name;
  return name;
}

inline void end_badly_if_output_was_lost() {
  const std::string out = what_was_lost(std::cout, stdout), err = what_was_lost(std::cerr, stderr);
  if (!out.empty())
    std::fprintf(stderr, "%s: cannot write to standard output: %s; the output is incomplete\n",
                 name_of_program().c_str(), out.c_str());
  if (!out.empty() || !err.empty()) std::_Exit(3);
}

}  // namespace detail

/// Call this first in `main`. The program then exits with 3, whatever its own exit code, if anything that it wrote to
/// standard output or standard error was lost, for example on a full disk or because the stream was closed
/// (`program >&-`). The number of a closed stream is occupied, so that no file of the program gets it and, with it, the
/// text meant for the stream.
inline void check_standard_streams(const char* program) {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      // Opened for the opposite direction, so that using it still fails. The system assigns the lowest free number.
      static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  detail::name_of_program() = program;
  std::atexit(detail::end_badly_if_output_was_lost);
}

}  // namespace examples
