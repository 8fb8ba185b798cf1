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

/// Flushes the standard streams. Returns why something that was written to `stream` never arrived; empty if all did.
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
    std::fprintf(stderr, "%s: cannot write to standard output: %s; what it was to say is lost\n",
                 name_of_program().c_str(), out.c_str());
  if (!out.empty() || !err.empty()) std::_Exit(3);
}

}  // namespace detail

/// To be called first in `main`: makes the program end with 3, however it ends otherwise, where something that it wrote
/// to standard output or standard error did not arrive, such as on a full disk. A standard stream that was closed
/// (`program >&-`) is such a case too. Its number is taken, so that no file of the program gets it, and with it what
/// was meant for the stream.
inline void check_standard_streams(const char* program) {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF)
      // Opened the wrong way round, so that its use fails as before. The lowest free number is the one that is given.
      static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  detail::name_of_program() = program;
  std::atexit(detail::end_badly_if_output_was_lost);
}

}  // namespace examples
