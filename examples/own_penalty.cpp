// SPDX-License-Identifier: MIT
// A user-defined penalty law, Hertz-like: soft at first touch and stiffer with depth. A rigid tile is thrown at a
// plate. The program checks that it penetrates as deep as the energy of the law predicts and flies off as fast as it
// came, and that contact rejects a step for which the law, not k, is too stiff.
#include <cmath>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

//! [penalty law]
struct Hertz {
  static double force(double k, double p, double l0) { return k * p * std::sqrt(p / l0); }                // N/m3
  static double largest_stiffness(double k, double p, double l0) { return 1.5 * k * std::sqrt(p / l0); }  // N/m4
};
//! [penalty law]

int main() {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = 2e-3, rho = 1000, k = 1e11, speed = 1.5;  // m, kg/m3, N/m4, m/s

  // The plate (two layers) is fixed and ends at z = 0; the tile (two layers) starts a tenth of a spacing above it.
  const hmps::Box<double, 3> plate{Vector(-0.014, -0.014, -0.004), Vector(0.014, 0.014, 0)};
  const hmps::Box<double, 3> tile{Vector(-0.006, -0.006, 0), Vector(0.006, 0.006, 0.004)};
  std::vector<Vector> reference = hmps::fill_lattice(plate, l0, Vector(Vector::Constant(l0 / 2)));
  std::vector<hmps::Index> wall, all, skin;
  for (std::size_t i = 0; i < reference.size(); ++i) wall.push_back(static_cast<hmps::Index>(i));
  for (const Vector& r : hmps::fill_lattice(tile, l0, Vector(Vector::Constant(l0 / 2)))) {
    all.push_back(static_cast<hmps::Index>(reference.size()));
    if (r[2] < l0) skin.push_back(all.back());
    reference.push_back(r + Vector(0, 0, 0.1 * l0));
  }

  double deepest = 0;                   // m
  const auto thrown = [&](double dt) {  // returns the speed after 4 ms
    //! [contact]
    hmps::MetaballContact<double, 3, hmps::SmoothMetaball, hmps::CorrectedFriction, Hertz> contact(
        {.spacing = l0, .density = rho, .stiffness = hmps::PenaltyStiffness::fixed(k)});
    //! [contact]
    const auto below = contact.add_organ({"plate", {}, wall, [](hmps::Index) { return true; }});
    const auto above = contact.add_organ({"tile", skin, {}});
    contact.add_pair(below, above, {.roles = hmps::Roles::only_second_is_slave});
    std::vector<Vector> position = reference, velocity(reference.size(), Vector::Zero()), load = velocity;
    for (const hmps::Index i : all) velocity[i][2] = -speed;
    for (double t = 0; t < 4e-3; t += dt) {
      hmps::set_zero(hmps::vectors(load));
      const auto report = contact.add(hmps::vectors(position), hmps::vectors(velocity), hmps::vectors(load), dt);
      deepest = std::fmax(deepest, report.penetration);
      Vector mean = Vector::Zero();  // force density of the tile, which is rigid
      for (const hmps::Index i : all) mean += load[i] / static_cast<double>(all.size());
      for (const hmps::Index i : all) {
        velocity[i] += dt / rho * mean;
        position[i] += dt * velocity[i];
      }
    }
    return velocity[all[0]][2];
  };

  // In a column of two particles, rho v^2 = k l0^2 (p / l0)^2.5 / 2.5.
  const double expected = l0 * std::pow(2.5 * rho * speed * speed / (k * l0 * l0), 0.4);
  const double after = thrown(1e-5);
  std::printf("%.3f mm deep, by the energy of the law %.3f mm; %.3f m/s before, %.3f m/s after\n", 1e3 * deepest,
              1e3 * expected, speed, after);
  try {
    thrown(2e-4);
    return 1;
  } catch (const hmps::StateError& error) {
    std::puts(error.what());
  }
  const bool right = std::abs(deepest / expected - 1) < 0.02 && std::abs(after / speed - 1) < 0.01;
  return std::fflush(stdout) == 0 && right ? 0 : 1;
}
