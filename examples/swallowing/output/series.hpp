// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "output/time_table.hpp"

namespace swallowing {

/// One line of series.csv.
struct Sample {
  double time = 0;               ///< s
  double tip_angle = 0;          ///< degrees above the horizontal, from the centre to the tip of the epiglottis
  double base_angle = 0;         ///< degrees above the horizontal, from its base to its tip
  double kinetic_energy = 0;     ///< J
  double strain_energy = 0;      ///< J
  double artificial_energy = 0;  ///< J
  double smallest_j = 1;         ///< of all free particles
  double largest_j = 1;
  double mean_j = 1;
  double largest_speed = 0;  ///< m/s
  double contacts = 0;       ///< number of slaves in contact
  double penetration = 0;    ///< largest since the previous sample, spacings

  static constexpr const char* header =
      "time,tip_angle,base_angle,kinetic_energy,strain_energy,artificial_energy,smallest_j,largest_j,mean_j,"
      "largest_speed,contacts,penetration";
  [[nodiscard]] std::array<double, 12> values() const {
    return {time,       tip_angle, base_angle, kinetic_energy, strain_energy, artificial_energy,
            smallest_j, largest_j, mean_j,     largest_speed,  contacts,      penetration};
  }
  [[nodiscard]] static Sample of(const std::vector<double>& v) {
    return {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9], v[10], v[11]};
  }
};

/// The samples in the file at `path`, none if there is no file. Ignores a last line that was cut short because the
/// program that wrote it ended. Throws `InputError` if the file is not a series of this program.
[[nodiscard]] inline std::vector<Sample> read_series(const std::filesystem::path& path) {
  std::vector<Sample> samples;
  for (const auto& row : read_table(path, Sample::header)) samples.push_back(Sample::of(row));
  return samples;
}

/// The time series of a case, series.csv.
class Series {
 public:
  /// Begins the series at `path`, or continues it; throws as `TimeTable` does.
  explicit Series(const std::filesystem::path& path, const std::optional<TableMark>& resumed = {})
      : table_(path, Sample::header, resumed) {
    for (const auto& row : table_.rows()) samples_.push_back(Sample::of(row));
  }

  void add(const Sample& sample) {
    samples_.push_back(sample);
    table_.add(sample.values());
  }
  /// All samples since the start of the case, including those from before it was resumed.
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }
  /// See `TimeTable::flush_to_disk`.
  [[nodiscard]] TableMark flush_to_disk() { return table_.flush_to_disk(); }

 private:
  TimeTable table_;
  std::vector<Sample> samples_;
};

}  // namespace swallowing
