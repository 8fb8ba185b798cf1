// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/checkpoint.hpp"

namespace swallowing {

/// How well a case kept its volume: det F of the free particles at 1.667 s.
struct DetF {
  double mean = 0;
  double share_within_0_98_1_02 = 0;
  double min = 0;
  double max = 0;
};

/// How close to instability a case came, according to the estimates of the largest stable step without contact.
struct NearestToLimit {
  double share = 0;            ///< largest ratio of a step to the limit
  double limit = 0;            ///< s, the limit at that time
  double time = 0;             ///< s, the time of that step
  std::uint64_t particle = 0;  ///< the one that set the limit
  std::string organ;           ///< of that particle
};

/// The summary of a case that was run: the contents of its summary.json, under these names.
struct Summary {
  std::string case_name;  ///< "case" in the file
  std::string scalar = "double";
  int threads = 1;
  double spacing = 0;  ///< m
  double friction = 0;
  double penalty = 0;                              ///< k in N/m4
  bool paper_contact = false;                      ///< --contact paper
  double time_step = 0;                            ///< s, on average
  double time_step_min = 0, time_step_max = 0;     ///< s
  double time_step_limit = 0;                      ///< s, the estimate of the largest stable step at rest
  std::optional<NearestToLimit> nearest_to_limit;  ///< nothing before the first step
  std::uint64_t steps = 0;
  double time = 0;  ///< s, simulated
  std::uint64_t particles_free = 0;
  std::uint64_t particles_control = 0;
  std::optional<double> fold_time;       ///< s, line from the centre to the tip of the epiglottis
  std::optional<double> fold_time_base;  ///< s, line from its base to its tip
  double tip_angle_min = 0;              ///< degrees
  std::optional<DetF> det_f;             ///< nothing if the run ended before 1.667 s
  double max_penetration = 0;            ///< spacings
  double wall_seconds = 0;
  double particle_steps_per_second = 0;
  double contact_share = 0;  ///< of the wall clock
  /// The same for each simulated tenth of a second: free motion, the squeeze, and what is between.
  std::vector<double> contact_share_per_tenth;
  std::optional<std::string> failure;  ///< why the run ended early
  RunSettings settings;                ///< see `shared_settings`
};

/// Writes `summary` as JSON, atomically. Values that are missing or not finite become null.
void write_summary(const std::filesystem::path& path, const Summary& summary);

/// Reads what `write_summary` wrote; nothing if there is no such file.
[[nodiscard]] std::optional<Summary> read_summary(const std::filesystem::path& path);

}  // namespace swallowing
