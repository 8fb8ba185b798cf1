// SPDX-License-Identifier: MIT
// Where does a bar of soft tissue come to rest under its weight? Finds the static answer without simulating the motion.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

int main() {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = 4e-3, rho = 1000, g = 9.81;

  // The bar of the first program: 60 x 20 x 20 mm, and two more layers at x < 0, which the clamp holds.
  const hmps::Box<double, 3> bar{Vector(-2 * l0, 0, 0), Vector(0.06, 0.02, 0.02)};
  const std::vector<Vector> reference = hmps::fill_lattice(bar, l0, Vector(l0 / 2, l0 / 2, l0 / 2));
  const hmps::ParticleSet clamped(reference.size(), [&](std::size_t i) { return reference[i][0] < 0; });
  std::vector<Vector> position = reference, velocity(reference.size(), Vector::Zero()), load = velocity;

  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  const auto tissue = hmps::MooneyRivlin<>::from_young(20e3, 1e6);
  auto force = hmps::internal_force(bonds, hmps::elastic(tissue),
                                    hmps::artificial(hmps::shear_wave_modulus(tissue.shear_modulus())),
                                    hmps::gravity(rho, Vector(0, 0, -g)));
  const double weight = rho * g * 0.06 * 0.02 * 0.02;
  const auto found = hmps::relax(force, hmps::vectors(position), hmps::vectors(velocity), hmps::vectors(load), rho,
                                 {.spacing = l0, .load = weight, .moves = ~clamped});
  // How far the middle of the free end has sunk (m): the end lies half a spacing beyond its last particles.
  const auto fall = [&] {
    std::size_t last = 0, before = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      if ((reference[i] - Vector(0.06 - l0 / 2, 0.01, 0.01)).norm() < l0 / 4) last = i;
      if ((reference[i] - Vector(0.06 - 3 * l0 / 2, 0.01, 0.01)).norm() < l0 / 4) before = i;
    }
    return 1.5 * (reference[last] - position[last])[2] - 0.5 * (reference[before] - position[before])[2];
  };
  const double sunk = 1e3 * fall();
  std::printf("After %d iterations %.2g of the weight is unbalanced, and the middle of the end has sunk by %.2f mm.\n",
              found.iterations, found.residual, sunk);
  return std::fflush(stdout) == 0 && std::abs(sunk - 23.4) < 0.05 * 23.4
             ? 0
             : 1;  // finite elements: 23.4 mm in the middle of the end face
}
