// SPDX-License-Identifier: MIT
// How a thin wall at any angle bends: a plate of 36 x 24 x 4.8 mm, clamped at a narrow face, sinks under its
// own weight. Fitted particles follow its surface, and E_hat and the mean dilatation are chosen for walls of few
// layers.
#include <Eigen/Geometry>
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

  // The plate and the piece that holds it are fitted one after the other, the plate first. They meet half a spacing
  // beyond the clamped face, x = 0 in the plate's own axes, which thus passes through the outermost held particles.
  const auto plate = [&](double from, double to) {
    return hmps::rotated(hmps::Box<double, 3>{Vector(from, -0.012, -0.0024), Vector(to, 0.012, 0.0024)}, axes);
  };
  const auto fit = [&](double from, double to) {
    const hmps::Box<double, 3> around{Vector::Constant(-0.045), Vector::Constant(0.045)};
    return hmps::fit_particles(plate(from, to), around, l0);
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

  // The stress: the F of the force is a mean over neighbours. Gradients that are right along the faces, stretched
  // across the wall until no stress acts there, go with the law that has the whole bulk modulus.
  const auto tissue = hmps::MooneyRivlin<>::from_moduli(K, mu);
  std::vector<Tensor> F(n), stress(n);
  const auto normals = hmps::wall_normals(plate(-2.5 * l0, 0.036), body, l0);
  hmps::recovered_gradients(bonds, x, hmps::matrices(F));
  hmps::impose_plane_stress(hmps::matrices(F), tissue, hmps::vectors(normals));
  hmps::cauchy_stresses(hmps::matrices(F), tissue, hmps::matrices(stress));

  const std::vector<Vector> tip{axes * Vector(0.036, 0, 0)};
  std::vector<Vector> sunk(1);
  hmps::CarriedSurface(hmps::vectors(reference), hmps::vectors(tip), l0)(x, hmps::vectors(sunk));
  const double sag = (tip[0] - sunk[0]).dot(axes.col(2));
  // The tension along the upper layer, in the middle of the plate, over that of beam theory: M z / I.
  double ratio = 0;
  int count = 0;
  for (std::size_t i = 0; i < moving; ++i) {
    const Vector r = axes.transpose() * reference[i];
    if (r[2] < 0.0024 - 0.65 * body.layer_spacings[i] || std::abs(r[0] - 0.018) > 0.006 || std::abs(r[1]) > 0.008)
      continue;
    const double beam = rho * g * std::pow(0.036 - r[0], 2) / 2 * r[2] * 12 / std::pow(0.0048, 2);
    ratio += axes.col(0).dot(stress[i] * axes.col(0)) / beam;
    ++count;
  }
  std::printf("%zu particles: the tip sinks by %.2f mm (finite elements: 1.90 mm); ", n, 1e3 * sag);
  std::printf("the tension of the upper layer is %.2f of that of beam theory.\n", ratio / count);
  return std::fflush(stdout) == 0 && std::abs(sag / 1.90e-3 - 1) < 0.06 && std::abs(ratio / count - 1) < 0.06 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
