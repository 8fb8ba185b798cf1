// SPDX-License-Identifier: MIT
#pragma once

// The surface of a fitted wall, as contact sees it, if the layers lie closer together or farther apart than a spacing.
#include <algorithm>
#include <cmath>
#include <string>

#include "report/table.hpp"
#include "report/text.hpp"
#include "walls/block.hpp"
#include "walls/slides.hpp"

namespace walls {

/// Fitted walls of two layers, on average over the angles and in the worst case.
[[nodiscard]] inline Table layers() {
  Table table{"layers",
              {"Layer spacing, l0", "Surface", "Offset, mean, l0", "Offset, largest, l0", "Bumps, largest, l0",
               "Drag without friction", "Error of friction"}};
  const auto signed_places = [](double value) { return (value > 0 ? "+" : "") + places(value); };
  for (const double apart : {0.8, 1.0, 1.2})
    for (const bool raised : {false, true}) {
      double mean = 0, largest = 0, bumps = 0;
      for (const double degrees : angles) {
        const Wall wall{.degrees = degrees, .made = Made::fitted, .layers = 2, .layer_spacing = apart};
        const Relief found = relief_of<hmps::SmoothMetaball>(wall, raised);
        mean += found.offset / static_cast<double>(angles.size());
        bumps = std::max(bumps, found.bumps);
        if (std::abs(found.offset) > std::abs(largest)) largest = found.offset;
      }
      std::string drag, error;
      for (double most_drag = 0, most_error = 0; const double degrees : {0., 22.5}) {
        if (raised) break;
        Scene scene{.degrees = degrees, .made = Made::fitted, .layers = 2, .layer_spacing = apart};
        most_drag = std::max(most_drag, std::abs(run<hmps::SmoothMetaball, hmps::CorrectedFriction>(scene).friction));
        scene.friction = mu;
        const double friction = run<hmps::SmoothMetaball, hmps::CorrectedFriction>(scene).friction;
        most_error = std::max(most_error, std::abs(friction / mu - 1));
        drag = places(most_drag, 4), error = percent(most_error);
        table.check(most_drag < 0.01 && most_error < 0.01,
                    "layers " + digits(apart) + " l0 apart: the errors of drag and friction are 1 % at most");
      }
      table.rows.push_back({digits(apart), raised ? "raised" : "fitted", signed_places(mean), signed_places(largest),
                            places(bumps), drag, error});
      table.check(raised || std::abs(mean) < 0.05,
                  "layers " + digits(apart) + " l0 apart: a wall is where it is drawn");
    }
  return table;
}

}  // namespace walls
