// SPDX-License-Identifier: MIT
// A user-defined weight, that of Wendland, in place of the paper's. A uniform deformation does not depend on the
// weight: a bar that is stretched and sheared as a whole has the energy W(F) V with either, which the program checks.
// Other deformations depend on it through the resolution: how far the end of the bar sinks, with three particles
// through the thickness.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

//! [weight]
const auto wendland = [](double r, double effective_radius) {
  const double s = r / effective_radius, t = 1 - s;
  return s < 1 ? t * t * t * t * (4 * s + 1) : 0;
};
//! [weight]

int main() {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = 0.02 / 3, rho = 1000, volume = l0 * l0 * l0;  // m, kg/m3, m3

  // 60 x 20 x 20 mm, and one more layer at x < 0, which the clamp holds.
  const hmps::Box<double, 3> bar{Vector(-l0, 0, 0), Vector(0.06, 0.02, 0.02)};
  const std::vector<Vector> reference = hmps::fill_lattice(bar, l0, Vector(l0 / 2, l0 / 2, l0 / 2));
  const hmps::ParticleSet clamped(reference.size(), [&](std::size_t i) { return reference[i][0] < 0; });
  const auto tissue = hmps::MooneyRivlin<>::from_young(20e3, 1e5);

  hmps::Matrix<double, 3> F;
  F << 1.1, 0.2, 0, 0, 0.9, 0.1, 0, 0, 1.05;
  const double exact = hmps::energy_density(tissue, F) * volume * static_cast<double>(reference.size());
  double wrong = 0;  // relative error of the energy of a uniform deformation

  const auto sunk = [&](const auto& weight) {  // how far the last layer sinks on average, in mm
    //! [bonds]
    const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0}, hmps::EveryBond{}, weight);
    //! [bonds]
    std::vector<Vector> position = reference, velocity(reference.size(), Vector::Zero()), load = velocity;
    for (Vector& r : position) r = F * r;
    const auto elastic = hmps::internal_force(bonds, hmps::elastic(tissue));
    wrong = std::fmax(wrong, std::abs(elastic.energy(hmps::vectors(position), volume).total() / exact - 1));

    auto force = hmps::internal_force(bonds, hmps::elastic(tissue),
                                      hmps::artificial(hmps::shear_wave_modulus(tissue.shear_modulus())),
                                      hmps::gravity(rho, Vector(0, 0, -9.81)));
    position = reference;
    hmps::relax(force, hmps::vectors(position), hmps::vectors(velocity), hmps::vectors(load), rho,
                {.spacing = l0, .load = rho * 9.81 * 0.06 * 0.02 * 0.02, .moves = ~clamped});
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < reference.size(); ++i)
      if (reference[i][0] > 0.06 - l0) sum += reference[i][2] - position[i][2], ++count;
    return 1e3 * sum / count;
  };
  const double paper = sunk(hmps::PaperWeight{}), own = sunk(wendland);
  std::printf("energy of a uniform deformation: within %.1e of the law, with either weight\n", wrong);
  std::printf("the end sinks by %.2f mm with the paper's weight and by %.2f mm with Wendland's\n", paper, own);
  return std::fflush(stdout) == 0 && wrong < 1e-12 ? 0 : 1;
}
