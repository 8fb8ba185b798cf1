// SPDX-License-Identifier: MIT
// F of every particle, (11), into the user's array: gradient/KIND/PARTICLES/THREADS. Items are particles.
#include "hmps/force/deformation_gradient.hpp"

#include <vector>

#include "components/step.hpp"

namespace {

using namespace bench;

[[maybe_unused]] const bool added = [] {
  add_force(
      "gradient",
      [](const auto& bonds) {
        using S = typename std::remove_cvref_t<decltype(bonds)>::Scalar;
        return [&bonds, F = std::vector<hmps::Matrix<S, 3>>(bonds.size())](const auto& x, const auto&, const auto&,
                                                                           const auto& execute) mutable {
          hmps::deformation_gradient(bonds, x, hmps::matrices(F), execute);
        };
      },
      [](const auto& cost) { return cost.stage_positions() + cost.gradient() + cost.record(); });
  return true;
}();

}  // namespace
