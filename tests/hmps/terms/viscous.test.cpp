// SPDX-License-Identifier: MIT
#include "hmps/terms/viscous.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "../bonds/bonds_of_a_scene.hpp"
#include "../force/equations.hpp"
#include "hmps/force/internal_force.hpp"

namespace viscous_test {

using namespace equations;
using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;

template <class B>
class ViscousForce : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::LatticeBonds<double, 2>, hmps::BondList<float, 2>,
                              hmps::BondList<double, 3>>;
TYPED_TEST_SUITE(ViscousForce, Models);

// Eq. (21) alone; the momentum stays.
TYPED_TEST(ViscousForce, IsThatOfThePlainEquation) {
  constexpr int D = TypeParam::dimension;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    if (is_lattice<TypeParam> && scene.jittered) continue;
    const auto bonds = make_bonds<TypeParam>(scene);
    auto force = hmps::internal_force(bonds, hmps::viscous(density, viscosity));
    Vectors<D> f(scene.x.size());
    force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(f));
    const Expected<D> expected(scene, Materials(scene.x.size()), bonds.standard_lambda(), bonds.standard_density());
    const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
    EXPECT_LE(largest_difference<D>(f, [&](std::size_t i) { return expected.viscous[i]; }), tolerance.viscous);
    hmps::Vector<double, D> sum = hmps::Vector<double, D>::Zero();
    for (const auto& value : f) sum += value;
    EXPECT_LE(sum.norm(), tolerance.viscous * std::sqrt(static_cast<double>(f.size())));
  }
}

// The model of the Laplacian is exact for a quadratic velocity field inside a cubic lattice.
TEST(Viscous, IsTheLaplacianOfAQuadraticField) {
  const double l0 = scenes::Scene<3>::spacing;
  const auto points = scenes::box<3>({5, 5, 5});
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(points), {.spacing = l0});
  Vectors<3> v, f(points.size());
  for (const auto& p : points) v.push_back({p[1] * p[1], 0, 3 * p[2] * p[2] - p[0] * p[0]});
  auto force = hmps::internal_force(bonds, hmps::viscous(1000, 2e-3));
  force(hmps::vectors(points), hmps::vectors(v), hmps::vectors(f));
  EXPECT_NEAR(f[62][0], 1000 * 2e-3 * 2, 1e-7);
  EXPECT_NEAR(f[62][1], 0, 1e-7);
  EXPECT_NEAR(f[62][2], 1000 * 2e-3 * 4, 1e-7);
}

// d = rho nu 2 D / (lambda n^0) with n^0 = 7.432146 and lambda = 1.405677 l0^2.
TEST(Viscous, DampingHasTheStandardValues) {
  const auto points = scenes::box<3>({4, 4, 4});
  const double l0 = scenes::Scene<3>::spacing;
  const hmps::LatticeBonds<float, 3> bonds(hmps::vectors(points), {.spacing = l0});
  const double expected = 1000 * 2e-3 * 6 / (1.405677 * l0 * l0 * 7.432146);
  EXPECT_NEAR(hmps::viscous(1000, 2e-3).damping(bonds), expected, 1e-6 * expected);
}

TEST(Viscous, RejectsInvalidParameters) {
  EXPECT_NO_THROW((void)hmps::viscous(1000, 0));
  for (const double bad : {0.0, -1000.0, std::numeric_limits<double>::quiet_NaN()}) {
    const std::string text = error_of([&] { (void)hmps::viscous(bad, 2e-3); });
    EXPECT_TRUE(has(text, "the density is " + hmps::detail::message(bad) + " kg/m3")) << text;
  }
  for (const double bad : {-2e-3, std::numeric_limits<double>::infinity()}) {
    const std::string text = error_of([&] { (void)hmps::viscous(1000, bad); });
    EXPECT_TRUE(has(text, "the viscosity is " + hmps::detail::message(bad) + " m2/s")) << text;
  }
  // Also a number beside a view or a callable.
  const std::vector<double> of_each(3, 1.0);
  EXPECT_THROW((void)hmps::viscous(hmps::scalars(of_each), -2e-3), hmps::InputError);
  EXPECT_THROW((void)hmps::viscous(-1.0, [](const auto& at) { return static_cast<double>(at.index); }),
               hmps::InputError);
}

// One rule for a number and for the values of a view.
TEST(Viscous, RefusesADensityOfZeroButNotAViscosityOfZero) {
  const auto points = scenes::box<3>({3, 3, 3});
  const hmps::BondList<double, 3> bonds(hmps::vectors(points), {.spacing = scenes::Scene<3>::spacing});
  std::vector<double> rho(points.size(), 1000), nu(points.size(), 0);
  const auto make = [&] { (void)hmps::internal_force(bonds, hmps::viscous(hmps::scalars(rho), hmps::scalars(nu))); };
  EXPECT_NO_THROW(make());
  rho[5] = 0;
  const std::string text = error_of(make);
  EXPECT_TRUE(has(text, "density of the viscous force of particle 5 is 0 kg/m3") && has(text, "positive")) << text;
  rho[5] = 1000;
  nu[5] = -1e-3;
  EXPECT_TRUE(has(error_of(make), "viscosity of particle 5 is -0.001 m2/s"));
}

