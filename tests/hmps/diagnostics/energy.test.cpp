// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/energy.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "hmps/analysis/probed_scene.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/laws/saint_venant_kirchhoff.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace energy_test {

using namespace hmps;

constexpr double spacing = 1e-3;

template <int D>
std::vector<Vector<double, D>> box(int n) {
  std::vector<Vector<double, D>> x;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < (D == 3 ? n : 1); ++k) {
        Vector<double, D> position;
        position[0] = spacing * i;
        position[1] = spacing * j;
        if constexpr (D == 3) position[2] = spacing * k;
        x.push_back(position);
      }
  return x;
}
template <int D>
void disturb(std::vector<Vector<double, D>>& x, double size) {
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < D; ++c) x[i][c] += size * detail::noise(i * D + static_cast<std::size_t>(c));
}

TEST(Energy, KineticEnergyIsTheSumOverMasses) {
  std::vector<Vector<float, 2>> v{{3, 4}, {0, 2}};
  std::vector<double> density{1000, 500}, volume{1e-3, 4e-3};
  EXPECT_DOUBLE_EQ(kinetic_energy(vectors(v), scalars(density), scalars(volume)), 0.5 * 25 + 0.5 * 2 * 4);
  EXPECT_DOUBLE_EQ(kinetic_energy(vectors(v), 1000.0, 1e-3), 0.5 * 25 + 0.5 * 4);
}

TEST(Energy, StrainEnergyTakesOneLawOrOneForEach) {
  Matrix<double, 3> F = Matrix<double, 3>::Identity();
  F(0, 1) = 0.5;
  std::vector<Matrix<double, 3>> gradients(3, F);
  gradients[1].setIdentity();
  const auto law = MooneyRivlin<double>::from_young(20e3, 1e6);
  const double one = energy_density(law, F);
  EXPECT_DOUBLE_EQ(strain_energy(matrices(gradients), law, 2.0), 4 * one);
  std::vector<float> c1{1000, 1000, 2000}, c2{1000, 1000, 2000}, d1{1e6f, 1e6f, 2e6f};
  // W of a simple shear is (C1 + C2) gamma^2.
  const auto each = [&](const auto& at) { return MooneyRivlin{at(scalars(c1)), at(scalars(c2)), at(scalars(d1))}; };
  EXPECT_NEAR(strain_energy(matrices(gradients), each, 1.0), (2000 + 4000) * 0.25, 1e-9);
  std::vector<double> table{1000, 2000};
  std::vector<int> body{0, 0, 1};
  const auto by_body = [&](const auto& at) {
    const double c = at(scalars(table), scalars(body));
    return MooneyRivlin<double>{c, c, 1e6};
  };
  EXPECT_NEAR(strain_energy(matrices(gradients), by_body, 1.0), (2000 + 4000) * 0.25, 1e-9);
}

template <int D>
void artificial_energy_is_that_of_the_error() {
  // Displace one particle of an undeformed box by d with F kept at 1: by eq. 9 the error is |d|^2 sum w for the
  // particle itself and |d|^2 w for each neighbour.
  auto x = box<D>(4);
  const BondList<double, D> bonds(vectors(x), {.spacing = spacing});
  std::vector<Matrix<double, D>> F(x.size(), Matrix<double, D>::Identity());
  EXPECT_LT(artificial_energy(bonds, vectors(x), matrices(F), 2e4, 1e-9), 1e-28);
  const LatticeBonds<float, D> single(vectors(x), {.spacing = spacing});
  const std::size_t moved = x.size() / 2;
  x[moved][0] += 1e-4;
  double expected = 0;
  bonds.for_each_bond(moved, [&](std::size_t j, const auto&, double w) {
    for (const std::size_t i : {moved, j}) expected += 2e4 * D / bonds.shape_trace(i) * 0.5 * w * 1e-8;
  });
  EXPECT_NEAR(artificial_energy(bonds, vectors(x), matrices(F), 2e4, 1e-9), 1e-9 * expected, 1e-12 * 1e-9 * expected);
  std::vector<double> moduli(x.size(), 2e4);
  EXPECT_NEAR(artificial_energy(bonds, vectors(x), matrices(F), scalars(moduli), 1e-9), 1e-9 * expected,
              1e-12 * 1e-9 * expected);
  EXPECT_NEAR(artificial_energy(single, vectors(x), matrices(F), 2e4, 1e-9), 1e-9 * expected, 4e-7 * 1e-9 * expected);
}
TEST(Energy, ArtificialEnergyIsThatOfTheError2D) { artificial_energy_is_that_of_the_error<2>(); }
TEST(Energy, ArtificialEnergyIsThatOfTheError3D) { artificial_energy_is_that_of_the_error<3>(); }

