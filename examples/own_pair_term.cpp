// SPDX-License-Identifier: MIT
// A user-defined pair term: fibres along the bonds of a block of tissue that pull when they are stretched and are slack
// when they are compressed. Whatever such a term computes, momentum and angular momentum are conserved. The program
// checks that the force derives from the energy, and compares the stable step with and without fibres.
#include <cmath>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

//! [pair term]
struct Fibres {
  double stiffness;  // N/m4
  template <class T, int D>
  T tension(const hmps::BondState<T, D>& bond) const {  // N/m3
    using std::max;
    return stiffness * bond.weight() * max(bond.elongation(), T(0));
  }
  double energy(const hmps::BondState<double, 3>& bond) const {  // J/m3, for diagnostics
    return 0.5 * bond.elongation() * tension(bond);
  }
};
//! [pair term]

int main() {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = 2e-3, rho = 1000, volume = l0 * l0 * l0;  // m, kg/m3, m3
  const hmps::Box<double, 3> block{Vector::Zero(), Vector(0.012, 0.008, 0.008)};
  const std::vector<Vector> reference = hmps::fill_lattice(block, l0, Vector(Vector::Constant(l0 / 2)));
  std::vector<Vector> position = reference, load = reference;
  for (Vector& r : position) r = r.cwiseProduct(Vector(1.2, 0.9, 0.95)) + 0.1 * l0 * (2e3 * r).array().sin().matrix();
  const auto x = hmps::vectors(position), f = hmps::vectors(load);

  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  const auto tissue = hmps::MooneyRivlin<>::from_young(20e3, 1e5);
  auto plain = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(10e3));
  auto fibrous = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(10e3), Fibres{1e9});
  fibrous(x, f);

  double largest = 0, wrong = 0;
  Vector sum = Vector::Zero(), moment = Vector::Zero();
  for (std::size_t i = 0; i < position.size(); ++i) {
    sum += load[i];
    moment += position[i].cross(load[i]);
    largest = std::fmax(largest, load[i].norm());
    if (i % 7 != 0) continue;
    const double h = 1e-4 * l0, place = position[i][0];
    position[i][0] = place + h;
    const double above = fibrous.energy(x, volume).total();
    position[i][0] = place - h;
    const double below = fibrous.energy(x, volume).total();
    position[i][0] = place;
    wrong = std::fmax(wrong, std::abs(load[i][0] + (above - below) / (2 * h * volume)));
  }
  const double unbalanced = std::fmax(sum.norm(), moment.norm() / 0.012) / largest;
  const auto energy = fibrous.energy(x, volume);
  std::printf("energies: elastic %.3e J, stabiliser %.3e J, fibres %.3e J\n", energy.of_term[0], energy.of_term[1],
              energy.of_term[2]);
  std::printf("largest force density %.3e N/m3; of it force and moment %.1e, difference from the energy %.1e\n",
              largest, unbalanced, wrong / largest);

  // The stable step falls with the root of the stiffness.
  std::vector<Vector> still(reference.size(), Vector::Zero());
  position = reference;
  const double slack = hmps::stable_step(plain, x, hmps::vectors(still), rho, {.spacing = l0}).step;
  for (Vector& r : position) r *= 1.01;
  const double tight = hmps::stable_step(fibrous, x, hmps::vectors(still), rho, {.spacing = l0}).step;
  std::printf("largest stable step %.2e s without fibres, %.2e s with them stretched\n", slack, tight);
  return std::fflush(stdout) == 0 && unbalanced < 1e-11 && wrong < 1e-6 * largest && tight < slack ? 0 : 1;
}
