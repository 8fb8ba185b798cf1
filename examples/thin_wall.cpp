// SPDX-License-Identifier: MIT
// How a thin wall at any angle bends: a plate of 36 x 24 x 4.8 mm, clamped at a narrow face, sinks under its
// own weight. Fitted particles follow its surface, and E_hat and the mean dilatation are chosen for walls of few
// layers.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <hmps/hmps.hpp>
#include <vector>

using Vector = hmps::Vector<double, 3>;
using Tensor = hmps::Matrix<double, 3>;

int main(int argc, char** argv) try {
  const double l0 = argc > 1 ? std::atof(argv[1]) : 2.4e-3;  // m: two layers through the wall
  const double rho = 1000, g = 1.962;                        // kg/m3, m/s2
  const double mu = 100e3 / 3, K = 2e6;                      // Pa: shear modulus, for E = 100 kPa, and bulk modulus
  const Tensor axes = Eigen::AngleAxisd(0.6, Vector(0.3, -0.5, 0.8).normalized()).matrix();
  const auto own = [&](const Vector& r) { return Vector(axes.transpose() * r); };

  // The plate and the piece that holds it are fitted one after the other, the plate first. They meet half a spacing
  // beyond the clamped face, x = 0 in the plate's own axes, which thus passes through the outermost held particles.
  const auto fit = [&](double from, double to) {
    const hmps::Box<double, 3> part{Vector(from, -0.012, -0.0024), Vector(to, 0.012, 0.0024)};
    const hmps::Box<double, 3> around{Vector::Constant(-0.045), Vector::Constant(0.045)};
    return hmps::fit_particles([&](const Vector& r) { return part(own(r)); }, around, l0);
  };
  auto body = fit(l0 / 2, 0.036);
  const std::size_t moving = body.size();
  body.append(fit(-2.5 * l0, l0 / 2));
  const std::vector<Vector>& reference = body.positions;
  const std::size_t n = body.size();

  // The law keeps bulk.law of the bulk modulus; bulk.mean resists volume changes of neighbourhoods.
  const hmps::BondList<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  const auto [E_hat, bulk] = hmps::thin_wall_stabiliser(body.layers, body.layer_spacings, l0, K, mu);
  const auto law = hmps::MooneyRivlin<>::from_moduli(bulk.law, mu);
  auto force =
      hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation<2>(bulk.mean),
                           hmps::artificial(hmps::scalars(E_hat)), hmps::gravity(rho, Vector(-g * axes.col(2))));
  std::vector<Vector> position = reference, velocity(n, Vector::Zero()), load = velocity;
  const auto x = hmps::vectors(position);
  hmps::relax(
      force, x, hmps::vectors(velocity), hmps::vectors(load), rho,
      {.spacing = l0, .load = rho * g * 0.036 * 0.024 * 0.0048, .moves = [&](std::size_t i) { return i < moving; }});

  // The stress of law and mean dilatation together; cauchy_stresses(F, law, ...) would lack nearly all of the pressure.
  std::vector<Tensor> stress(n);
  force.cauchy_stresses(x, hmps::matrices(stress));
  // The von Mises stress needs no pressure, but a gradient that is right in the outer layers.
  std::vector<Tensor> F(n);
  std::vector<double> von_mises(n);
  hmps::recovered_gradients(bonds, x, hmps::matrices(F));
  hmps::von_mises_stresses(hmps::matrices(F), law, hmps::scalars(von_mises));

  const std::vector<Vector> tip{axes * Vector(0.036, 0, 0)};
  std::vector<Vector> sunk(1);
  hmps::CarriedSurface(hmps::vectors(reference), hmps::vectors(tip), l0)(x, hmps::vectors(sunk));
  const double sag = (tip[0] - sunk[0]).dot(axes.col(2));
  double pressure = 0;
  for (const Tensor& sigma : stress) pressure = std::max(pressure, -sigma.trace() / 3);
  std::printf(
      "%zu particles: the tip sinks by %.2f mm (finite elements: 1.90 mm); von Mises stress at most "
      "%.0f Pa, pressure at most %.0f Pa.\n",
      n, 1e3 * sag, *std::max_element(von_mises.begin(), von_mises.end()), pressure);
  return std::fflush(stdout) == 0 && std::abs(sag / 1.90e-3 - 1) < 0.06 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
