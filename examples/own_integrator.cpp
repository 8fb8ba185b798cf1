// SPDX-License-Identifier: MIT
// Another scheme from the same functions: velocity Verlet, beside the paper's symplectic Euler. A stretched block is
// let go; nothing damps it, so its energy should be constant. The error falls with the step for symplectic Euler, and
// with its square for velocity Verlet.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

int main() {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = 2e-3, rho = 1000, young = 20e3, volume = l0 * l0 * l0;  // m, kg/m3, Pa, m3
  const hmps::Box<double, 3> block{Vector::Zero(), Vector(0.012, 0.008, 0.008)};
  const auto reference = hmps::fill_lattice(block, l0, Vector::Constant(l0 / 2));
  auto position = reference, velocity = reference, load = reference;
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);

  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  auto force =
      hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(young, 1e5)), hmps::artificial(young));

  const auto symplectic_euler = [&](double dt) {
    force(x, f);
    hmps::kick(v, f, rho, dt);
    hmps::drift(x, v, dt);
  };
  const auto velocity_verlet = [&](double dt) {  // f belongs to x at the start, and again at the end
    hmps::kick(v, f, rho, dt / 2);
    hmps::drift(x, v, dt);
    force(x, f);
    hmps::kick(v, f, rho, dt / 2);
  };

  const auto energy = [&] { return hmps::kinetic_energy(v, rho, volume) + force.energy(x, volume).total(); };
  const auto largest_error = [&](const auto& scheme, double dt) {  // relative error of the energy over 0.02 s
    for (std::size_t i = 0; i < reference.size(); ++i) position[i] = reference[i].cwiseProduct(Vector(1.1, 0.95, 0.95));
    hmps::set_zero(v);
    force(x, f);
    const double start = energy();
    double largest = 0;
    for (int step = 0; step * dt < 0.02; ++step) {
      scheme(dt);
      largest = std::max(largest, std::abs(energy() / start - 1));
    }
    return largest;
  };

  const double dt = 2e-5;
  const double euler = largest_error(symplectic_euler, dt), verlet = largest_error(velocity_verlet, dt);
  const double euler_order = std::log2(euler / largest_error(symplectic_euler, dt / 2));
  const double verlet_order = std::log2(verlet / largest_error(velocity_verlet, dt / 2));
  std::printf("symplectic Euler: energy within %.1e, order %.2f\n", euler, euler_order);
  std::printf("velocity Verlet:  energy within %.1e, order %.2f\n", verlet, verlet_order);
  return std::fflush(stdout) == 0 && std::abs(euler_order - 1) < 0.1 && std::abs(verlet_order - 2) < 0.1 ? 0 : 1;
}
