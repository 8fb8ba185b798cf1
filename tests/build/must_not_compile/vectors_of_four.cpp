// SPDX-License-Identifier: MIT
// expect: positions, velocities and forces have 2 or 3 components
#include <vector>

#include "hmps/core/view.hpp"

struct Particle {
  double position[4];
};

int main() {
  std::vector<Particle> particles(1);
  return static_cast<int>(hmps::vectors(particles, &Particle::position).size());
}
