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
#include <hmps/output/file_replacement.hpp>

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

/// Replaces the file at `path` by `bytes` as `hmps::replace_file` does, and flushes them to the disk before the new
/// file takes the place of the old one: also after a loss of power, either of them is there and complete. Throws
/// `InputError` with the reason if this fails.
inline void write_atomically(const fs::path& path, std::string_view bytes) {
  hmps::replace_file(path, bytes, [&](const fs::path& temporary) {
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CLOEXEC);
    const bool flushed = file >= 0 && ::fsync(file) == 0;
    const int reason = errno;
    if (file >= 0) ::close(file);
    require(flushed, "cannot write ", path.string(), " to the disk: ", std::strerror(reason),
            "; check the free space of the output folder");
  });
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
