// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <string>

#include "error.hpp"
#include "files.hpp"

namespace examples {

/// Locks a folder during its lifetime against other processes and threads that use the same lock: two runs that write
/// into one folder would overwrite each other's results. The system releases the lock however the process ends.
class FolderLock {
 public:
  enum class Taken { fail, wait };

  /// Locks the folder at `path`, which must exist, by its file .lock. If another process has locked it, throws an
  /// `InputError` that names folder and process, or writes a message to standard error and waits until the lock is
  /// free. If the file system has no locks, writes a message to standard error and continues without one.
  explicit FolderLock(const fs::path& path, Taken taken = Taken::fail) {
    const fs::path name = path / ".lock";
    file_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    require(file_ >= 0, "cannot write ", name.string(), ": ", std::strerror(errno),
            "; check the permissions of the output folder");
    int problem = lock(LOCK_EX | LOCK_NB);
    if (problem == EWOULDBLOCK) {
      const std::string owner = content();
      const std::string what = message("the folder ", path.string(), " is being written by another run",
                                       owner.empty() ? "" : message(" (process ", owner, ")"));
      if (taken == Taken::fail) {
        ::close(file_);
        throw hmps::InputError(message(what, "; wait for its end, or choose another folder with --out"));
      }
      std::cerr << message(what, "; waiting for it\n") << std::flush;
      problem = lock(LOCK_EX);
    }
    if (problem != 0)
      std::cerr << message("warning: cannot lock ", name.string(), ": ", std::strerror(problem),
                           "; see yourself that no other run writes there\n");
    const std::string process = std::to_string(::getpid());
    // Only for the message above; the lock does not depend on it.
    if (::ftruncate(file_, 0) == 0) static_cast<void>(::pwrite(file_, process.data(), process.size(), 0) == 0);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() { ::close(file_); }

 private:
  /// Returns 0 when the lock is taken, otherwise the error number.
  [[nodiscard]] int lock(int how) const {
    int problem = 0;
    do problem = ::flock(file_, how) == 0 ? 0 : errno;
    while (problem == EINTR);
    return problem;
  }
  [[nodiscard]] std::string content() const {
    std::array<char, 32> text{};
    const ssize_t size = ::pread(file_, text.data(), text.size(), 0);
    return {text.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
  }
  int file_ = -1;
};

}  // namespace examples
