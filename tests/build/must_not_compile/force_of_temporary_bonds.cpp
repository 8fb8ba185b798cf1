// SPDX-License-Identifier: MIT
// expect: deleted function
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"

int main() {
  std::vector<Eigen::Vector3d> x(1);
  // The force refers to its bonds; these would be gone at once.
  hmps::internal_force(hmps::LatticeBonds<double, 3>(hmps::vectors(x), {.spacing = 1e-3}), hmps::artificial(2e4));
}
