// SPDX-License-Identifier: MIT
#include "hmps/motion/hold.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "hmps/analysis/relaxation.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/diagnostics/net_force.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/dead_load.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/gravity.hpp"
#include "hmps/terms/shear_wave_modulus.hpp"

namespace hold_test {

using Vector = hmps::Vector<float, 3>;
const hmps::ParticleSet last(3, std::vector<hmps::Index>{2});

TEST(Hold, StopsTheParticlesOfTheSetAndNoOthers) {
  std::vector<Vector> v(3, Vector(1, 2, 3));
  hmps::hold(hmps::vectors(v), last);
  EXPECT_EQ(v, (std::vector<Vector>{{1, 2, 3}, {1, 2, 3}, {0, 0, 0}}));
}

TEST(Hold, FixesOneComponent) {
  std::vector<Vector> v(3, Vector(1, 2, 3));
  hmps::hold_component(hmps::vectors(v), last, 1);
  EXPECT_EQ(v, (std::vector<Vector>{{1, 2, 3}, {1, 2, 3}, {1, 0, 3}}));
  hmps::hold_component(hmps::vectors(v), ~last, 2, -0.5);
  EXPECT_EQ(v, (std::vector<Vector>{{1, 2, -0.5}, {1, 2, -0.5}, {1, 0, 3}}));
}

TEST(Hold, TakesTheComponentAlongANormal) {
  std::vector<Vector> v(3, Vector(1, 2, 3));
  hmps::hold_along(hmps::vectors(v), last, Eigen::Vector3d(3, 4, 0));
  // (1, 2, 3) less 11/25 (3, 4, 0)
  EXPECT_LE((v[2] - Vector(-0.32f, 0.24f, 3)).norm(), 1e-6f);
  EXPECT_EQ(v[0], Vector(1, 2, 3));
}

TEST(Hold, TakesANormalOfAnyLength) {
  for (const double length : {1e-320, 1e-200, 1e200, 1e308}) {
    std::vector<Vector> v(3, Vector(1, 2, 3));
    hmps::hold_along(hmps::vectors(v), last, Eigen::Vector3d(0, 0, length));
    EXPECT_EQ(v[2], Vector(1, 2, 0)) << length;
  }
}

/// How far the last column of a cantilever in plane strain sinks, 40 x 5 mm and five layers, over the deflection of
/// Timoshenko's beam there. Its first column lies `behind` spacings behind the clamped face; the `held` first ones are
/// held.
double sag_over_beam(double behind, int held) {
  using V2 = hmps::Vector<double, 2>;
  constexpr double length = 40e-3, height = 5e-3, l0 = height / 5, rho = 1000, g = 0.1;
  const auto law = hmps::NeoHookean<>::from_young_poisson(30e3, 0.4);
  std::vector<V2> reference;
  for (double x = -behind * l0; x < length - 0.25 * l0; x += l0)
    for (int k = 0; k < 5; ++k) reference.emplace_back(x, (k + 0.5) * l0);
  const std::size_t n = reference.size();
  const hmps::ParticleSet clamped(n, [&](std::size_t i) { return i < std::size_t(5 * held); });
  const hmps::LatticeBonds<double, 2> bonds(hmps::vectors(reference), {.spacing = l0});
  auto force =
      hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(hmps::shear_wave_modulus(law.shear_modulus())),
                           hmps::gravity(rho, V2(0, -g)));
  std::vector<V2> x = reference, v(n, V2::Zero()), f = v;
  hmps::relax(force, hmps::vectors(x), hmps::vectors(v), hmps::vectors(f), rho,
              {.spacing = l0, .tolerance = 1e-5, .load = rho * g * length * height, .moves = ~clamped});
  double sag = 0;
  for (std::size_t i = n - 5; i < n; ++i) sag += (reference[i] - x[i])[1] / 5;
  const double at = reference[n - 1][0], end = at + l0 / 2, load = rho * g * height;
  const double bending = 30e3 / (1 - 0.4 * 0.4) * std::pow(height, 3) / 12;
  const double shear = 5. / 6 * law.shear_modulus() * height;
  const double beam =
      load / (24 * bending) * at * at * (at * at - 4 * end * at + 6 * end * end) + load / shear * at * (end - at / 2);
  return sag / beam;
}

// The advice of docs/choosing.md.
TEST(Hold, BodyBeginsToDeformAtTheHeldLayer) {
  EXPECT_NEAR(sag_over_beam(0, 1), 1.007, 0.003);
  EXPECT_NEAR(sag_over_beam(0.5, 1), 1.059, 0.003);
  EXPECT_NEAR(sag_over_beam(1.5, 2), 1.096, 0.003);
}

