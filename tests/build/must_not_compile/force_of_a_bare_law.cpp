// SPDX-License-Identifier: MIT
// expect: wrap it in one: hmps::elastic(law)
// first line: NeoHookean
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/neo_hookean.hpp"

int main() {
  std::vector<Eigen::Vector3d> x(1);
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(x), {.spacing = 1e-3});
  auto force = hmps::internal_force(bonds, hmps::NeoHookean<double>::from_young_poisson(2e4, 0.4));
  (void)force;
}
