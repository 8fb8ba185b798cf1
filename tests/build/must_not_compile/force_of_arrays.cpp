// SPDX-License-Identifier: MIT
// expect: this call takes views of arrays, not arrays: wrap arrays of vectors in hmps::vectors(array)
// first line: std::vector
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"

int main() {
  std::vector<Eigen::Vector3d> x(1), v(1), f(1);
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(x), {.spacing = 1e-3});
  auto force = hmps::internal_force(bonds, hmps::artificial(2e4));
  force(x, v, f);
}