/// The stretch of each gap between the columns of a bar over that of uniaxial tension without lateral contraction, if
/// its first column is held and its last one is pulled.
std::vector<double> gaps_in_tension(int columns) {
  using V2 = hmps::Vector<double, 2>;
  constexpr double l0 = 1e-3, rho = 1000, shear = 5e3, load = 1, height = 7 * l0;
  std::vector<V2> reference;
  for (int a = 0; a < columns; ++a)
    for (int k = 0; k < 7; ++k) reference.emplace_back(a * l0, k * l0);
  const std::size_t n = reference.size();
  const hmps::ParticleSet first(n, [](std::size_t i) { return i < 7; });
  const hmps::ParticleSet pulled(n, [&](std::size_t i) { return i >= n - 7; });
  const hmps::LatticeBonds<double, 2> bonds(hmps::vectors(reference), {.spacing = l0});
  auto force = hmps::internal_force(bonds, hmps::elastic(hmps::LinearElastic<double>{0, shear}),
                                    hmps::artificial(hmps::shear_wave_modulus(shear)),
                                    hmps::dead_load(pulled, V2(load, 0), l0 * l0));
  std::vector<V2> x = reference, v(n, V2::Zero()), f = v;
  hmps::relax(force, hmps::vectors(x), hmps::vectors(v), hmps::vectors(f), rho,
              {.spacing = l0, .tolerance = 1e-6, .load = load, .moves = ~first});
  std::vector<double> gaps(static_cast<std::size_t>(columns) - 1, 0);
  for (std::size_t i = 7; i < n; ++i)
    gaps[i / 7 - 1] += ((x[i] - x[i - 7])[0] - l0) / 7 / l0 / (load / height / (2 * shear));
  return gaps;
}

// The figures of docs/choosing.md.
TEST(Hold, ABarInTensionSeemsShorterByAThirdOfASpacingAtEachEnd) {
  for (const int columns : {10, 20}) {
    const auto gaps = gaps_in_tension(columns);
    EXPECT_NEAR(gaps.front(), 0.65, 0.01) << columns;
    EXPECT_NEAR(gaps[1], 1.03, 0.01) << columns;
    EXPECT_NEAR(columns - 1 - std::accumulate(gaps.begin(), gaps.end(), 0.0), 0.64, 0.005) << columns;
  }
}

/// A tissue that contracts along x with the stress `active` (Pa).
struct Contracting {
  hmps::NeoHookean<double> tissue;
  double active;
  template <class T>
  [[nodiscard]] hmps::Matrix<T, 2> second_piola_kirchhoff(const hmps::Matrix<T, 2>& C, const T& J) const {
    hmps::Matrix<T, 2> S = tissue.second_piola_kirchhoff(C, J);
    S(0, 0) = S(0, 0) + T(active);
    return S;
  }
};

/// The force of an isometric contraction, a bar of `columns` columns with `held` of them held at each end, over stress
/// times area, which is exact.
double contraction(int columns, int held) {
  using V2 = hmps::Vector<double, 2>;
  constexpr double l0 = 1e-3, rho = 1000, active = 2e3, height = 5 * l0;
  std::vector<V2> reference;
  for (int a = 0; a < columns; ++a)
    for (int k = 0; k < 5; ++k) reference.emplace_back(a * l0, k * l0);
  const std::size_t n = reference.size();
  const auto at_left = [&](std::size_t i) { return i < static_cast<std::size_t>(5 * held); };
  const hmps::ParticleSet left(n, at_left);
  const hmps::ParticleSet both(n, [&](std::size_t i) { return at_left(i) || at_left(n - 1 - i); });
  const hmps::LatticeBonds<double, 2> bonds(hmps::vectors(reference), {.spacing = l0});
  auto force = hmps::internal_force(bonds, hmps::elastic(Contracting{{10e3, 20e3}, active}),
                                    hmps::artificial(hmps::shear_wave_modulus(10e3)));
  std::vector<V2> x = reference, v(n, V2::Zero()), f = v;
  hmps::relax(force, hmps::vectors(x), hmps::vectors(v), hmps::vectors(f), rho,
              {.spacing = l0, .tolerance = 1e-5, .load = active * height, .moves = ~both});
  return hmps::net_force(hmps::vectors(f), left, l0 * l0)[0] / (active * height);
}

// The figures of docs/choosing.md.
TEST(Hold, TwoLayersCarryAStressOfTheBodysOwnExactly) {
  EXPECT_NEAR(contraction(10, 2), 1, 1e-6);
  EXPECT_NEAR(contraction(10, 1), 1.069, 0.001);
  EXPECT_NEAR(contraction(20, 1), 1.031, 0.001);
}

TEST(Hold, RefusesBadInput) {
  std::vector<Vector> v(3), few(2);
  EXPECT_THROW(hmps::hold(hmps::vectors(few), last), hmps::InputError);
  EXPECT_THROW(hmps::hold_component(hmps::vectors(few), last, 0), hmps::InputError);
  EXPECT_THROW(hmps::hold_component(hmps::vectors(v), last, 3), hmps::InputError);
  EXPECT_THROW(hmps::hold_component(hmps::vectors(v), last, -1), hmps::InputError);
  EXPECT_THROW(hmps::hold_component(hmps::vectors(v), last, 0, std::numeric_limits<double>::quiet_NaN()),
               hmps::InputError);
  EXPECT_THROW(hmps::hold_along(hmps::vectors(v), last, Eigen::Vector3d(0, 0, 0)), hmps::InputError);
  EXPECT_THROW(hmps::hold_along(hmps::vectors(few), last, Eigen::Vector3d(0, 0, 1)), hmps::InputError);
}

}  // namespace hold_test
