// SPDX-License-Identifier: MIT
#pragma once

// Whether friction holds a free block on an incline.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "report/table.hpp"
#include "report/text.hpp"
#include "walls/block.hpp"
#include "walls/slides.hpp"

namespace walls {

inline constexpr double steep_mu = 0.3, holding = 10, sliding = 20;  // -, degrees, degrees

/// A free block on an incline: does it stay where friction should hold it, and otherwise slide with the right
/// acceleration?
[[nodiscard]] inline Table friction(bool quick) {
  Table table{"friction",
              {"Metaball", "Law", "Surface", "Angle", "Creep where it should hold, l0",
               "Speed where it should hold, m/s", "Error of the acceleration, m/s2"}};
  const double slope = sliding * std::numbers::pi / 180;
  const double exact = gravity * (std::sin(slope) - steep_mu * std::cos(slope));
  double paper_creep = 0, creep = 0;
  const auto add = [&](const std::string& kernel, const std::string& law, auto run_scene) {
    for (const Made made : {Made::cut, Made::raised, Made::fitted})
      for (const double degrees : angles_of(made, Part::wall, quick)) {
        if (quick && (degrees == 0 || (made != Made::cut && law != "corrected"))) continue;
        const auto at = [&](double incline) {
          return run_scene(Scene{.degrees = degrees, .made = made, .friction = steep_mu, .incline = incline});
        };
        const Outcome held = at(holding), slid = at(sliding);
        table.rows.push_back({kernel, law, skin(made, degrees), digits(degrees), digits(held.moved / spacing, 2),
                              digits(held.shaking, 2), places(slid.acceleration - exact)});
        const std::string wall = kernel + " metaball, " + law + " law, " + digits(degrees) + " degrees";
        if (kernel == "smooth" && law == "corrected") creep = std::max(creep, std::abs(held.moved / spacing));
        if (kernel == "smooth" && law == "paper's") paper_creep = std::max(paper_creep, std::abs(held.moved / spacing));
        if (kernel == "smooth" && made != Made::cut)
          table.check(std::abs(slid.acceleration - exact) < 0.1 * exact,
                      wall + ": with a raised or fitted surface the acceleration is right to a tenth");
      }
  };
  add("smooth", "corrected", run<hmps::SmoothMetaball, hmps::CorrectedFriction>);
  add("smooth", "paper's", run<hmps::SmoothMetaball, hmps::PaperFriction>);
  if (!quick) add("paper", "paper's", run<hmps::PaperMetaball, hmps::PaperFriction>);
  table.check(creep < 0.01, "the corrected law holds the block within a hundredth of a spacing on every wall");
  table.check(creep < 0.3 * paper_creep, "the corrected law holds the block better than the paper's");
  return table;
}

/// The drift in um/s of a block on an incline at 95 % of the friction limit: on the wall along its lattice, and the
/// largest on the walls as cut, on the raised and on the fitted walls.
struct Drift {
  double along = 0, cut = 0, raised = 0, fitted = 0;
};
template <class Friction>
[[nodiscard]] Drift drift_at_the_limit(double coefficient, bool viscous, bool quick) {
  Drift drift;
  const double incline = std::atan(0.95 * coefficient) * 180 / std::numbers::pi;
  for (const Made made : {Made::cut, Made::raised, Made::fitted})
    for (const double degrees : angles_of(made, Part::wall, quick)) {
      if (degrees == 22.5 || (degrees == 0 && (quick || made == Made::fitted))) continue;
      const Outcome held = run<hmps::SmoothMetaball, Friction>({.degrees = degrees,
                                                                .made = made,
                                                                .friction = coefficient,
                                                                .incline = incline,
                                                                .viscous = viscous,
                                                                .settled = 0.3});
      double& largest = made == Made::fitted   ? drift.fitted
                        : made == Made::raised ? drift.raised
                        : degrees == 0         ? drift.along
                                               : drift.cut;
      largest = std::max(largest, 1e6 * std::abs(held.moved) / measured);
    }
  return drift;
}

/// Which friction law holds a block for long?
[[nodiscard]] inline Table limit(bool quick) {
  Table table{
      "limit",
      {"Law", "Viscosity, m2/s", "mu", "Along the lattice, um/s", "As cut, um/s", "Raised, um/s", "Fitted, um/s"}};
  const auto rounded = [](double drift) { return drift < 10 ? digits(drift, 2) : places(drift, 0); };
  const auto add = [&](const std::string& law, bool viscous, auto drift_of) {
    for (const double coefficient : {0.1, 0.3, 0.5, 1.0}) {
      if (quick && coefficient != 1) continue;
      const Drift drift = drift_of(coefficient, viscous, quick);
      table.rows.push_back({law, digits(viscous ? viscosity : 0), digits(coefficient), rounded(drift.along),
                            rounded(drift.cut), rounded(drift.raised), rounded(drift.fitted)});
      if (law == "spring" && viscous)
        table.check(std::max({drift.along, drift.cut, drift.raised, drift.fitted}) < 0.1,
                    "mu = " + digits(coefficient) + ": the spring holds every block within 0.1 um/s");
    }
  };
  if (!quick) add("corrected", true, drift_at_the_limit<hmps::CorrectedFriction>);
  add("spring", true, drift_at_the_limit<hmps::SpringFriction>);
  if (!quick) add("spring", false, drift_at_the_limit<hmps::SpringFriction>);
  return table;
}

}  // namespace walls
