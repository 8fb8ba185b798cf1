// SPDX-License-Identifier: MIT
// The viscous force alone, (21): viscous/KIND/PARTICLES/THREADS. Items are particles.
#include "hmps/terms/viscous.hpp"

#include "components/step.hpp"

namespace {

using namespace bench;

[[maybe_unused]] const bool added = [] {
  add_force(
      "viscous", [](const auto& bonds) { return hmps::internal_force(bonds, hmps::viscous(density, viscosity)); },
      [](const auto& cost) { return cost.stage_velocities() + cost.viscous() + cost.force(); });
  return true;
}();

}  // namespace
