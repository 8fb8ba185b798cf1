// SPDX-License-Identifier: MIT
#include "hmps/force/internal_force.hpp"

#include "fused_force.hpp"

namespace fused_force {

using ModelsInSpace = testing::Types<hmps::LatticeBonds<float, 3>, hmps::LatticeBonds<double, 3>,
                                     hmps::BondList<float, 3>, hmps::BondList<double, 3>>;
INSTANTIATE_TYPED_TEST_SUITE_P(InSpace, FusedForce, ModelsInSpace);

}  // namespace fused_force
