// SPDX-License-Identifier: MIT
#include "hmps/terms/artificial_tension.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "../bonds/bonds_of_a_scene.hpp"
#include "../force/equations.hpp"
#include "hmps/diagnostics/momentum.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/mean_dilatation.hpp"

namespace artificial_tension_test {

using namespace equations;
using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;

static_assert(hmps::LengthTerm<hmps::ArtificialTension<double>, float, 3>);
static_assert(hmps::ForceTerm<hmps::ArtificialTension<double>, double, 2>);
static_assert(!hmps::LengthTerm<hmps::Artificial<double>, double, 3>);
static_assert(!hmps::CouplingTerm<hmps::ArtificialTension<double>, double, 3>);

template <class B>
class ArtificialTensionForce : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::LatticeBonds<double, 2>, hmps::BondList<float, 2>,
                              hmps::BondList<double, 3>>;
TYPED_TEST_SUITE(ArtificialTensionForce, Models);

/// C_i / 2 sum_j (|r_ij| - |F_i r0_ij|)^2 w_ij, bond by bond.
template <int D>
struct Plain {
  using Vec = Eigen::Matrix<double, D, 1>;
  plain::Body<double, D> body;
  std::vector<double> modulus;

  Plain(const scenes::Scene<D>& scene, std::vector<double> moduli)
      : body(Expected<D>::convert(scene.reference), 1.75 * scene.spacing, scene.bonded), modulus(std::move(moduli)) {}

  [[nodiscard]] double energy(const std::vector<Vec>& x) const {
    std::vector<Eigen::Matrix<double, D, D>> F(x.size());
    body.deformation_gradient(x, F);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      body.for_each_bond(i, [&](const auto& bond) {
        const double misfit = (x[bond.j] - x[i]).norm() - (F[i] * bond.r0).norm();
        sum += modulus[i] * D / body.shape_trace(i) / 2 * bond.w * misfit * misfit;
      });
    return sum;
  }
};

TYPED_TEST(ArtificialTensionForce, IsMinusTheGradientOfTheEnergy) {
  constexpr int D = TypeParam::dimension;
  using K = typename TypeParam::Scalar;
  for (const bool jittered : {false, true}) {
    if (jittered && is_lattice<TypeParam>) continue;
    const auto scene = bent_box<D>(jittered);
    const Materials m(scene.x.size());
    const auto bonds = make_bonds<TypeParam>(scene);
    const auto modulus = hmps::scalars(m.modulus);
    auto force = hmps::internal_force(bonds, hmps::artificial_tension([&](const auto& at) { return at(modulus); }));
    Vectors<D> f(scene.x.size());
    force(hmps::vectors(scene.x), hmps::vectors(f));

    const Plain<D> plain(scene, m.modulus);
    auto x = Expected<D>::convert(scene.x);
    const double volume = std::pow(scene.spacing, D), energy = volume * plain.energy(x);
    EXPECT_NEAR(force.energy(hmps::vectors(scene.x), volume).total(), energy, 1e-3 * energy);
    expect_minus_gradient<D>(
        f, x, [&] { return plain.energy(x); }, scene.spacing, Tolerance<K, D>(scene).elastic);
  }
}

// Beside the other terms, with a mean dilatation whose sweeps keep F, it adds the same force.
TYPED_TEST(ArtificialTensionForce, AddsToTheOtherTerms) {
  constexpr int D = TypeParam::dimension;
  const auto scene = bent_box<D>(!is_lattice<TypeParam>);
  const auto bonds = make_bonds<TypeParam>(scene);
  const auto law = hmps::MooneyRivlin<>::from_young(20e3, 2e5);
  const auto tension = hmps::artificial_tension(3e4);
  auto alone = hmps::internal_force(bonds, tension);
  auto others = hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation(4e5), hmps::artificial(1e4));
  auto all =
      hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation(4e5), tension, hmps::artificial(1e4));
  Vectors<D> a(scene.x.size()), b = a, sum = a;
  alone(hmps::vectors(scene.x), hmps::vectors(a));
  others(hmps::vectors(scene.x), hmps::vectors(b));
  all(hmps::vectors(scene.x), hmps::vectors(sum));
  const double tolerance = 20 * Tolerance<typename TypeParam::Scalar, D>(scene).elastic;  // the bulk modulus is higher
  EXPECT_LE(largest_difference<D>(sum, [&](std::size_t i) { return a[i] + b[i]; }), tolerance);
  EXPECT_GT(largest_difference<D>(sum, [&](std::size_t i) { return b[i]; }), 50 * tolerance);
}

// F resolves uniform deformation, however large: turned by 100 degrees and stretched by half.
TYPED_TEST(ArtificialTensionForce, IsZeroUnderUniformDeformation) {
  constexpr int D = TypeParam::dimension;
  auto scene = bent_box<D>(!is_lattice<TypeParam>);
  Eigen::Matrix<double, D, D> F = Eigen::Matrix<double, D, D>::Identity();
  F(0, 0) = F(1, 1) = -0.25;
  F(0, 1) = -1.5;
  F(1, 0) = 1;
  for (std::size_t i = 0; i < scene.x.size(); ++i) scene.x[i] = F * scene.reference[i];
  const auto bonds = make_bonds<TypeParam>(scene);
  auto force = hmps::internal_force(bonds, hmps::artificial_tension(2e4));
  Vectors<D> f(scene.x.size());
  force(hmps::vectors(scene.x), hmps::vectors(f));
  const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
  EXPECT_LE(largest_difference<D>(f, [](std::size_t) { return hmps::Vector<double, D>::Zero(); }), tolerance.elastic);
}

