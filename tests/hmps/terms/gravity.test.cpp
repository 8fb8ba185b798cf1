// SPDX-License-Identifier: MIT
#include "hmps/terms/gravity.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "../../reference/scenes.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"

namespace gravity_test {

using Vector = hmps::Vector<double, 2>;
using Bonds = hmps::LatticeBonds<double, 2>;
static_assert(hmps::BodyForceTerm<hmps::Gravity<double, 2>, double, 2>);
static_assert(!hmps::CouplingTerm<hmps::Gravity<double, 2>, double, 2>);

// rho g on each particle, by `add`, as a term, and in `kick`, whatever gives the density.
TEST(Gravity, IsTheDensityTimesTheAcceleration) {
  auto scene = scenes::all<2>().front();
  scene.x = scene.reference;
  const std::size_t n = scene.x.size();
  const Bonds bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  std::vector<float> rho(n);
  for (std::size_t i = 0; i < n; ++i) rho[i] = static_cast<float>(900 + i);
  const Vector g(0.5, -9.81);
  const auto weight = hmps::gravity([&](const auto& at) { return at(hmps::scalars(rho)) * 2; }, g);
  std::vector<Vector> f(n, Vector::Ones()), v(n, Vector::Zero());
  weight.add(hmps::vectors(f));
  for (std::size_t i = 0; i < n; ++i) EXPECT_LE((f[i] - Vector(Vector::Ones() + 2.0 * rho[i] * g)).norm(), 1e-11) << i;

  // At rest nothing else pulls.
  auto force = hmps::internal_force(bonds, hmps::artificial(1e4), weight);
  force(hmps::vectors(scene.x), hmps::vectors(f));
  for (std::size_t i = 0; i < n; ++i) EXPECT_LE((f[i] - Vector(2.0 * rho[i] * g)).norm(), 1e-11) << i;
  force.kick(
      hmps::vectors(scene.x), hmps::vectors(v), [&](const auto& at) { return at(hmps::scalars(rho)) * 2; }, 0.25);
  for (std::size_t i = 0; i < n; ++i) EXPECT_LE((v[i] - Vector(0.25 * g)).norm(), 1e-14) << i;
}

// - rho g . x per volume: raising a body by h takes rho V |g| h.
TEST(Gravity, HasTheEnergyOfTheHeight) {
  auto scene = scenes::all<2>().front();
  const std::size_t n = scene.reference.size();
  const Bonds bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  std::vector<double> rho(n);
  double mass = 0;
  for (std::size_t i = 0; i < n; ++i) mass += rho[i] = 900 + static_cast<double>(i);
  auto force = hmps::internal_force(bonds, hmps::gravity(hmps::scalars(rho), Vector(0.5, -9.81)));
  const double volume = scene.spacing * scene.spacing;
  const double before = force.energy(hmps::vectors(scene.reference), volume).total();
  for (Vector& x : scene.reference) x += Vector(2, 3);
  const double after = force.energy(hmps::vectors(scene.reference), volume).total();
  EXPECT_NEAR((after - before) / (mass * volume), 9.81 * 3 - 0.5 * 2, 1e-9);
}

TEST(Gravity, RefusesBadInput) {
  const Vector g(0, -9.81);
  EXPECT_THROW((void)hmps::gravity(0.0, g), hmps::InputError);
  EXPECT_THROW((void)hmps::gravity(1000.0, Vector(0, std::numeric_limits<double>::infinity())), hmps::InputError);
  std::vector<double> rho(3, 1000);
  std::vector<Vector> f(4);
  EXPECT_THROW(hmps::gravity(hmps::scalars(rho), g).add(hmps::vectors(f)), hmps::InputError);
  rho.push_back(-1);
  EXPECT_THROW(hmps::gravity(hmps::scalars(rho), g).add(hmps::vectors(f)), hmps::InputError);
  const auto scene = scenes::all<2>().front();
  const Bonds bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  EXPECT_THROW((void)hmps::internal_force(bonds, hmps::gravity(hmps::scalars(rho), g)), hmps::InputError);
  rho.assign(bonds.size(), 1000);
  EXPECT_NO_THROW((void)hmps::internal_force(bonds, hmps::gravity(hmps::scalars(rho), g)));
  rho.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)hmps::internal_force(bonds, hmps::gravity(hmps::scalars(rho), g)), hmps::InputError);
  auto force = hmps::internal_force(bonds, hmps::gravity(1000, g));
  const auto all = [](std::size_t) { return true; };
  EXPECT_NO_THROW(force.restrict_to(hmps::ParticleSet(bonds.size(), all)));
  EXPECT_THROW(force.restrict_to(hmps::ParticleSet(bonds.size() + 1, all)), hmps::InputError);
}

}  // namespace gravity_test
