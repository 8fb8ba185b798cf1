// SPDX-License-Identifier: MIT
// A vibrating block of one force, by a program that names nothing else of the library. Usage: alone STEPS
#include <cstdio>
#include <cstdlib>

#include "body.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/elastic.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  costs::Body<3> body;
  const std::size_t before = costs::heap();
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(body.reference), {.spacing = costs::spacing});
  auto force = hmps::internal_force(bonds, hmps::elastic(costs::tissue));
  costs::advance(body, force, std::atoi(argv[1]));
  std::printf("%zu %zu\n", body.size(), costs::heap() - before);
}