// Earlier, one particle that was too close to another changed the force of the whole body by a factor of 2.5 and more.
TEST(Viscous, DoesNotChangeWithAParticleThatIsTooCloseElsewhere) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  auto points = scenes::box<3>({9, 5, 5});
  const auto force_in_the_middle = [&] {
    const hmps::BondList<double, 3> bonds(hmps::vectors(points), {.spacing = l0});
    auto force = hmps::internal_force(bonds, hmps::viscous(1000, 0.02));
    std::vector<hmps::Vector<double, 3>> v(points.size(), hmps::Vector<double, 3>::Zero()), f = v;
    v[points.size() / 2][0] = 1;  // in the middle
    force(hmps::vectors(points), hmps::vectors(v), hmps::vectors(f));
    return f[points.size() / 2][0];
  };
  const double right = force_in_the_middle();
  for (const double away : {0.3, 0.1, 0.01}) {
    points.push_back(points[0] - away * hmps::Vector<double, 3>::Constant(l0 / std::sqrt(3.0)));
    EXPECT_NEAR(force_in_the_middle(), right, 0.01 * std::abs(right)) << away;
    points.pop_back();
  }
}

/// The rate at which a free oscillation with the velocity cos(k x) along a bar of `height` x `width` particles decays,
/// over that in bulk, nu k^2 / 2, from the power of the viscous force: half of the energy is kinetic. Only the middle
/// of a bar that is wider than high counts.
double decay_of_a_bar(int height, int width) {
  constexpr double l0 = 1e-3, rho = 1000, nu = 0.01;
  constexpr int length = 32, end = 8;  // spacings
  const double k = 2 * 3.14159265358979 / (length * l0);
  std::vector<hmps::Vector<double, 3>> points;
  for (int a = 0; a < length; ++a)
    for (int b = 0; b < width; ++b)
      for (int c = 0; c < height; ++c) points.emplace_back(a * l0, b * l0, c * l0);
  const hmps::BondList<double, 3> bonds(hmps::vectors(points), {.spacing = l0});
  auto force = hmps::internal_force(bonds, hmps::viscous(rho, nu));
  std::vector<hmps::Vector<double, 3>> v(points.size(), hmps::Vector<double, 3>::Zero()), f = v;
  for (std::size_t i = 0; i < v.size(); ++i) v[i][0] = std::cos(k * points[i][0]);
  force(hmps::vectors(points), hmps::vectors(v), hmps::vectors(f));
  const double middle = 0.5 * (width - 1) * l0, counted = width > height ? 1.5 * l0 : middle + l0;
  double power = 0, energy = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (points[i][0] < end * l0 || points[i][0] > (length - end) * l0) continue;
    if (std::abs(points[i][1] - middle) > counted) continue;
    power -= f[i].dot(v[i]);
    energy += 0.5 * rho * v[i].squaredNorm();
  }
  return power / (4 * energy) / (0.5 * nu * k * k);
}

// The table of docs/choosing.md.
TEST(Viscous, DampsThinBodiesAtOtherRatesThanBulk) {
  const std::vector<std::array<double, 3>> table{{2, 1.16, 1.36}, {3, 0.90, 0.80}, {5, 0.94, 0.88}, {10, 0.97, 0.94}};
  for (const auto& [layers, sheet, bar] : table) {
    const int height = static_cast<int>(layers);
    EXPECT_NEAR(decay_of_a_bar(height, height), bar, 0.006) << layers;
    EXPECT_NEAR(decay_of_a_bar(height, 16), sheet, 0.006) << layers;
  }
}

/// The rate at which the spin of a free disc or ball of `radius` spacings decays, over (D + 2) nu / R^2, from the
/// torque of the viscous force: where a body rotates at omega, nu |grad v|^2 = 2 nu omega^2 although nothing deforms.
template <int D>
double decay_of_spin(double radius) {
  using V = hmps::Vector<double, D>;
  constexpr double l0 = 1e-3, rho = 1000, nu = 1e-3;
  const int most = static_cast<int>(radius) + 1;
  std::vector<V> points;
  for (int a = -most; a < most; ++a)
    for (int b = -most; b < most; ++b)
      for (int c = D == 3 ? -most : 0; c < (D == 3 ? most : 1); ++c) {
        V x;
        x[0] = a + 0.5;
        x[1] = b + 0.5;
        if constexpr (D == 3) x[2] = c + 0.5;
        if (x.norm() < radius) points.push_back(l0 * x);
      }
  const hmps::BondList<double, D> bonds(hmps::vectors(points), {.spacing = l0});
  auto force = hmps::internal_force(bonds, hmps::viscous(rho, nu));
  std::vector<V> v(points.size(), V::Zero()), f = v;
  double torque = 0, inertia = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    v[i][0] = -points[i][1];
    v[i][1] = points[i][0];
    inertia += rho * v[i].squaredNorm();
  }
  force(hmps::vectors(points), hmps::vectors(v), hmps::vectors(f));
  for (std::size_t i = 0; i < v.size(); ++i) torque -= f[i].dot(v[i]);
  return torque / inertia / ((D + 2) * nu / (radius * l0 * radius * l0));
}

// The figures of docs/choosing.md.
TEST(Viscous, SlowsRigidRotation) {
  const std::vector<std::array<double, 3>> table{{5, 0.84, 0.79}, {10, 0.92, 0.90}, {15, 0.94, 0.93}};
  for (const auto& [radius, disc, ball] : table) {
    EXPECT_NEAR(decay_of_spin<2>(radius), disc, 0.006) << radius;
    EXPECT_NEAR(decay_of_spin<3>(radius), ball, 0.006) << radius;
  }
}

}  // namespace viscous_test
