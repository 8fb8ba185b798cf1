// SPDX-License-Identifier: MIT
// The artificial force with the artificial tension: artificial_tension/KIND/PARTICLES/THREADS. Items are particles.
#include "hmps/terms/artificial_tension.hpp"

#include "components/step.hpp"
#include "hmps/terms/bar_stabiliser.hpp"

namespace {

using namespace bench;

[[maybe_unused]] const bool added = [] {
  add_force(
      "artificial_tension",
      [](const auto& bonds) {
        const auto [modulus, tension] = hmps::bar_stabiliser(young / 3);
        return hmps::internal_force(bonds, hmps::artificial(modulus), hmps::artificial_tension(tension));
      },
      [](const auto& cost) {
        return cost.stage_positions() + cost.gradient() + cost.artificial() + cost.tension() + cost.couple() +
               cost.force();
      });
  return true;
}();

}  // namespace
