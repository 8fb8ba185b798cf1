// SPDX-License-Identifier: MIT
#include "hmps/force/force_energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "equations.hpp"
#include "hmps/diagnostics/energy.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/gravity.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/viscous.hpp"

namespace force_energy_test {

using namespace equations;
using Bonds = hmps::BondList<double, 2>;
using Vec = hmps::Vector<double, 2>;

struct Springs {
  double stiffness;
  template <class T, int D>
  T tension(const hmps::BondState<T, D>& bond) const {
    return stiffness * bond.weight() * bond.elongation();
  }
  double energy(const hmps::BondState<double, 2>& bond) const { return 0.5 * bond.elongation() * tension(bond); }
};
/// c = k: springs of zero rest length, with the energy k |r|^2 w / 2 for each end.
struct OwnTerm {
  double k;
  template <class K, int D>
  void couple(const hmps::BlockOfParticles<K, D>&, hmps::Coupling<K, D>& coupling) const {
    coupling.c += k;
  }
  template <class Particle>
  double energy(const Particle& particle) const {
    double sum = 0;
    particle.visit_bonds(
        [&](const auto& r0, const auto& relative, double w) { sum += 0.5 * k * w * (r0 + relative).squaredNorm(); });
    return sum;
  }
};
/// A term of two kinds: both of its energies count.
struct Both : Springs, OwnTerm {
  using OwnTerm::energy;
  using Springs::energy;
};

struct Scene {
  scenes::Scene<2> scene = bent_box<2>(true);
  Bonds bonds = make_bonds<Bonds>(scene);
  double volume = scene.spacing * scene.spacing;
};

// The force is minus the gradient of the energy of the same object: first the elastic force of a reduced law,
// stabiliser and mean dilatation, then also weight, springs and a user-defined term.
TEST(ForceEnergy, HasMinusTheForceAsGradient) {
  Scene s;
  const auto share = hmps::split_bulk_modulus(1e6, 7e3);
  const auto law = hmps::MooneyRivlin<double>{1700, 1500, 0.5 * share.law};
  auto x = Expected<2>::convert(s.scene.x);
  const auto expect = [&](auto force) {
    Vectors<2> f(s.scene.x.size());
    force(hmps::vectors(s.scene.x), hmps::vectors(s.scene.v), hmps::vectors(f));
    expect_minus_gradient<2>(
        f, x, [&] { return force.energy(hmps::vectors(x), s.volume).total() / s.volume; }, s.scene.spacing, 0);
  };
  ASSERT_GT(share.mean, 0);
  expect(hmps::internal_force(s.bonds, hmps::elastic(law), hmps::artificial(2e4), hmps::mean_dilatation(share.mean)));
  expect(hmps::internal_force(s.bonds, hmps::elastic(law), hmps::artificial(2e4), hmps::mean_dilatation(share.mean),
                              hmps::gravity(1000, Vec(3, -9.81)), Springs{1e9}, OwnTerm{1e8}));
  expect(hmps::internal_force(s.bonds, hmps::mean_dilatation<2>(share.mean), Both{{1e9}, {1e8}}));
}

// With a volume per particle, the force times that volume is minus the gradient. It sums to zero, as does its moment;
// so does the viscous force.
TEST(ForceEnergy, HasMinusTheForceTimesTheVolumeAsGradient) {
  const Scene s;
  const std::size_t n = s.scene.x.size();
  scenes::Random random(5);
  std::vector<double> volumes(n);
  for (double& own : volumes) own = s.volume * random(0.5, 1.5);
  const auto V = hmps::scalars(volumes);
  const Bonds bonds(hmps::vectors(s.scene.reference), {.spacing = s.scene.spacing}, V, s.scene.bonded);
  const auto x = hmps::vectors(s.scene.x), v = hmps::vectors(s.scene.v);
  auto moved = Expected<2>::convert(s.scene.x);
  Vectors<2> f(n);
  const auto sums_to_zero = [&](bool moment) {
    Vec sum = Vec::Zero();
    double turn = 0, largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += volumes[i] * f[i];
      turn += volumes[i] * (s.scene.x[i][0] * f[i][1] - s.scene.x[i][1] * f[i][0]);
      largest = std::max(largest, volumes[i] * f[i].norm());
    }
    EXPECT_LE(sum.norm(), 1e-11 * largest);
    EXPECT_LE(moment ? std::abs(turn) : 0, 1e-11 * largest);
  };
  const auto expect = [&](auto force) {
    force(x, v, hmps::vectors(f));
    sums_to_zero(true);
    for (std::size_t i = 0; i < n; ++i) f[i] *= volumes[i] / s.volume;
    expect_minus_gradient<2>(
        f, moved, [&] { return force.energy(hmps::vectors(moved), V).total() / s.volume; }, s.scene.spacing, 0);
  };
  const auto law = hmps::MooneyRivlin<double>{1700, 1500, 1e4};
  expect(hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(2e4), hmps::mean_dilatation(1e6)));
  EXPECT_THROW((void)hmps::internal_force(bonds, hmps::elastic(law)).energy(x, s.volume), hmps::InputError)
      << "one volume for particles of different ones";
  expect(hmps::internal_force(bonds, hmps::mean_dilatation<2>(1e6), Both{{1e9}, {1e8}}));
  struct Unweighted {
    static double tension(const hmps::BondState<hmps::Lanes<double>, 2>&) { return 1; }
  };
  EXPECT_THROW((void)hmps::internal_force(bonds, Unweighted{}), hmps::InputError);
  EXPECT_NO_THROW((void)hmps::internal_force(s.bonds, Unweighted{}));
  auto viscosity = hmps::internal_force(bonds, hmps::viscous(1000, 2e-3));
  viscosity(x, v, hmps::vectors(f));
  sums_to_zero(false);
}

