// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../../common/error.hpp"
#include "../../common/vtu.hpp"

namespace swallowing {

/// The frames of a case for ParaView: `folder`/frames.pvd lists the files in `folder`/frames, or those of another kind,
/// such as surfaces. The list is complete at any moment, so that a run can be watched while it goes on.
class Frames {
 public:
  /// Begins the frames of a case and removes those of an earlier run; or, if the run is resumed from a checkpoint at
  /// `resume_time`, continues after the `before` frames up to that time. `kind`: what each frame is. Throws
  /// `InputError` if any of these is missing.
  explicit Frames(const std::filesystem::path& folder, std::optional<double> resume_time = {}, std::size_t before = 0,
                  std::string kind = "frame")
      : folder_(folder), kind_(std::move(kind)) {
    namespace fs = std::filesystem;
    if (resume_time && before > 0) read(*resume_time, before);
    const std::string files = kind_ + "s/";
    fs::create_directories(folder_ / files);
    for (const auto& entry : fs::directory_iterator(folder_ / files)) {
      const std::string name = files + entry.path().filename().string();
      const bool listed = std::any_of(frames_.begin(), frames_.end(), [&](const auto& f) { return f.second == name; });
      if (!listed && name.starts_with(files + kind_ + '_')) fs::remove(entry.path());
    }
    write_list();
  }

  /// Writes the particles at `time` in s: `positions` in m, and any fields; or a surface if there are `triangles`
  /// between these positions.
  void add(double time, const examples::Field& positions, std::span<const examples::Field> fields,
           std::span<const std::array<hmps::Index, 3>> triangles = {}) {
    char number[16];
    std::snprintf(number, sizeof(number), "%05zu", frames_.size());
    const std::string name = kind_ + "s/" + kind_ + '_' + number + ".vtu";
    examples::write_atomically(folder_ / name, examples::vtu(positions, fields, time, triangles));
    frames_.emplace_back(time, name);
    write_list();
  }
  /// Time in s and file of every frame.
  [[nodiscard]] const std::vector<std::pair<double, std::string>>& list() const { return frames_; }

 private:
  [[nodiscard]] std::filesystem::path list_file() const { return folder_ / (kind_ + "s.pvd"); }
  void write_list() const { examples::write_atomically(list_file(), examples::pvd(frames_)); }

  /// Reads the list that `write_list` wrote.
  void read(double resume_time, std::size_t before) {
    const auto list = list_file();
    const std::string text = std::filesystem::exists(list) ? examples::read_file(list) : std::string();
    const auto attribute = [&](const std::string& name, std::size_t from) {
      const std::size_t begin = text.find(name + "=\"", from) + name.size() + 2;
      return text.substr(begin, text.find('"', begin) - begin);
    };
    for (std::size_t at = text.find("<DataSet"); at != std::string::npos; at = text.find("<DataSet", at + 1)) {
      const std::string time_text = attribute("timestep", at);
      double time = 0;
      std::from_chars(time_text.data(), time_text.data() + time_text.size(), time);
      if (time <= resume_time + 5e-10) frames_.emplace_back(time, attribute("file", at));
    }
    const char* remedy = "; put it back, resume with --no-frames, or start anew without --resume";
    examples::require(frames_.size() == before, list.string(), " lists ", frames_.size(), " of the ", before, ' ',
                      kind_, "s that were written before the checkpoint", remedy);
    for (const auto& [time, file] : frames_)
      examples::require(std::filesystem::exists(folder_ / file), (folder_ / file).string(),
                        " is missing, which was written before the checkpoint", remedy);
  }

  std::filesystem::path folder_;
  std::string kind_;
  std::vector<std::pair<double, std::string>> frames_;
};

}  // namespace swallowing
