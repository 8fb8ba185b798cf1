// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace swallowing {

/// The times in s of the paper's Figs 13 and 15: those of the panels of the sheet.
inline constexpr std::array<double, 9> picture_times{0, 0.5, 1.383, 1.583, 1.667, 1.677, 1.683, 1.7, 2.05};

/// How a particle moves, and therefore how it is drawn.
enum class Role : std::uint8_t {
  free,     ///< in the colour of its organ
  control,  ///< dark, a control region of elastic particles
  plate     ///< grey, region H, which acts by contact only
};

/// Everything that a picture needs of one moment. The three arrays of particles have equal size.
struct Snapshot {
  double time = 0;                              ///< s
  double spacing = 0;                           ///< m
  std::vector<std::array<float, 3>> positions;  ///< m, x posterior, z superior, y = 0 the midsagittal plane
  std::vector<std::uint8_t> organ;              ///< index into `organs`
  std::vector<Role> role;
  std::vector<std::string> organs;        ///< names: "tongue", "epiglottis", …
  std::array<double, 3> centre{}, tip{};  ///< of the epiglottis, m
  double tip_angle = 0;                   ///< degrees above the horizontal
};

/// The moments of a case that are kept for its sheet, as small files in `folder`, so that a run that
/// was stopped and resumed still draws all of them.
class Snapshots {
 public:
  /// Begins the snapshots of a case and removes those of an earlier run; or keeps those up to `resume_time`, the time
  /// of the checkpoint if the run is resumed.
  explicit Snapshots(const std::filesystem::path& folder, std::optional<double> resume_time = {});

  /// Keeps `snapshot` for the panel of `picture_times[panel]`.
  void add(std::size_t panel, const Snapshot& snapshot) const;
  /// The snapshot of a panel, nothing if that time was not reached.
  [[nodiscard]] std::optional<Snapshot> load(std::size_t panel) const;

 private:
  [[nodiscard]] std::filesystem::path file(std::size_t panel) const;
  std::filesystem::path folder_;
};

/// Draws sheet.png at `path`: the right half of the particles seen from the midsagittal plane, as the paper's Figs 13,
/// 15 and 16 show them, at all times that were reached. `title` is written above.
void draw_sheet(const std::filesystem::path& path, const Snapshots& snapshots, const std::string& title);

}  // namespace swallowing
