// SPDX-License-Identifier: MIT
// User-defined particles: the library works on their members in place, whatever lies between them. A ball of soft
// tissue is set spinning and let go. It widens and narrows; its volume and angular momentum stay the same.
#include <array>
#include <cmath>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

struct Cell {                                              // not a type of the library
  Eigen::Vector3d position{0, 0, 0};                       // m
  float velocity[3] = {0, 0, 0};                           // m/s; scalar types may differ between members
  double temperature = 310;                                // other data of the user's code
  std::array<double, 3> force{};                           // N/m3
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();  // deformation gradient
};

int main() {
  const double l0 = 2e-3, rho = 1000, dt = 3e-5, spin = 100, radius = 12.5e-3;  // m, kg/m3, s, rad/s, m
  const double volume = l0 * l0 * l0;
  const hmps::Ball<double, 3> ball{.radius = radius};
  const hmps::Box<double, 3> box{Eigen::Vector3d::Constant(-radius), Eigen::Vector3d::Constant(radius)};
  std::vector<Cell> cells;
  for (const auto& r : hmps::fill_lattice(ball, box, l0))
    cells.push_back({.position = r, .velocity = {static_cast<float>(-spin * r[1]), static_cast<float>(spin * r[0])}});

  const auto x = hmps::vectors(cells, &Cell::position), f = hmps::vectors(cells, &Cell::force);
  const auto v = hmps::vectors(cells, &Cell::velocity);
  const auto F = hmps::matrices(cells, &Cell::gradient);

  const hmps::BondList<double, 3> bonds(x, {.spacing = l0});  // bonds of any cloud of particles
  auto force = hmps::internal_force(bonds, hmps::elastic(hmps::NeoHookean<>::from_young_poisson(20e3, 0.49)),
                                    hmps::artificial(10e3), hmps::record(F));
  double before = 0, after = 0;
  for (int step = 0; step <= 2000; ++step) {
    force(x, v, f);
    if (step % 250 == 0) {
      after = hmps::angular_momentum(x, v, rho, volume)[2];
      if (step == 0) before = after;
      double reach = 0;
      for (const Cell& cell : cells) reach = std::fmax(reach, cell.position.norm());
      std::printf("t = %6.4f s: reaches %.2f mm, mean det F %.4f, angular momentum %.4e kg m2/s\n", step * dt,
                  1e3 * reach, hmps::jacobian_statistics(F).mean, after);
    }
    hmps::kick(v, f, rho, dt);
    hmps::drift(x, v, dt);
  }
  return std::fflush(stdout) == 0 && std::abs(after - before) < 1e-4 * before ? 0 : 1;  // limited by float velocities
}
