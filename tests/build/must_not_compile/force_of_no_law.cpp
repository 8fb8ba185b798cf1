// SPDX-License-Identifier: MIT
// expect: a law needs second_piola_kirchhoff
// first line: Wood
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/elastic.hpp"

/// Knows its stress for numbers, but not for the lanes of a block.
struct Wood {
  hmps::Matrix<double, 3> second_piola_kirchhoff(const hmps::Matrix<double, 3>& C, double) const { return C; }
};

int main() {
  std::vector<Eigen::Vector3d> x(1);
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(x), {.spacing = 1e-3});
  auto force = hmps::internal_force(bonds, hmps::elastic(Wood{}));
  force(hmps::vectors(x), hmps::vectors(x));
}
