// SPDX-License-Identifier: MIT
// expect: this call takes views of arrays, not arrays: wrap arrays of vectors in hmps::vectors(array)
// first line: std::vector
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"

int main() {
  std::vector<Eigen::Vector3d> x(1);
  const hmps::LatticeBonds<double, 3> bonds(x, {.spacing = 1e-3});
}
