// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <hmps/core/error.hpp>

#include "error.hpp"

/// Helpers that the example programs share. They are not part of the library.
namespace examples {

namespace fs = std::filesystem;

/// Flushes the entries of the folder at `path` to the disk, such as a file that was created or renamed in it. After a
/// loss of power, a flushed file is lost if its folder entry is not on the disk.
inline void flush_folder(const fs::path& path) {
  const int folder = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool flushed = folder >= 0 && (::fsync(folder) == 0 || errno == EINVAL);  // EINVAL: not needed
  const int reason = errno;
  if (folder >= 0) ::close(folder);
  require(flushed, "cannot write the folder ", path.string(), " to the disk: ", std::strerror(reason));
}

/// Replaces the file at `path` by `bytes` atomically: at any moment, also after kill -9 or a loss of power, either the
/// old or the new file is there and complete. The new file is written beside the old one, flushed to the disk, then
/// renamed. Throws `InputError` with the reason if this fails.
inline void write_atomically(const fs::path& path, std::string_view bytes) {
  const fs::path temporary = path.string() + ".part";
  const auto fail = [&](const char* what) {
    throw hmps::InputError(message("cannot ", what, " ", path.string(), ": ", std::strerror(errno),
                                   "; check the permissions and the free space of the output folder"));
  };
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail("write");
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      ::close(file);
      fail("write");
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  const bool flushed = ::fsync(file) == 0;
  if (::close(file) != 0 || !flushed) fail("write");
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail("replace");
}

/// The bytes of the file at `path`. Throws `InputError` if it cannot be read.
[[nodiscard]] inline std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  require(static_cast<bool>(file), "cannot read ", path.string(), ": ", std::strerror(errno));
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  require(!file.bad(), "cannot read ", path.string(), " to its end: ", std::strerror(errno));
  return bytes;
}

/// Creates the folder at `path` if it is missing and checks that files can be written there, so that a long run does
/// not fail at its first write. Throws `InputError` that names the folder.
inline void prepare_folder(const fs::path& path) {
  std::error_code problem;
  fs::create_directories(path, problem);
  require(fs::is_directory(path), "cannot make the output folder ", path.string(), ": ",
          problem ? problem.message() : "a file of that name is in the way", "; choose another one with --out");
  const fs::path probe = path / ".writable";
  std::ofstream file(probe);
  file << "probe\n";
  file.close();
  const bool written = static_cast<bool>(file);
  const std::string reason = written ? "" : std::strerror(errno);
  fs::remove(probe, problem);
  require(written, "cannot write to the output folder ", path.string(), ": ", reason,
          "; choose another one with --out or change its permissions");
}

}  // namespace examples
