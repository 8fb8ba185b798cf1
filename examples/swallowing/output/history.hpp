// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "../../common/error.hpp"
#include "output/checkpoint.hpp"
#include "output/frames.hpp"
#include "output/series.hpp"
#include "output/snapshots.hpp"

namespace swallowing {

/// The record of a run that its folder keeps: the series, the contacts, the snapshots for its pictures, and frames. A
/// checkpoint holds the state alone. Therefore it is written after all of these are on the disk and records how far
/// they had come, and a run is resumed only if they are still unchanged up to there.
struct History {
  Series series;
  TimeTable contacts;
  Snapshots snapshots;
  std::optional<Frames> frames, surfaces;

  /// Begins anew and removes what an earlier run has left; or continues after the checkpoint `resumed`. Throws
  /// `InputError` if anything from before it is lost or changed. `with_frames` and `with_surfaces`: whether frames of
  /// particles and of surfaces are written.
  History(const std::filesystem::path& folder, const std::string& contacts_header, bool with_frames, bool with_surfaces,
          const std::optional<Checkpoint>& resumed)
      : series(begin(folder, resumed) / "series.csv", mark("series", resumed)),
        contacts(folder / "contacts.csv", contacts_header, mark("contacts", resumed)),
        snapshots(folder / "snapshots", time(resumed)) {
    if (resumed)
      for (const double moment : snapshot_times)
        examples::require(moment > resumed->time + 5e-10 || snapshots.load(moment), "in ",
                          (folder / "snapshots").string(), " the moment at ", moment,
                          " s, before the checkpoint, is missing; put its file back, or start anew without --resume");
    if (resumed) frames_before_ = resumed->value<std::uint64_t>("frames");
    if (resumed) surfaces_before_ = resumed->value<std::uint64_t>("surfaces");
    if (with_frames) frames.emplace(folder, time(resumed), frames_before_);
    if (with_surfaces) surfaces.emplace(folder, time(resumed), surfaces_before_, "surface");
  }

  /// Writes everything to the disk, and records in `checkpoint` how far it has come.
  void flush(Checkpoint& checkpoint) {
    checkpoint.set("series", std::array{series.flush_to_disk()});
    checkpoint.set("contacts", std::array{contacts.flush_to_disk()});
    checkpoint.set("frames", std::uint64_t{frames ? frames->list().size() : frames_before_});
    checkpoint.set("surfaces", std::uint64_t{surfaces ? surfaces->list().size() : surfaces_before_});
  }

 private:
  /// Removes what is no longer true once the run has begun; first of all the checkpoint, from which a run would be
  /// resumed.
  static const std::filesystem::path& begin(const std::filesystem::path& folder,
                                            const std::optional<Checkpoint>& resumed) {
    for (const char* file : {"checkpoint.bin", "summary.json", "sheet.png", "surfaces.png", "rear.png", "sections.png",
                             "frames.pvd", "surfaces.pvd"})
      if (!resumed) std::filesystem::remove(folder / file);
    return folder;
  }
  [[nodiscard]] static std::optional<TableMark> mark(const std::string& table,
                                                     const std::optional<Checkpoint>& resumed) {
    if (!resumed) return std::nullopt;
    return resumed->value<TableMark>(table);
  }
  [[nodiscard]] static std::optional<double> time(const std::optional<Checkpoint>& resumed) {
    if (!resumed) return std::nullopt;
    return resumed->time;
  }

  std::uint64_t frames_before_ = 0, surfaces_before_ = 0;  ///< of the run that is resumed
};

}  // namespace swallowing
