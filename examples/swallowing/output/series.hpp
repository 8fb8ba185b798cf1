// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <vector>

#include "../../common/csv_writer.hpp"

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
  double contacts = 0;       ///< number of slaves that touch
  double penetration = 0;    ///< largest since the sample before, spacings

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

/// The samples in the file at `path`, none if there is no file. A last line that was cut short by the
/// end of the program that wrote it is left out. Throws `InputError` if it is no series of this program.
[[nodiscard]] inline std::vector<Sample> read_series(const std::filesystem::path& path) {
  std::vector<Sample> samples;
  if (!std::filesystem::exists(path)) return samples;
  std::string text = examples::read_file(path);
  text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  if (text.empty()) return samples;
  hmps::require(text.starts_with(std::string(Sample::header) + '\n'), path.string(),
                " is not a series of this program; remove it or choose another folder with --out");
  // A diverging run may leave inf and nan in its last lines, which are worth reading, too.
  for (std::size_t begin = text.find('\n') + 1; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    std::vector<double> row;
    for (const char *cell = text.data() + begin, *line_end = text.data() + end; cell < line_end; ++cell) {
      double value = 0;
      const auto [last, problem] = std::from_chars(cell, line_end, value);
      if (problem == std::errc()) row.push_back(value);
      cell = std::find(last, line_end, ',');
    }
    hmps::require(row.size() == Sample{}.values().size(), path.string(), " has a malformed line after ",
                  samples.size() + 1, " lines; remove the file or choose another folder with --out");
    samples.push_back(Sample::of(row));
    begin = end + 1;
  }
  return samples;
}

/// The time series of a case, series.csv. It can be read at any moment while the case runs.
class Series {
 public:
  /// Begins the series at `path`; or continues it behind its samples up to `resume_time`, the time of
  /// the checkpoint from which the run is resumed: later samples are dropped, as they come again.
  explicit Series(const std::filesystem::path& path, std::optional<double> resume_time = {})
      : samples_(resume_time ? kept(path, *resume_time) : std::vector<Sample>()),
        file_(path, Sample::header, resume_time.has_value() && std::filesystem::exists(path)) {}

  void add(const Sample& sample) {
    samples_.push_back(sample);
    file_.add(sample.values());
  }
  /// All samples since the start of the case, also those from before `resume_time`.
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }

 private:
  [[nodiscard]] static std::vector<Sample> kept(const std::filesystem::path& path, double resume_time) {
    std::vector<Sample> samples = read_series(path);
    // Half a nanosecond: far below any step, far above the rounding of a time.
    std::erase_if(samples, [&](const Sample& sample) { return sample.time > resume_time + 5e-10; });
    std::string text = std::string(Sample::header) + '\n';
    for (const Sample& sample : samples) text += examples::csv_line(sample.values());
    examples::write_atomically(path, text);
    return samples;
  }

  std::vector<Sample> samples_;
  examples::CsvWriter file_;
};

}  // namespace swallowing
