// SPDX-License-Identifier: MIT
#include "output/fingerprint.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "../../common/files.hpp"

namespace swallowing {
namespace {

/// A number that changes with the text (FNV-1a).
std::uint64_t digest(std::string_view text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

}  // namespace

RunSettings fingerprint(const Options& options, const Case& chosen, const std::filesystem::path& data, double friction,
                        double first_step, double penalty) {
  const auto text = [](double value) {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%a", value);
    return std::string(digits);
  };
  RunSettings settings{{"case", std::string(chosen.name)},
                       {"scalar", options.single_precision ? "float" : "double"},
                       {"spacing", text(options.spacing)},
                       {"lattice shift", text(options.lattice_shift)},
                       {"region H", options.constrictors ? "yes" : "no"},
                       {"friction", text(friction)},
                       {"time step", text(first_step)},
                       {"share of the stable step", options.time_step > 0 ? "none" : text(options.step_share)},
                       {"penalty", text(penalty)}};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(data)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files)
    if (file.extension() == ".csv")
      settings.emplace_back("content of " + file.filename().string(),
                            std::to_string(digest(examples::read_file(file))));
  return settings;
}

}  // namespace swallowing
