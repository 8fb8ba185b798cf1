// SPDX-License-Identifier: MIT
// Objects made in one translation unit are used in the other, and the outcome is that of one alone, but for
// the rounding of fused multiplications.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "shared.hpp"

namespace {

int failures = 0;

void expect(bool condition, const char* what) {
  if (condition) return;
  std::printf("FAILED: %s\n", what);
  ++failures;
}

using Forces = std::vector<hmps::Vector<double, 3>>;

/// The largest difference of two fields of force over the largest force.
double difference(const Forces& a, const Forces& b) {
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, a[i].norm());
    apart = std::max(apart, (a[i] - b[i]).norm());
  }
  return largest > 0 ? apart / largest : std::numeric_limits<double>::infinity();
}

template <class B>
void exchange(const char* name, double tolerance) {
  auto particles = wide_particles();
  B here(particles);
  B there = wide_body<B>(particles);
  deform(particles);
  const std::size_t n = particles.size();
  Forces own(n), mixed(n), handed(n), far(n);
  here.evaluate(particles, own);
  there.evaluate(particles, mixed);
  wide_evaluate(here, particles, handed);
  wide_evaluate(there, particles, far);
  const double apart = std::max({difference(own, mixed), difference(own, handed), difference(own, far)});
  std::printf("%s: forces differ by %g\n", name, apart);
  expect(apart <= tolerance, name);
}

}  // namespace

int main() {
  expect(Layout{} == wide_layout(), "both translation units see one layout");

  auto particles = wide_particles();
  const auto positions = hmps::vectors(particles, &Particle::position);
  const auto gradients = hmps::matrices(particles, &Particle::gradient);
  double expected = 0;
  for (const Particle& p : particles) expected += p.position.sum();
  expect(std::abs(wide_sum(positions, gradients) - expected) <= 1e-12 * expected, "views");

  hmps::Matrix<double, 3> A;
  A << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  expect(wide_product(A, {1, 1, 1}) == hmps::Vector<double, 3>(6, 15, 24), "small vectors and matrices by value");

  const hmps::Lanes<float> lanes = wide_lanes(hmps::Lanes<float>(3), hmps::Lanes<float>(2));
  expect(std::all_of(std::begin(lanes.lane), std::end(lanes.lane), [](float l) { return l == 9; }), "lanes by value");

  // Rounding of displacements of 5e-5 m under a bulk modulus of 2 MPa: some hundred units in the last place.
  exchange<Lattice>("lattice, double", 1e-11);
  exchange<FloatLattice>("lattice, float", 5e-3);
  exchange<Cloud>("cloud, double", 1e-11);
  return failures == 0 ? 0 : 1;
}
