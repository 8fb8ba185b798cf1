// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <hmps/core/error.hpp>
#include <iostream>
#include <string>

#include "../../common/error.hpp"
#include "output/summary.hpp"
#include "scene/organs.hpp"
#include "scene/scene.hpp"
#include "simulation/simulation.hpp"

namespace swallowing {

/// Watches how close the steps of a run come to the limit of stability, records it in the summary, and lets the steps
/// follow the limit.
template <class S>
class StepWatch {
 public:
  StepWatch(Simulation<S>& simulation, const Scene& scene, Summary& summary, bool step_is_given)
      : simulation_(simulation), scene_(scene), summary_(summary), step_is_given_(step_is_given) {}

  /// Records how close the step is to the limit, and warns if it is beyond.
  void compare(double time) {
    const auto& now = simulation_.step_limit();
    const double step = simulation_.time_step(), share = step / now.limit;
    auto& nearest = summary_.nearest_to_limit;
    const bool was_stable = !nearest || nearest->share <= 1;
    if (!nearest || share > nearest->share)
      nearest = NearestToLimit{share, now.limit, time, now.particle, organ_of_limit()};
    if (was_stable && share > 1)
      std::cerr << examples::message(summary_.case_name, ": at ", time, " s the step of ", 1e6 * step,
                                     " us is beyond the limit of ", 1e6 * now.limit, " us that particle ", now.particle,
                                     " (", nearest->organ, ") sets; try a smaller ",
                                     step_is_given_ ? "--time-step\n" : "--step-share\n");
  }
  /// Updates the limit, compares the step with it, and lets the coming steps follow it. Throws `StateError` if the
  /// limit has all but vanished, since the run would never end.
  void refresh(double time) {
    simulation_.refresh_step_limit();
    compare(time);
    const auto& now = simulation_.step_limit();
    if (now.limit < least_limit * summary_.time_step_limit)
      throw hmps::StateError(examples::message(
          "at ", time, " s the largest stable step has fallen to ", 1e6 * now.limit, " us, from ",
          1e6 * summary_.time_step_limit, " us at rest: particle ", now.particle, " of the ", organ_of_limit(),
          " is crushed or torn; try a finer --spacing, or a gentler motion (--data)"));
    simulation_.follow_step_limit();
    summary_.time_step_min = std::min(summary_.time_step_min, simulation_.time_step());
    summary_.time_step_max = std::max(summary_.time_step_max, simulation_.time_step());
  }

 private:
  static constexpr double least_limit = 0.05;  // as a share of the limit at rest

  [[nodiscard]] std::string organ_of_limit() const {
    return std::string(name(scene_.organ[simulation_.step_limit().particle]));
  }

  Simulation<S>& simulation_;
  const Scene& scene_;
  Summary& summary_;
  bool step_is_given_;
};

}  // namespace swallowing
