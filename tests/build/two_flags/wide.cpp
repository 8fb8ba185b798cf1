// SPDX-License-Identifier: MIT
#include "shared.hpp"

Layout wide_layout() { return layout(); }

std::vector<Particle> wide_particles(std::size_t count) {
  std::vector<Particle> particles(count);
  const auto positions = hmps::vectors(particles, &Particle::position);
  const auto gradients = hmps::matrices(particles, &Particle::gradient);
  for (std::size_t i = 0; i < count; ++i) {
    positions.set(i, hmps::Vector<double, 3>(static_cast<double>(i), 1, 2));
    gradients.set(i, hmps::Matrix<double, 3>::Identity());
  }
  return particles;
}

double wide_sum(const hmps::VectorView<const double, 3>& positions,
                const hmps::MatrixView<const double, 3>& gradients) {
  double sum = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) sum += (gradients[i] * positions[i]).sum();
  return sum;
}
