// SPDX-License-Identifier: MIT
// The elastic force alone, (13): elastic/KIND/PARTICLES/THREADS. Items are particles.
#include "hmps/terms/elastic.hpp"

#include "components/step.hpp"

namespace {

using namespace bench;

[[maybe_unused]] const bool added = [] {
  add_force(
      "elastic", [](const auto& bonds) { return hmps::internal_force(bonds, hmps::elastic(tissue)); },
      [](const auto& cost) {
        return cost.stage_positions() + cost.gradient() + cost.elastic(tissue) + cost.couple() + cost.force();
      });
  return true;
}();

}  // namespace
