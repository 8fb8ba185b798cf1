// SPDX-License-Identifier: MIT
#include "output/fingerprint.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "../../common/csv_writer.hpp"
#include "output/digest.hpp"

namespace swallowing {
namespace {

/// Adds the contents of the tracks of the motion.
void add_tracks(RunSettings& settings, const std::filesystem::path& data) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(data)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files)
    if (file.extension() == ".csv")
      settings.emplace_back(std::string(track_setting) + file.filename().string(),
                            std::to_string(Digest(examples::read_file(file)).value()));
}

/// Whether a lattice or fitted particles, and which: another fit of the same spacing is another body.
[[nodiscard]] std::string particles(const FittedOrgans* fitted) {
  if (fitted == nullptr) return "lattice";
  Digest digest;
  for (const Point& place : fitted->particles.positions)
    digest.add({reinterpret_cast<const char*>(place.data()), 3 * sizeof(double)});
  return "fitted " + std::to_string(digest.value());
}

}  // namespace

RunSettings fingerprint(const Options& options, const Case& chosen, const FittedOrgans* fitted,
                        const std::filesystem::path& data, double friction, double first_step, double penalty) {
  const auto text = [](double value) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%a", value);
    return std::string(digits);
  };
  RunSettings settings{{"case", std::string(chosen.name)},
                       {"scalar", options.single_precision ? "float" : "double"},
                       {"spacing", text(options.spacing)},
                       {"particles", particles(fitted)},
                       {"lattice shift", text(options.lattice_shift)},
                       {"region H", options.constrictors ? "yes" : "no"},
                       {"friction", text(friction)},
                       {"stiffness", text(options.stiffness)},
                       {"time step", text(first_step)},
                       {"share of the stable step", options.time_step > 0 ? "none" : text(options.step_share)},
                       {"contact", options.paper_contact ? "paper" : "smooth"},
                       {"penalty", text(penalty)}};
  add_tracks(settings, data);
  return settings;
}

RunSettings shared_settings(const Options& options) {
  const auto text = [](double value) { return examples::to_text(value); };
  RunSettings settings{{"scalar", options.single_precision ? "float" : "double"},
                       {"spacing", text(options.spacing)},
                       {"particles", options.fitted ? "fitted" : "lattice"},
                       {"lattice shift", text(options.lattice_shift)},
                       {"region H", options.constrictors ? "yes" : "no"},
                       {"friction", options.friction ? text(*options.friction) : "of the case"},
                       {"stiffness", text(options.stiffness)},
                       {"time step", options.time_step > 0 ? text(options.time_step)
                                                           : text(options.step_share) + " of the largest stable one"},
                       {"contact", options.paper_contact ? "paper" : "smooth"},
                       {"penalty", options.penalty ? text(*options.penalty) : "of the materials"},
                       {"penalty ratio", options.penalty_ratio ? text(*options.penalty_ratio) : "none"}};
  add_tracks(settings, data_folder(options));
  return settings;
}

}  // namespace swallowing
