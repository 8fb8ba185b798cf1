// SPDX-License-Identifier: MIT
// The artificial force alone, (19): artificial/KIND/PARTICLES/THREADS. Items are particles.
#include "hmps/terms/artificial.hpp"

#include "components/step.hpp"

namespace {

using namespace bench;

[[maybe_unused]] const bool added = [] {
  add_force(
      "artificial", [](const auto& bonds) { return hmps::internal_force(bonds, hmps::artificial(young)); },
      [](const auto& cost) {
        return cost.stage_positions() + cost.gradient() + cost.artificial() + cost.couple() + cost.force();
      });
  return true;
}();

}  // namespace
