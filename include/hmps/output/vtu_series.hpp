// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/text_file.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/view.hpp"
#include "hmps/output/detail/xml_text.hpp"
#include "hmps/output/file_replacement.hpp"
#include "hmps/output/pvd_text.hpp"
#include "hmps/output/vtk_field.hpp"
#include "hmps/output/vtu_file.hpp"

namespace hmps::inline HMPS_ABI {

/// How a series of frames begins.
struct VtuSeriesSettings {
  /// The time in s at which a resumed run goes on: the frames up to this time that are listed already are kept, later
  /// ones are dropped. Without it, the series begins anew.
  std::optional<double> resume_at = {};
};

/// Frames of a run, which ParaView shows one after another: open `press.pvd` there.
///
///     VtuSeries frames("results/press.pvd");                       // makes the folder
///     VtuSeries frames("results/press.pvd", {.resume_at = t});     // goes on with it, from a checkpoint at time t
///     frames.add(t, x, {{vtk_field("velocity", v)}});              // writes results/press_00000.vtu, ...
///
/// Positions of a frame are in single or double precision, whichever it needs. The collection is complete at any
/// moment, so that a run can be watched while it goes on. Frames of an earlier run with the same name are overwritten
/// one by one, in a resumed run those that it dropped.
class VtuSeries {
 public:
  /// Begins the collection `path` (.pvd), or goes on with it. If it is not there yet, a resumed run begins it. A
  /// resumed run may write the frame at `resume_at` once more, in place of the one that was kept. Times of frames and
  /// `resume_at` are compared to 1e-8 of the latter: sums of up to ten million time steps differ by less from products,
  /// and the times of two steps by more.
  ///
  /// Throws `InputError` if its folder cannot be made or written to, for a name that does not end in .pvd, is not
  /// UTF-8, has control characters or is too long for those of its frames, for a `resume_at` that is not finite, and if
  /// the collection with which a resumed run should go on was damaged or is not from a series of this name.
  explicit VtuSeries(const std::filesystem::path& path, const VtuSeriesSettings& settings = {})
      : path_(std::filesystem::absolute(path)) {
    detail::require(path_.extension() == ".pvd", "hmps: ", path_.string(),
                    " should be a ParaView collection; end its name in .pvd");
    // The collection names its frames, so that ParaView would look for question marks.
    const std::string stem = path_.stem().string();
    detail::require(detail::xml_characters(stem) == stem, "hmps: the name of the ParaView collection ",
                    detail::printable(stem),
                    " has control characters or bytes that are not UTF-8; give it another name");
    if (settings.resume_at) resume(*settings.resume_at);
    std::error_code problem;
    std::filesystem::create_directories(path_.parent_path(), problem);
    detail::require(!problem, "hmps: cannot make the folder ", path_.parent_path().string(), ": ", problem.message(),
                    "; check its permissions");
    constexpr std::size_t many = 999'999'999;  // frames, whose number has the most digits
    detail::require(detail::name_fits(path_.parent_path() / file_of(many)), "hmps: the name of ", path_.string(),
                    " is too long for the file system: its frames would be called ", file_of(0),
                    " and so on, and .part is added while they are written; give a shorter name");
    replace_file(path_, pvd_text(frames_));
  }

  /// Writes a frame, as `write_vtu` does, at `time` in s, and adds it to the collection. Throws `InputError` as that
  /// does, for settings with another time, and for a time that is not later than that of the previous frame: ParaView
  /// would show only one of the two. Throws `StateError` if the collection is no longer as this series left it, for
  /// example because a second series writes to the same path.
  template <class T, int D>
  void add(double time, const VectorView<T, D>& x, const std::vector<VtkField>& fields = {},
           VtuSettings settings = {}) {
    // If the collection cannot be written, it stays as it is, and the frame can be added again.
    auto frames = frames_;
    if (!frames.empty() && std::abs(frames.back().first - time) <= again_) frames.pop_back();
    detail::require(frames.empty() || time > frames.back().first, "hmps: a frame of ", path_.string(), " at ", time,
                    " s follows one at ", frames.empty() ? 0.0 : frames.back().first,
                    " s; times must grow from frame to frame");
    detail::require(!settings.time || *settings.time == time, "hmps: a frame of ", path_.string(),
                    " is to be added at ", time, " s, but its settings have the time ", settings.time.value_or(0),
                    " s; leave that out, because `add` sets it");
    if (std::error_code missing; std::filesystem::exists(path_, missing))
      if (detail::read_text(path_.string()) != pvd_text(frames_))
        throw StateError(detail::message("hmps: ", path_.string(), " has changed since this series wrote its frame ",
                                         frames_.size(),
                                         "; another series or program writes to it: give each its own path"));
    settings.time = time;
    const std::string name = file_of(frames.size());
    write_vtu(path_.parent_path() / name, x, fields, settings);
    frames.emplace_back(time, name);
    replace_file(path_, pvd_text(frames));
    frames_ = std::move(frames);
    again_ = -1;
  }

  /// Time in s and file of every frame.
  [[nodiscard]] const std::vector<std::pair<double, std::string>>& frames() const { return frames_; }

 private:
  [[nodiscard]] std::string file_of(std::size_t frame) const {
    const std::string number = std::to_string(frame);
    return path_.stem().string() + '_' + std::string(5 - std::min<std::size_t>(number.size(), 5), '0') + number +
           ".vtu";
  }

  /// Takes over the frames up to `time`.
  void resume(double time) {
    detail::require(detail::is_finite(time), "hmps: ", path_.string(), " is to be resumed at ", time,
                    " s; give the time of the checkpoint");
    std::error_code missing;
    if (!std::filesystem::is_regular_file(path_, missing)) return;
    const std::string text = detail::read_text(path_.string());
    for (const double listed : detail::pvd_times(text)) frames_.emplace_back(listed, file_of(frames_.size()));
    bool increases = frames_.empty() || detail::is_finite(frames_.front().first);
    for (std::size_t k = 1; k < frames_.size(); ++k)
      increases = increases && detail::is_finite(frames_[k].first) && frames_[k - 1].first < frames_[k].first;
    detail::require(
        text == pvd_text(frames_) && increases, "hmps: ", path_.string(),
        " cannot be resumed: it is damaged, or was not written by a series of this name; put back the file of the "
        "interrupted run, or leave out resume_at to begin anew");
    again_ = 1e-8 * std::abs(time);
    while (!frames_.empty() && frames_.back().first > time + again_) frames_.pop_back();  // the times increase
    if (!frames_.empty() && frames_.back().first < time - again_) again_ = -1;
  }

  std::filesystem::path path_;
  std::vector<std::pair<double, std::string>> frames_;
  double again_ = -1;  // s, by how much the next frame may differ from the last one that it replaces; -1: none
};

}  // namespace hmps::inline HMPS_ABI
