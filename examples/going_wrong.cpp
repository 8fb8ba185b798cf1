// SPDX-License-Identifier: MIT
// How large may the step be, and what happens when it is larger? A cube is set in motion, once with the step that
// `stable_step` recommends and once with a step half as large again.
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

int main() {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = 2e-3, rho = 1000;  // m, kg/m3
  const hmps::Box<double, 3> cube{Vector::Zero(), Vector::Constant(0.016)};
  const auto reference = hmps::fill_lattice(cube, l0, Vector::Constant(l0 / 2));
  auto position = reference, velocity = reference, load = reference;
  std::vector<hmps::Matrix<double, 3>> gradient(reference.size());
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);
  const auto F = hmps::matrices(gradient);

  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  const auto tissue = hmps::MooneyRivlin<>::from_young(20e3, 1e6);
  auto force = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(20e3), hmps::viscous(rho, 2e-3),
                                    hmps::record(F));

  const auto survives = [&](double dt) {
    position = reference;
    for (std::size_t i = 0; i < reference.size(); ++i)
      velocity[i] = Vector(0, 0, 20 * reference[i][2]);  // stretches it
    try {
      for (int step = 0; step < 1000; ++step) {
        force(x, v, f);
        hmps::check_state(x, v, F, {.time = step * dt, .speed_limit = hmps::sound_speed(tissue, rho)});
        hmps::kick(v, f, rho, dt);
        hmps::drift(x, v, dt);
      }
    } catch (const hmps::StateError& error) {
      std::printf("step %.2e s: %s\n", dt, error.what());
      return false;
    }
    std::printf("step %.2e s: all is well\n", dt);
    return true;
  };

  velocity.assign(reference.size(), Vector::Zero());
  const hmps::StableStep stable = hmps::stable_step(force, x, v, rho, {.spacing = l0});
  std::printf("at most %.2e s, set by particle %zu\n", stable.step, stable.particle);
  return std::fflush(stdout) == 0 && survives(stable.step) && !survives(1.5 * stable.step) ? 0 : 1;
}
