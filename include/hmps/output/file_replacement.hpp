// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// The name under which `replace_file` writes `path` before it renames it.
[[nodiscard]] inline std::filesystem::path temporary_of(std::filesystem::path path) { return path += ".part"; }

/// Whether the file system accepts the temporary name of `path`, whose folder must exist.
[[nodiscard]] inline bool name_fits(const std::filesystem::path& path) {
  std::error_code problem;
  (void)std::filesystem::symlink_status(temporary_of(path), problem);
  return problem != std::errc::filename_too_long;
}

}  // namespace detail

/// Replaces the contents of the file at `path` with `bytes`, or makes it: writes them beside it as `path`.part, which
/// it then renames, so that a reader finds either the whole old file or the whole new one, even if the program is
/// killed meanwhile. Follows symbolic links at `path`, also to a file that does not exist yet, but replaces whatever
/// file or link bears the temporary name. On an error the old file remains, and the temporary one does not. Only one
/// writer at a time may replace a file.
///
/// Does not wait until the data are on the disk: a loss of power may cost the latest files. For a file that must
/// outlast it, such as a checkpoint, `before_rename` can flush the temporary file, whose name it is given, to the disk;
/// an exception of it counts as an error.
///
/// Throws `InputError` with the name and the reason if the file cannot be written, for example because its folder is
/// missing, the disk is full or the temporary name is too long, and if `path` exists and is not a regular file: a
/// program that is run by root would otherwise replace a device by a file.
inline void replace_file(std::filesystem::path path, std::string_view bytes,
                         const std::function<void(const std::filesystem::path&)>& before_rename = {}) {
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  detail::require(!std::filesystem::exists(status) || std::filesystem::is_regular_file(status), "hmps: cannot replace ",
                  path.string(), ": it is not a regular file; give the name of a file");
  constexpr int most_links = 40;
  for (int links = 0; std::filesystem::is_symlink(std::filesystem::symlink_status(path, problem)); ++links) {
    detail::require(links < most_links, "hmps: cannot replace ", path.string(),
                    ": links lead in a circle; remove them");
    path = path.parent_path() / std::filesystem::read_symlink(path, problem);  // an absolute target replaces the folder
  }
  detail::require(detail::name_fits(path), "hmps: cannot write ", path.string(),
                  ": its name is too long for the file system with the .part that is added while it is written; give "
                  "a shorter name");
  const std::filesystem::path temporary = detail::temporary_of(path);
  const auto fail = [&](const char* what, const std::string& reason) {
    std::filesystem::remove(temporary, problem);
    detail::throw_input_error({"hmps: cannot ", what, " ", path.string(), ": ", reason,
                               "; check that its folder exists, its permissions and the free space"});
  };
  // Written through, a link under that name would overwrite the file to which it leads, and then take the place of
  // `path`.
  if (!std::filesystem::is_directory(std::filesystem::symlink_status(temporary, problem)))
    std::filesystem::remove(temporary, problem);
  errno = 0;
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) fail("write", errno != 0 ? std::generic_category().message(errno) : "the file system does not say why");
  try {
    if (before_rename) before_rename(temporary);
  } catch (...) {
    std::filesystem::remove(temporary, problem);
    throw;
  }
  std::filesystem::rename(temporary, path, problem);
  if (problem) fail("replace", problem.message());
}

}  // namespace hmps::inline HMPS_ABI
