// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swallowing {

/// The times in s of which a case keeps a snapshot: those of the paper's Figs 13 to 17, and the end of the
/// constriction.
inline constexpr std::array<double, 11> snapshot_times{0,     0.5,   1.383, 1.583, 1.633, 1.667,
                                                       1.677, 1.683, 1.7,   1.85,  2.05};

/// How a particle moves, and therefore how it is drawn.
enum class Role : std::uint8_t {
  free,     ///< in the colour of its organ
  control,  ///< dark, a control region of elastic particles
  plate     ///< grey, region H, which acts by contact only
};

/// Everything that a picture needs of one moment. The four arrays of particles have equal size.
struct Snapshot {
  double time = 0;                              ///< s
  double spacing = 0;                           ///< m
  std::vector<std::array<float, 3>> positions;  ///< m, x posterior, z superior, y = 0 the midsagittal plane
  std::vector<std::uint8_t> organ;              ///< index into `organs`
  std::vector<Role> role;
  std::vector<std::uint8_t> region;       ///< index into `regions`, `no_region` if it belongs to none
  std::vector<std::string> organs;        ///< names: "tongue", "epiglottis", …
  std::vector<std::string> regions;       ///< names: "A", "B0", …; all plates of region H are one
  std::array<double, 3> centre{}, tip{};  ///< of the epiglottis, m
  double tip_angle = 0;                   ///< degrees above the horizontal

  static constexpr std::uint8_t no_region = 255;

  [[nodiscard]] const std::string& organ_of(std::size_t i) const { return organs.at(organ[i]); }
};

/// The snapshot that a case kept in `folder` at `time`, one of `snapshot_times`; nothing if that time was not reached.
/// Throws `InputError` if the file is damaged or was written by another version of this program.
[[nodiscard]] std::optional<Snapshot> load_snapshot(const std::filesystem::path& folder, double time);

/// The moments of a case that are kept for its pictures, as small files in `folder`, so that a run that was stopped and
/// resumed still draws all of them.
class Snapshots {
 public:
  /// Begins the snapshots of a case and removes those of an earlier run; or keeps those up to `resume_time`, the time
  /// of the checkpoint if the run is resumed.
  explicit Snapshots(const std::filesystem::path& folder, std::optional<double> resume_time = {});

  /// Keeps `snapshot` as that of `time`, one of `snapshot_times`.
  void add(double time, const Snapshot& snapshot) const;
  /// The snapshot of one of `snapshot_times`; nothing if that time was not reached.
  [[nodiscard]] std::optional<Snapshot> load(double time) const { return load_snapshot(folder_, time); }

 private:
  std::filesystem::path folder_;
};

}  // namespace swallowing
