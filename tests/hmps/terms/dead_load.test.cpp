// SPDX-License-Identifier: MIT
#include "hmps/terms/dead_load.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "../../reference/scenes.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"

namespace dead_load_test {

using Vector = hmps::Vector<double, 2>;
using Bonds = hmps::LatticeBonds<double, 2>;
static_assert(hmps::BodyForceTerm<hmps::DeadLoad<2>, float, 2>);
static_assert(!hmps::CouplingTerm<hmps::DeadLoad<2>, double, 2>);

struct Scene {
  scenes::Scene<2> scene = scenes::all<2>().front();
  std::size_t n = scene.reference.size();
  Bonds bonds{hmps::vectors(scene.reference), {.spacing = scene.spacing}};
  hmps::ParticleSet tip{n, [](std::size_t i) { return i % 3 == 1; }};
  std::vector<Vector> f = std::vector<Vector>(n, Vector::Ones());
};

// By `add`, as a term of float and double bonds, and in `kick`: the forces of the loaded particles are that of the
// load.
TEST(DeadLoad, AddsUpToTheForceByEachPath) {
  Scene s;
  std::vector<double> volume(s.n);
  double whole = 0;
  for (std::size_t i = 0; i < s.n; ++i) volume[i] = 1e-6 * static_cast<double>(1 + i % 4);
  for (const hmps::Index i : s.tip) whole += volume[i];
  const Vector force(0.5, -2);
  const auto load = hmps::dead_load(s.tip, force, hmps::scalars(volume));
  const auto check = [&](const Vector& before, double tolerance) {
    Vector sum = Vector::Zero();
    for (std::size_t i = 0; i < s.n; ++i) {
      const Vector own = s.f[i] - before;
      sum += own * volume[i];
      EXPECT_LE((own - (s.tip(i) ? Vector(force / whole) : Vector(Vector::Zero()))).norm(),
                tolerance * force.norm() / whole)
          << i;
    }
    EXPECT_LE((sum - force).norm(), 10 * tolerance * force.norm());
  };
  load.add(hmps::vectors(s.f));
  check(Vector::Ones(), 1e-12);

  // At rest nothing else pulls.
  hmps::internal_force(s.bonds, hmps::artificial(1e4), load)(hmps::vectors(s.scene.reference), hmps::vectors(s.f));
  check(Vector::Zero(), 1e-12);
  const hmps::BondList<float, 2> single(hmps::vectors(s.scene.reference), {.spacing = s.scene.spacing});
  hmps::internal_force(single, load)(hmps::vectors(s.scene.reference), hmps::vectors(s.f));
  check(Vector::Zero(), 1e-6);
  s.f.assign(s.n, Vector::Zero());  // velocities
  hmps::internal_force(s.bonds, load).kick(hmps::vectors(s.scene.reference), hmps::vectors(s.f), 1000.0, 1000.0);
  check(Vector::Zero(), 1e-12);
}

// The energy falls by the work of the load.
TEST(DeadLoad, HasAnEnergy) {
  Scene s;
  const Vector force(0.5, -2), by(1e-3, 3e-3);
  const double volume = s.scene.spacing * s.scene.spacing;
  auto internal = hmps::internal_force(s.bonds, hmps::dead_load(s.tip, force, volume));
  std::vector<Vector> x = s.scene.reference;
  const double before = internal.energy(hmps::vectors(x), volume).total();
  for (Vector& place : x) place += by;
  EXPECT_NEAR(internal.energy(hmps::vectors(x), volume).total() - before, -force.dot(by), 1e-12);
}

TEST(DeadLoad, RefusesBadInput) {
  Scene s;
  const Vector force(0, -1);
  const hmps::ParticleSet none(s.n, [](std::size_t) { return false; }), other(3, [](std::size_t) { return true; });
  EXPECT_THROW((void)hmps::dead_load(none, force, 1e-6), hmps::InputError);
  EXPECT_THROW((void)hmps::dead_load(s.tip, force, 0.0), hmps::InputError);
  EXPECT_THROW((void)hmps::dead_load(s.tip, Vector(std::numeric_limits<double>::quiet_NaN(), 0), 1e-6),
               hmps::InputError);
  const std::vector<double> few(3, 1e-6);
  EXPECT_THROW((void)hmps::dead_load(s.tip, force, hmps::scalars(few)), hmps::InputError);
  const auto load = hmps::dead_load(other, force, 1e-6);
  EXPECT_THROW((void)hmps::internal_force(s.bonds, load), hmps::InputError);
  EXPECT_THROW(load.add(hmps::vectors(s.f)), hmps::InputError);
}

}  // namespace dead_load_test