// Term by term, the energy is what the diagnostics compute from the same deformation gradients; it is zero for terms
// that store none.
TEST(ForceEnergy, IsThatOfTheDiagnosticsTermByTerm) {
  Scene s;
  const std::size_t n = s.scene.x.size();
  const Materials m(n);
  const auto law = [&](const auto& at) {
    return hmps::MooneyRivlin{at(hmps::scalars(m.c1)), at(hmps::scalars(m.c2)), at(hmps::scalars(m.d1))};
  };
  std::vector<hmps::Matrix<double, 2>> F(n);
  const auto x = hmps::vectors(s.scene.x);
  auto force = hmps::internal_force(s.bonds, hmps::viscous(1000, 2e-3), hmps::elastic(law),
                                    hmps::artificial(hmps::scalars(m.modulus)), hmps::record(hmps::matrices(F)),
                                    hmps::mean_dilatation(3e5));
  Vectors<2> f(n);
  force(x, hmps::vectors(s.scene.v), hmps::vectors(f));
  std::vector<double> volume(n);
  for (std::size_t i = 0; i < n; ++i) volume[i] = s.volume * static_cast<double>(1 + i % 3);
  const auto energy = force.energy(x, hmps::scalars(volume));
  const auto near_to = [](double a, double b) { EXPECT_NEAR(a, b, 1e-10 * b); };
  EXPECT_EQ(energy.of_term[0], 0);
  near_to(energy.of_term[1], hmps::strain_energy(hmps::matrices(F), law, hmps::scalars(volume)));
  near_to(energy.of_term[2],
          hmps::artificial_energy(s.bonds, x, hmps::matrices(F), hmps::scalars(m.modulus), hmps::scalars(volume)));
  EXPECT_EQ(energy.of_term[3], 0);
  near_to(energy.of_term[4], hmps::mean_dilatation_energy(s.bonds, hmps::matrices(F), 3e5, hmps::scalars(volume)));
  double sum = 0;
  for (const double term : energy.of_term) sum += term;
  EXPECT_EQ(energy.total(), sum);
  EXPECT_THROW((void)force.energy(x, 0.0), hmps::InputError);
  EXPECT_THROW((void)force.energy(x.part(0, 3), 1.0), hmps::InputError);
}

}  // namespace force_energy_test
