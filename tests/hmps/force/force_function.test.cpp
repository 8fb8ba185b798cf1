// SPDX-License-Identifier: MIT
#include "hmps/force/force_function.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "../../reference/scenes.hpp"
#include "hmps/analysis/stable_step.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/viscous.hpp"

namespace force_function_test {

using Function = hmps::ForceFunction<double, 2>;
static_assert(hmps::ProbedForce<Function, double, 2>);

// One type holds forces with different terms, and gives the same bits as they do.
TEST(ForceFunction, HoldsAnyForce) {
  const auto scene = scenes::all<2>().front();
  const std::size_t n = scene.x.size();
  const hmps::LatticeBonds<double, 2> bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  auto plain = hmps::internal_force(bonds, hmps::artificial(2e4));
  auto damped = hmps::internal_force(bonds, hmps::artificial(2e4), hmps::viscous(1000, 2e-3));
  const auto x = hmps::vectors(scene.x), v = hmps::vectors(scene.v);
  std::vector<hmps::Vector<double, 2>> expected(n), found(n);
  Function force = plain;
  plain(x, v, hmps::vectors(expected));
  force(x, v, hmps::vectors(found));
  EXPECT_EQ(found, expected);
  force = damped;
  damped(x, v, hmps::vectors(expected));
  force(x, v, hmps::vectors(found));
  EXPECT_EQ(found, expected);
}

}  // namespace force_function_test
