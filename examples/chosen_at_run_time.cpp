// SPDX-License-Identifier: MIT
// A force that is chosen at run time, and one that is a member of a class. A block of tissue is stretched and let go;
// usage: chosen_at_run_time [elastic|damped]
#include <cmath>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <string>
#include <vector>

using Vector = hmps::Vector<double, 3>;

//! [member]
/// A body of soft tissue: its bonds, and its elastic force.
struct Tissue {
  hmps::LatticeBonds<double, 3> bonds;
  hmps::InternalForce<hmps::LatticeBonds<double, 3>, hmps::Elastic<hmps::MooneyRivlin<>>, hmps::Artificial<double>>
      force;

  Tissue(const std::vector<Vector>& reference, double l0)
      : bonds(hmps::vectors(reference), {.spacing = l0}),
        force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(20e3, 1e5)), hmps::artificial(10e3)) {}
};
//! [member]

int main(int count, char** arguments) {
  const std::string chosen = count > 1 ? arguments[1] : "damped";
  if (count > 2 || (chosen != "elastic" && chosen != "damped")) {
    std::fprintf(stderr, "chosen_at_run_time: there is no force %s; give elastic or damped\n", chosen.c_str());
    return 2;
  }
  const double l0 = 2e-3, rho = 1000, dt = 2e-5, volume = l0 * l0 * l0;  // m, kg/m3, s, m3
  const hmps::Box<double, 3> block{Vector::Zero(), Vector(0.012, 0.008, 0.008)};
  const std::vector<Vector> reference = hmps::fill_lattice(block, l0, Vector(Vector::Constant(l0 / 2)));
  std::vector<Vector> position = reference, velocity(reference.size(), Vector::Zero()), load = velocity;
  for (Vector& r : position) r[0] *= 1.1;
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);

  Tissue tissue(reference, l0);
  //! [chosen]
  hmps::ForceFunction<double, 3> force = tissue.force;
  if (chosen == "damped")
    force = hmps::internal_force(tissue.bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(20e3, 1e5)),
                                 hmps::artificial(10e3), hmps::viscous(rho, 2e-2));
  //! [chosen]

  const auto energy = [&] { return hmps::kinetic_energy(v, rho, volume) + tissue.force.energy(x, volume).total(); };
  const double start = energy();
  for (int step = 0; step < 2000; ++step) {
    force(x, v, f);
    hmps::kick(v, f, rho, dt);
    hmps::drift(x, v, dt);
  }
  const double left = energy() / start;
  std::printf("%s: after %.2f s %.1f %% of the energy is left\n", chosen.c_str(), 2000 * dt, 100 * left);
  const bool is_right = chosen == "damped" ? left < 0.5 : std::abs(left - 1) < 0.02;
  return std::fflush(stdout) == 0 && is_right ? 0 : 1;
}
