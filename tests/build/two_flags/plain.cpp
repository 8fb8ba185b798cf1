// SPDX-License-Identifier: MIT
#include <cstdio>

#include "shared.hpp"

int main() {
  if (!(layout() == wide_layout())) {
    std::puts("the two translation units see different layouts");
    return 1;
  }
  const std::size_t count = 100;
  auto particles = wide_particles(count);
  const auto positions = hmps::vectors(particles, &Particle::position);
  const auto gradients = hmps::matrices(particles, &Particle::gradient);
  positions.add(0, hmps::Vector<double, 3>(1, 1, 1));
  const double expected = 4950.0 + 3 * 100 + 3;
  const double sum = wide_sum(positions, gradients);
  if (sum != expected) {
    std::printf("the sum over the particles is %g, not %g\n", sum, expected);
    return 1;
  }
  return 0;
}
