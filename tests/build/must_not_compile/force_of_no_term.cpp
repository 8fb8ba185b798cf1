// SPDX-License-Identifier: MIT
// expect: a term of internal_force needs couple(particles, coupling), damping(bonds)
// first line: Magnetism
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"

struct Magnetism {};

int main() {
  std::vector<Eigen::Vector3d> x(1);
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(x), {.spacing = 1e-3});
  auto force = hmps::internal_force(bonds, Magnetism{});
  (void)force;
}
