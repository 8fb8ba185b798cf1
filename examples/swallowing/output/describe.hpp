// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "../../common/error.hpp"
#include "output/summary.hpp"
#include "scene/organs.hpp"
#include "scene/regions.hpp"
#include "scene/scene.hpp"
#include "simulation/simulation.hpp"

/// What a run reports on its scene before it starts, one line of text each.
namespace swallowing {

/// The numbers of particles, the step, and what limits it.
template <class S>
[[nodiscard]] std::string describe_step(const Summary& summary, const Simulation<S>& simulation, const Scene& scene,
                                        bool step_is_given) {
  const auto& limit = simulation.step_limit();
  const double share = simulation.time_step() / limit.limit;
  return examples::message(summary.case_name, ": ", summary.particles_free, " free and ", summary.particles_control,
                           " control particles; step ", 1e6 * simulation.time_step(),
                           step_is_given ? " us, " : " us at first, ", std::round(100 * share),
                           " % of the limit at rest; ", simulation.limited_by(), " (",
                           name(scene.organ[limit.particle]), ")\n");
}

/// The number of particles of each control region; regions with the same name are counted together.
[[nodiscard]] inline std::string describe_regions(const Summary& summary, const Scene& scene) {
  const auto particles = scene.particles_of_regions();
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (std::size_t r = 0; r < particles.size(); ++r) {
    const Region& region = scene.regions[r];
    const std::string name = region.kind == Region::door ? "H" : region.name;
    auto at = std::find_if(counts.begin(), counts.end(), [&](const auto& count) { return count.first == name; });
    if (at == counts.end()) at = counts.insert(counts.end(), {name, 0});
    at->second += particles[r].size();
  }
  std::string text = examples::message(summary.case_name, ": particles of the control regions");
  const char* separator = ": ";
  for (const auto& [name, count] : counts) text += examples::message(std::exchange(separator, ", "), name, " ", count);
  return text + '\n';
}

}  // namespace swallowing
