// SPDX-License-Identifier: MIT
#include "hmps/force/internal_force.hpp"

#include "fused_force.hpp"

namespace fused_force {

using ModelsInThePlane = testing::Types<hmps::LatticeBonds<float, 2>, hmps::LatticeBonds<double, 2>,
                                        hmps::BondList<float, 2>, hmps::BondList<double, 2>>;
INSTANTIATE_TYPED_TEST_SUITE_P(InThePlane, FusedForce, ModelsInThePlane);

}  // namespace fused_force
