// SPDX-License-Identifier: MIT
// A bar of soft tissue, clamped at one end, sinks under its weight until viscosity has brought it to rest.
#include <cstddef>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

using Vector = hmps::Vector<double, 3>;

// How far the middle of the free end has sunk (m): the end lies half a spacing beyond its last particles.
static double fall(const std::vector<Vector>& reference, const std::vector<Vector>& position, double l0) {
  std::size_t last = 0, before = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if ((reference[i] - Vector(0.06 - l0 / 2, 0.01, 0.01)).norm() < l0 / 4) last = i;
    if ((reference[i] - Vector(0.06 - 3 * l0 / 2, 0.01, 0.01)).norm() < l0 / 4) before = i;
  }
  return 1.5 * (reference[last] - position[last])[2] - 0.5 * (reference[before] - position[before])[2];
}

//! [program]
int main() {
  const double l0 = 4e-3, rho = 1000, dt = 6e-5;  // spacing (m), density (kg/m3), time step (s)

  // 60 x 20 x 20 mm, and two more layers at x < 0, which the clamp holds.
  const hmps::Box<double, 3> bar{Vector(-2 * l0, 0, 0), Vector(0.06, 0.02, 0.02)};
  const std::vector<Vector> reference = hmps::fill_lattice(bar, l0, Vector(l0 / 2, l0 / 2, l0 / 2));
  const hmps::ParticleSet clamped(reference.size(), [&](std::size_t i) { return reference[i][0] < 0; });
  std::vector<Vector> position = reference, velocity(reference.size(), Vector::Zero()), load = velocity;
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);

  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  const auto tissue = hmps::MooneyRivlin<>::from_young(20e3, 1e6);  // Young's modulus and D1 (Pa)
  auto force = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(10e3), hmps::viscous(rho, 0.02),
                                    hmps::gravity(rho, Vector(0, 0, -9.81)));

  for (int step = 0; step <= 6000; ++step) {
    force(x, v, f);  // N/m3
    hmps::kick(v, f, rho, dt);
    hmps::hold(v, clamped);
    hmps::drift(x, v, dt);
    if (step % 1000 == 0)
      std::printf("t = %.2f s: the middle of the end has sunk by %5.2f mm\n", step * dt,
                  1e3 * fall(reference, position, l0));
  }
  return std::fflush(stdout) == 0 ? 0 : 1;
}
//! [program]
