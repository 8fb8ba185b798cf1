// SPDX-License-Identifier: MIT
// How far does the sag of a bar depend on where the lattice lies in it? The bar of at_rest.cpp, at an angle to the
// lattice, with the lattice as it is and shifted by half a spacing along each axis.
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <hmps/hmps.hpp>
#include <vector>

using Vector = hmps::Vector<double, 3>;

/// How far the middle of the end face sinks (m) with a lattice of this spacing and origin (m).
double sag(double l0, const Vector& origin) {
  const double rho = 1000, g = 9.81;
  const hmps::Matrix<double, 3> along = Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.2, 1, 0.3).normalized()).matrix();
  // 60 x 20 x 20 mm and two more spacings at the clamp, in the bar's own axes: r' = along^T r.
  const auto own = [&](const Vector& r) { return Vector(along.transpose() * r); };
  const hmps::Box<double, 3> bar{Vector(-2 * l0, 0, 0), Vector(0.06, 0.02, 0.02)};
  const auto tilted = [&](const Vector& r) { return bar(own(r)); };
  const hmps::Box<double, 3> around{Vector(-0.03, -0.03, -0.04), Vector(0.08, 0.06, 0.05)};
  const auto sites = hmps::fill_lattice(tilted, around, l0, origin);
  std::vector<Vector> reference;
  for (const auto i : hmps::supported_particles(hmps::vectors(sites), {.spacing = l0})) reference.push_back(sites[i]);
  std::vector<Vector> position = reference, velocity(reference.size(), Vector::Zero()), load = velocity;

  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  const auto tissue = hmps::MooneyRivlin<>::from_young(20e3, 1e6);
  auto internal = hmps::internal_force(bonds, hmps::elastic(tissue),
                                       hmps::artificial(hmps::shear_wave_modulus(tissue.shear_modulus())));
  const Vector weight = rho * g * along.col(2);
  const auto force = [&](const auto& x, const auto& v, const auto& f) {
    internal(x, v, f);
    for (std::size_t i = 0; i < f.size(); ++i) f.add(i, -weight);
  };
  hmps::relax(force, hmps::vectors(position), hmps::vectors(velocity), hmps::vectors(load), rho,
              {.spacing = l0, .load = rho * g * 0.06 * 0.02 * 0.02, .moves = [&](std::size_t i) {
                 return own(reference[i])[0] > 0;
               }});
  // Where the particles have carried the middle of the end face to.
  const std::vector<Vector> middle{along * Vector(0.06, 0.01, 0.01)};
  std::vector<Vector> sunk(1);
  hmps::CarriedSurface(hmps::vectors(reference), hmps::vectors(middle), l0)(hmps::vectors(position),
                                                                            hmps::vectors(sunk));
  return (middle[0] - sunk[0]).dot(along.col(2));
}

int main(int argc, char** argv) try {
  const double l0 = argc > 1 ? std::atof(argv[1]) : 4e-3;
  const auto found = hmps::lattice_spread(l0, [&](const Vector& origin) { return sag(l0, origin); });
  for (const double value : found.values) std::printf("%.2f mm\n", 1e3 * value);
  std::printf("The middle of the end sinks by %.1f +- %.1f mm; finite elements: 23.4 mm.\n", 1e3 * found.mean,
              1e3 * found.error);
  // The error bar does not include the errors that all positions of the lattice have in common: see the tutorial.
  return std::fflush(stdout) == 0 && std::abs(found.mean - 23.4e-3) < found.error + 0.1 * 23.4e-3 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