template <int D>
void force_is_minus_the_gradient_of_the_energy() {
  auto x = box<D>(4);
  const BondList<double, D> bonds(vectors(x), {.spacing = spacing});
  const MooneyRivlin<double> law{2000, 1000, 30000};
  const double modulus = 18000, volume = D == 3 ? 1e-9 : 1e-6;
  auto force = internal_force(bonds, elastic(law), artificial(modulus));
  disturb<D>(x, 0.1 * spacing);
  std::vector<Matrix<double, D>> F(x.size());
  const auto energy = [&] {
    deformation_gradient(bonds, vectors(x), matrices(F));
    return strain_energy(matrices(F), law, volume) + artificial_energy(bonds, vectors(x), matrices(F), modulus, volume);
  };
  std::vector<Vector<double, D>> f(x.size());
  force(vectors(x), vectors(x), vectors(f));
  double scale = 0;
  for (const auto& density : f) scale = std::max(scale, density.norm());
  const double h = 1e-5 * spacing;
  for (const std::size_t i : {std::size_t{0}, x.size() / 2, x.size() - 2}) {
    for (int c = 0; c < D; ++c) {
      const double old = x[i][c];
      x[i][c] = old + h;
      const double more = energy();
      x[i][c] = old - h;
      const double less = energy();
      x[i][c] = old;
      // Central difference: h^2 of relative truncation, eps W / h of rounding; both below 1e-7 of the largest force.
      EXPECT_NEAR(f[i][c] * volume, -(more - less) / (2 * h), 1e-7 * scale * volume) << "particle " << i;
    }
  }
}
TEST(Energy, ForceIsMinusItsGradient2D) { force_is_minus_the_gradient_of_the_energy<2>(); }
TEST(Energy, ForceIsMinusItsGradient3D) { force_is_minus_the_gradient_of_the_energy<3>(); }

TEST(Energy, FreeVibrationKeepsItToTheFirstOrderOfTheStep) {
  const auto reference = box<2>(6);
  const BondList<double, 2> bonds(vectors(reference), {.spacing = spacing});
  const MooneyRivlin<double> law{2000, 1000, 30000};
  const double modulus = 18000, volume = 1e-6, density = 1000;
  const auto deviation = [&](int steps) {
    auto force = internal_force(bonds, elastic(law), artificial(modulus));
    auto x = reference;
    std::vector<Vector<double, 2>> v(x.size(), Vector<double, 2>::Zero()), f(x.size());
    std::vector<Matrix<double, 2>> F(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) v[i][0] = 100 * x[i][1];
    const auto energy = [&] {
      deformation_gradient(bonds, vectors(x), matrices(F));
      return kinetic_energy(vectors(v), density, volume) + strain_energy(matrices(F), law, volume) +
             artificial_energy(bonds, vectors(x), matrices(F), modulus, volume);
    };
    const double start = energy();
    double worst = 0;
    for (int s = 0; s < steps; ++s) {
      force(vectors(x), vectors(v), vectors(f));
      kick(vectors(v), vectors(f), density, 4e-3 / steps);
      drift(vectors(x), vectors(v), 4e-3 / steps);
      worst = std::max(worst, std::abs(energy() - start) / start);
    }
    return worst;
  };
  const double coarse = deviation(200), fine = deviation(400);
  EXPECT_LT(coarse, 0.2);
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.1);
}

