// SPDX-License-Identifier: MIT
#include "shared.hpp"

Layout wide_layout() { return {}; }

std::vector<Particle> wide_particles() { return make_particles(); }

template <class B>
B wide_body(std::vector<Particle>& particles) {
  return B(particles);
}
template <class B>
void wide_evaluate(B& body, std::vector<Particle>& particles, std::vector<hmps::Vector<double, 3>>& f) {
  body.evaluate(particles, f);
}
template Lattice wide_body(std::vector<Particle>&);
template FloatLattice wide_body(std::vector<Particle>&);
template Cloud wide_body(std::vector<Particle>&);
template void wide_evaluate(Lattice&, std::vector<Particle>&, std::vector<hmps::Vector<double, 3>>&);
template void wide_evaluate(FloatLattice&, std::vector<Particle>&, std::vector<hmps::Vector<double, 3>>&);
template void wide_evaluate(Cloud&, std::vector<Particle>&, std::vector<hmps::Vector<double, 3>>&);

double wide_sum(const hmps::VectorView<const double, 3>& positions,
                const hmps::MatrixView<const double, 3>& gradients) {
  double sum = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) sum += (gradients[i] * positions[i]).sum();
  return sum;
}

hmps::Vector<double, 3> wide_product(hmps::Matrix<double, 3> A, hmps::Vector<double, 3> b) { return A * b; }

hmps::Lanes<float> wide_lanes(const hmps::Lanes<float>& a, const hmps::Lanes<float>& b) { return a * b + a; }
