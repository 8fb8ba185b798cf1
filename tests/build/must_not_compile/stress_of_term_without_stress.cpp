// SPDX-License-Identifier: MIT
// expect: this term has no stress(particle), of a ParticleState, in Pa
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"

struct Muscle {
  template <class Particles, class Coupling>
  void couple(const Particles&, Coupling&) const {}
  template <class Particle>
  double energy(const Particle&) const {
    return 0;
  }
};

int main() {
  std::vector<hmps::Vector<double, 3>> x(1);
  std::vector<hmps::Matrix<double, 3>> stress(1);
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(x), {.spacing = 1e-3});
  const auto force = hmps::internal_force(bonds, Muscle{});
  (void)force.energy(hmps::vectors(x), 1e-9);
  force.cauchy_stresses(hmps::vectors(x), hmps::matrices(stress));
}