TEST(Energy, RejectsInvalidLawsAndModuli) {
  std::vector<Vector<double, 3>> x;
  for (int i = 0; i < 27; ++i) x.emplace_back(spacing * Vector<double, 3>(i % 3, i / 3 % 3, i / 9));
  const std::vector<Matrix<double, 3>> F(x.size(), Matrix<double, 3>::Identity());
  const BondList<double, 3> bonds(vectors(x), {.spacing = spacing});
  const double volume = spacing * spacing * spacing;
  EXPECT_THROW((void)strain_energy(matrices(F), NeoHookean<>{-1, 1e5}, volume), InputError);
  std::vector<double> moduli(x.size(), 1e3);
  for (const double bad : {-1e3, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    moduli[5] = bad;
    EXPECT_THROW((void)artificial_energy(bonds, vectors(x), matrices(F), bad, volume), InputError);
    EXPECT_THROW((void)artificial_energy(bonds, vectors(x), matrices(F), scalars(moduli), volume), InputError);
    EXPECT_THROW((void)mean_dilatation_energy(bonds, matrices(F), bad, volume), InputError);
    EXPECT_THROW((void)mean_dilatation_energy(bonds, matrices(F), scalars(moduli), volume), InputError);
  }
}

TEST(Energy, RejectsAnInvalidModulusInTheLawOfAParticle) {
  const std::vector<Matrix<double, 3>> F(4, Matrix<double, 3>::Identity());
  std::vector<double> shear(4, 1e3);
  const auto energy = [&] {
    return strain_energy(
        matrices(F),
        [&](const auto& at) {
          return NeoHookean{at(scalars(shear)), 1e5};
        },
        1e-9);
  };
  EXPECT_EQ(energy(), 0);
  for (const double bad : {-1e3, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    shear[2] = bad;
    EXPECT_THROW((void)energy(), InputError) << bad;
  }
}

// Bonds that know the volumes of their particles make another force, whose energy needs the same volumes.
TEST(Energy, RefusesVolumesOtherThanThoseOfTheBonds) {
  std::vector<Vector<double, 3>> x;
  for (int i = 0; i < 27; ++i) x.emplace_back(spacing * Vector<double, 3>(i % 3, i / 3 % 3, i / 9));
  const std::vector<Matrix<double, 3>> F(x.size(), Matrix<double, 3>::Identity());
  const double cell = spacing * spacing * spacing;
  std::vector<double> volumes(x.size(), cell), unlike(x.size(), cell);
  for (std::size_t i = 0; i < x.size(); i += 2) unlike[i] *= 1.5;
  const BondList<double, 3> alike(vectors(x), {.spacing = spacing}, scalars(volumes));
  const BondList<double, 3> bonds(vectors(x), {.spacing = spacing}, scalars(unlike));
  EXPECT_NO_THROW((void)artificial_energy(alike, vectors(x), matrices(F), 1e3, cell));
  EXPECT_NO_THROW((void)artificial_energy(bonds, vectors(x), matrices(F), 1e3, scalars(unlike)));
  EXPECT_NO_THROW((void)mean_dilatation_energy(bonds, matrices(F), 1e3, scalars(unlike)));
  EXPECT_THROW((void)artificial_energy(bonds, vectors(x), matrices(F), 1e3, cell), InputError);
  EXPECT_THROW((void)artificial_energy(bonds, vectors(x), matrices(F), 1e3, scalars(volumes)), InputError);
  EXPECT_THROW((void)mean_dilatation_energy(bonds, matrices(F), 1e3, cell), InputError);
}

}  // namespace energy_test