TYPED_TEST(ArtificialTensionForce, ConservesMomentumAndAngularMomentum) {
  constexpr int D = TypeParam::dimension;
  const auto scene = bent_box<D>(!is_lattice<TypeParam>);
  const Materials m(scene.x.size());
  const auto bonds = make_bonds<TypeParam>(scene);
  const auto modulus = hmps::scalars(m.modulus);
  auto force = hmps::internal_force(bonds, hmps::artificial_tension([&](const auto& at) { return at(modulus); }));
  Vectors<D> f(scene.x.size());
  force(hmps::vectors(scene.x), hmps::vectors(f));
  hmps::Vector<double, D> sum = hmps::Vector<double, D>::Zero();
  hmps::Axial<D> torque = hmps::Axial<D>::Zero();
  double sizes = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    sum += f[i];
    torque += hmps::cross<D>(scene.x[i] - scene.x[0], f[i]);
    sizes += f[i].norm();
  }
  const double rounding = 50 * static_cast<double>(std::numeric_limits<typename TypeParam::Scalar>::epsilon());
  EXPECT_GT(sizes, 0);
  EXPECT_LE(sum.norm(), rounding * sizes);
  EXPECT_LE(torque.norm(), rounding * sizes * 6 * scene.spacing);
}

// Particles at the same place, and particles in a plane, whose F is singular: every number stays finite.
TYPED_TEST(ArtificialTensionForce, StaysFiniteWhereLengthsVanish) {
  constexpr int D = TypeParam::dimension;
  auto scene = bent_box<D>(false);
  const auto bonds = make_bonds<TypeParam>(scene);
  auto force = hmps::internal_force(bonds, hmps::artificial_tension(2e4));
  for (const double left : {0.0, 1e-30, 1e-12}) {
    Vectors<D> x = scene.reference, f(x.size());
    for (auto& place : x) place[0] *= left;
    force(hmps::vectors(x), hmps::vectors(f));
    for (const auto& own : f) ASSERT_TRUE(own.allFinite()) << left;
    for (auto& place : x) place *= left;
    force(hmps::vectors(x), hmps::vectors(f));
    for (const auto& own : f) ASSERT_TRUE(own.allFinite()) << left;
  }
}

// With volumes, V_i f_i derives from the energy with these volumes.
TEST(ArtificialTension, WeighsVolumes) {
  auto scene = bent_box<3>(true);
  scenes::Random random(5);
  std::vector<double> volume;
  for (std::size_t i = 0; i < scene.x.size(); ++i) volume.push_back(std::pow(scene.spacing, 3) * random(0.8, 1.2));
  const hmps::BondList<double, 3> bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing},
                                        hmps::scalars(volume));
  auto force = hmps::internal_force(bonds, hmps::artificial_tension(2e4));
  Vectors<3> f(scene.x.size());
  force(hmps::vectors(scene.x), hmps::vectors(f));
  const double h = 1e-4 * scene.spacing;
  for (std::size_t i = 0; i < f.size(); i += 11)
    for (int c = 0; c < 3; ++c) {
      const double at = scene.x[i][c];
      const auto energy = [&](double place) {
        scene.x[i][c] = place;
        return force.energy(hmps::vectors(scene.x), hmps::scalars(volume)).total();
      };
      const double slope = (energy(at + h) - energy(at - h)) / (2 * h);
      scene.x[i][c] = at;
      EXPECT_NEAR(volume[i] * f[i][c], -slope, 1e-4 * volume[i] * f[i].norm());
    }
}

TEST(ArtificialTension, RefusesAModulusThatIsNegativeOrNotFinite) {
  EXPECT_NO_THROW((void)hmps::artificial_tension(0.0));
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const std::string text = error_of([&] { (void)hmps::artificial_tension(bad); });
    EXPECT_TRUE(has(text, "modulus of the artificial tension is " + hmps::detail::message(bad) + " Pa")) << text;
  }
  const auto scene = bent_box<3>(false);
  const auto bonds = make_bonds<hmps::BondList<double, 3>>(scene);
  std::vector<double> moduli(scene.x.size(), 1e4);
  moduli[7] = -3;
  const auto one = hmps::artificial_tension([&](const auto& at) { return at(hmps::scalars(moduli)); });
  EXPECT_TRUE(has(error_of([&] { (void)hmps::internal_force(bonds, one); }), "artificial tension of particle 7 is -3"));
  moduli.pop_back();
  EXPECT_THROW((void)hmps::internal_force(bonds, hmps::artificial_tension(hmps::scalars(moduli))), hmps::InputError);
}

}  // namespace artificial_tension_test
