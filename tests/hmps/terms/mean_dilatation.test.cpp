// SPDX-License-Identifier: MIT
#include "hmps/terms/mean_dilatation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <vector>

#include "../force/equations.hpp"
#include "hmps/diagnostics/energy.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/law.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/viscous.hpp"

namespace mean_dilatation_test {

using namespace equations;

template <int D>
Vectors<D> force_of(const auto& bonds, const Vectors<D>& x, const auto&... terms) {
  auto force = hmps::internal_force(bonds, terms...);
  Vectors<D> f(x.size());
  force(hmps::vectors(x), hmps::vectors(f));
  return f;
}

/// d_i sum_k d_k = 1 over each particle and its neighbours.
std::vector<double> scales(const auto& body) {
  std::vector<double> d(body.size(), 1.0), next(d);
  for (int iteration = 0; iteration < 200; ++iteration) {
    for (std::size_t i = 0; i < d.size(); ++i) {
      double sum = d[i];
      body.for_each_bond(i, [&](const auto& bond) { sum += d[bond.j]; });
      next[i] = std::sqrt(d[i] / sum);
    }
    d = next;
  }
  return d;
}

template <class B>
class MeanDilatation : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::BondList<double, 2>>;
TYPED_TEST_SUITE(MeanDilatation, Models);

// f_i = -(1 / V) dH/dx_i with H = sum V K_i theta_i^2 / 2, by central differences of an energy summed here.
TYPED_TEST(MeanDilatation, ForceIsTheGradientOfTheEnergy) {
  constexpr int D = TypeParam::dimension;
  for (const bool jittered : {false, true}) {
    if (jittered && is_lattice<TypeParam>) continue;
    const auto scene = bent_box<D>(jittered);
    const std::size_t n = scene.x.size();
    const std::vector<double> bulk = Materials(n).d1;
    const auto bonds = make_bonds<TypeParam>(scene);
    const auto f =
        force_of<D>(bonds, scene.x, hmps::mean_dilatation([&](const auto& at) { return at(hmps::scalars(bulk)); }));

    const plain::Body<double, D> body(Expected<D>::convert(scene.reference), 1.75 * scene.spacing);
    auto x = Expected<D>::convert(scene.x);
    std::vector<Eigen::Matrix<double, D, D>> F(n);
    const std::vector<double> scale = scales(body);
    const auto energy = [&] {
      body.deformation_gradient(x, F);
      double H = 0;
      for (std::size_t i = 0; i < n; ++i) {
        double sum = scale[i] * (F[i].determinant() - 1);
        body.for_each_bond(i, [&](const auto& bond) { sum += scale[bond.j] * (F[bond.j].determinant() - 1); });
        H += bulk[i] / 2 * std::pow(scale[i] * sum, 2);
      }
      return H;
    };
    const double H = energy();
    std::vector<hmps::Matrix<double, D>> gradients(F.begin(), F.end());
    EXPECT_NEAR(hmps::mean_dilatation_energy(bonds, hmps::matrices(gradients), hmps::scalars(bulk), 1.0), H,
                64 * std::numeric_limits<typename TypeParam::Scalar>::epsilon() * H);

    expect_minus_gradient<D>(f, x, energy, scene.spacing, Tolerance<typename TypeParam::Scalar, D>(scene).elastic);
  }
}

// The same with the mean taken twice.
TEST(MeanDilatationTwice, ForceIsTheGradientOfTheEnergy) {
  const auto scene = bent_box<2>(true);
  const std::size_t n = scene.x.size();
  const std::vector<double> bulk = Materials(n).d1;
  const auto bonds = make_bonds<hmps::BondList<double, 2>>(scene);
  const auto f =
      force_of<2>(bonds, scene.x, hmps::mean_dilatation<2>([&](const auto& at) { return at(hmps::scalars(bulk)); }));
  const plain::Body<double, 2> body(Expected<2>::convert(scene.reference), 1.75 * scene.spacing);
  auto x = Expected<2>::convert(scene.x);
  std::vector<Eigen::Matrix<double, 2, 2>> F(n);
  const std::vector<double> scale = scales(body);
  const auto mean = [&](const std::vector<double>& of) {
    std::vector<double> result(n);
    for (std::size_t i = 0; i < n; ++i) {
      result[i] = scale[i] * scale[i] * of[i];
      body.for_each_bond(i, [&](const auto& bond) { result[i] += scale[i] * scale[bond.j] * of[bond.j]; });
    }
    return result;
  };
  const auto energy = [&] {
    body.deformation_gradient(x, F);
    std::vector<double> dilatation;
    for (const auto& of : F) dilatation.push_back(of.determinant() - 1);
    const std::vector<double> theta = mean(mean(dilatation));
    double H = 0;
    for (std::size_t i = 0; i < n; ++i) H += bulk[i] / 2 * theta[i] * theta[i];
    return H;
  };
  const double H = energy();
  std::vector<hmps::Matrix<double, 2>> gradients(F.begin(), F.end());
  EXPECT_NEAR(hmps::mean_dilatation_energy<2>(bonds, hmps::matrices(gradients), hmps::scalars(bulk), 1.0), H,
              64 * std::numeric_limits<double>::epsilon() * H);
  expect_minus_gradient<2>(f, x, energy, scene.spacing, Tolerance<double, 2>(scene).elastic);
}

// The particles that move also get the same bits.
TEST(MeanDilatationTwice, IsTheSameForTheParticlesThatMove) {
  scenes::Scene<2> scene;
  scene.reference = scenes::box<2>({80, 7});
  scenes::move(scene);
  const auto bonds = make_bonds<hmps::BondList<double, 2>>(scene);
  auto force = hmps::internal_force(bonds, hmps::mean_dilatation<2>(1e5));
  auto restricted = force;  // copied before `force` leaves numbers in its scratch memory
  Vectors<2> all(scene.x.size()), some(all);
  force(hmps::vectors(scene.x), hmps::vectors(all));
  const auto moves = [&](std::size_t i) { return scene.reference[i][0] < 20 * scene.spacing; };
  restricted.restrict_to(moves);
  restricted(hmps::vectors(scene.x), hmps::vectors(some));
  for (std::size_t i = 0; i < all.size(); ++i)
    if (moves(i)) {
      ASSERT_EQ(some[i], all[i]) << i;
    }
}

// Where all particles are strained alike, theta is J - 1: a bulk modulus shared between law and mean gives the same
// force as in the law alone.
TYPED_TEST(MeanDilatation, SharesTheBulkModulusOfAUniformStrain) {
  constexpr int D = TypeParam::dimension;
  scenes::Scene<D> scene;
  scene.reference = scenes::box<D>(scenes::extent<D>(7, 5, 4));
  hmps::Matrix<double, D> strain = hmps::Matrix<double, D>::Identity();
  strain(0, 0) = 1.2;
  strain(0, 1) = 0.3;
  strain(1, 1) = 0.9;
  for (const auto& p : scene.reference) scene.x.push_back(strain * p);
  scene.v.resize(scene.x.size());
  const auto bonds = make_bonds<TypeParam>(scene);
  const double bulk = 2.4e4, shear = 6400;
  const auto split = hmps::split_bulk_modulus(bulk, shear);
  EXPECT_EQ(split.law + split.mean, bulk);
  const auto law = [&](double k) { return hmps::elastic(hmps::MooneyRivlin<double>{shear / 4, shear / 4, k / 2}); };
  const auto shared = force_of<D>(bonds, scene.x, law(split.law), hmps::mean_dilatation(split.mean));
  const auto alone = force_of<D>(bonds, scene.x, law(bulk));
  const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
  const double difference = largest_difference<D>(shared, [&](std::size_t i) { return alone[i]; });
  EXPECT_LE(difference, 2 * tolerance.elastic);
}

// The particles that move get the same bits whether or not the others are left out.
TYPED_TEST(MeanDilatation, IsTheSameForTheParticlesThatMove) {
  constexpr int D = TypeParam::dimension;
  scenes::Scene<D> scene;
  scene.reference = scenes::box<D>(scenes::extent<D>(60, 7, 5));
  scenes::move(scene);
  const auto bonds = make_bonds<TypeParam>(scene);
  auto force =
      hmps::internal_force(bonds, hmps::artificial(2e4), hmps::mean_dilatation(1e5), hmps::viscous(1000, 2e-3));
  Vectors<D> all(scene.x.size()), some(all);
  auto restricted = force;  // copied before `force` leaves numbers in its scratch memory
  force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(all));
  const auto moves = [&](std::size_t i) { return scene.reference[i][0] < 20 * scene.spacing; };
  restricted.restrict_to(moves);
  for (int time = 0; time < 2; ++time) {
    restricted(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(some));
    for (std::size_t i = 0; i < all.size(); ++i)
      if (moves(i)) {
        ASSERT_EQ(some[i], all[i]) << i;
      }
  }
}

/// A law of tissue that grows by the tensor F_g of each particle: that of the elastic part F F_g^-1 of the deformation,
/// per volume before growth.
template <class T>
struct Grown {
  hmps::Matrix<T, 3> growth;
  T mu, kappa;
  [[nodiscard]] hmps::Matrix<T, 3> first_piola_kirchhoff(const hmps::Matrix<T, 3>& F) const {
    const hmps::Matrix<T, 3> back = hmps::inverse(growth), turned = back.transpose(), part = hmps::product(F, back),
                             P = hmps::first_piola_kirchhoff(hmps::NeoHookean<T>{mu, kappa}, part);
    return hmps::product(P, turned) * hmps::determinant(growth);
  }
};

/// A cube of which every particle has grown by `growth`, with the law `Grown` placed as it grows freely.
template <int Means, class B>
struct GrownCube {
  std::vector<hmps::Vector<double, 3>> reference = scenes::box<3>({6, 5, 4}), x = reference, f = reference;
  std::vector<hmps::Matrix<double, 3>> growth;
  B bonds;
  explicit GrownCube(const hmps::Matrix<double, 3>& grown)
      : growth(reference.size(), grown), bonds(hmps::vectors(reference), {.spacing = scenes::Scene<3>{}.spacing}) {
    for (auto& p : x) p = grown * p;
  }
  [[nodiscard]] auto law() const {
    return hmps::elastic([this](const auto& at) {
      auto tensor = at(hmps::matrices(growth));
      using T = std::remove_cvref_t<decltype(tensor(0, 0))>;
      return Grown<T>{tensor, T(5e3), T(1e4)};
    });
  }
  [[nodiscard]] auto ratio() const {
    return [this](const auto& at) { return hmps::determinant(at(hmps::matrices(growth))); };
  }
  /// The largest force density on a particle, in N/m3.
  double largest(const auto&... terms) {
    double most = 0;
    for (const auto& own : force_of<3>(bonds, x, terms...)) most = std::max(most, own.norm());
    return most;
  }
};

template <int Means, class B>
void expect_free_growth() {
  hmps::Matrix<double, 3> growth = 1.05 * hmps::Matrix<double, 3>::Identity();
  growth(0, 1) = 0.02;
  GrownCube<Means, B> cube(growth);
  const double bulk = 2e6, opposed = cube.largest(cube.law(), hmps::mean_dilatation<Means>(bulk));
  ASSERT_GT(cube.largest(hmps::mean_dilatation<Means>(bulk)), 0.5 * opposed) << "without growth there is a force";
  // F, J and the means are rounded a few dozen times, against J - 1 = 0.16 that is resisted without growth.
  const double rounding = 256 * std::numeric_limits<typename B::Scalar>::epsilon() / 0.16 * opposed;
  EXPECT_LE(cube.largest(cube.law(), hmps::mean_dilatation<Means>(bulk, cube.ratio())), rounding);
  std::vector<double> ratios(cube.x.size(), growth.determinant());
  EXPECT_LE(cube.largest(cube.law(), hmps::mean_dilatation<Means>(bulk, hmps::scalars(ratios))), rounding);
  EXPECT_LE(cube.largest(cube.law(), hmps::mean_dilatation<Means>(bulk, growth.determinant())), rounding);
}

// Earlier, the mean of J - 1 resisted growth: the cube stretched by 1.005 instead of 1.05.
TEST(MeanDilatationOfGrowth, LeavesFreeGrowthWithoutStress) {
  expect_free_growth<1, hmps::LatticeBonds<double, 3>>();
  expect_free_growth<2, hmps::BondList<double, 3>>();
  expect_free_growth<1, hmps::LatticeBonds<float, 3>>();
}

// A further uniform strain is resisted with the bulk modulus per grown volume: sigma = K (J / G - 1).
TEST(MeanDilatationOfGrowth, HasItsBulkModulusPerGrownVolume) {
  GrownCube<1, hmps::BondList<double, 3>> cube(1.3 * hmps::Matrix<double, 3>::Identity());
  for (auto& p : cube.x) p *= 1.01;
  auto force = hmps::internal_force(cube.bonds, hmps::mean_dilatation(1e5, cube.ratio()));
  std::vector<hmps::Matrix<double, 3>> stress(cube.x.size());
  force.cauchy_stresses(hmps::vectors(cube.x), hmps::matrices(stress));
  const double expected = 1e5 * (std::pow(1.01, 3) - 1);
  for (const auto& own : stress)
    EXPECT_LE((own - expected * hmps::Matrix<double, 3>::Identity()).norm(), 1e-9 * expected);
}

template <int Means, class B>
void expect_gradient(bool jittered) {
  constexpr int D = B::dimension;
  const auto scene = bent_box<D>(jittered);
  const std::size_t n = scene.x.size();
  const std::vector<double> bulk = Materials(n).d1;
  std::vector<double> growth(n);
  for (std::size_t i = 0; i < n; ++i) growth[i] = 1 + 0.3 * std::sin(static_cast<double>(i));
  const auto bonds = make_bonds<B>(scene);
  const auto term =
      hmps::mean_dilatation<Means>([&](const auto& at) { return at(hmps::scalars(bulk)); }, hmps::scalars(growth));
  const auto f = force_of<D>(bonds, scene.x, term);
  const plain::Body<double, D> body(Expected<D>::convert(scene.reference), 1.75 * scene.spacing);
  auto x = Expected<D>::convert(scene.x);
  std::vector<Eigen::Matrix<double, D, D>> F(n);
  const std::vector<double> scale = scales(body);
  const auto energy = [&] {
    body.deformation_gradient(x, F);
    std::vector<double> theta(n), next(n);
    for (std::size_t i = 0; i < n; ++i) theta[i] = F[i].determinant() - growth[i];
    for (int pass = 0; pass < Means; ++pass, theta = next)
      for (std::size_t i = 0; i < n; ++i) {
        double sum = scale[i] * theta[i];
        body.for_each_bond(i, [&](const auto& bond) { sum += scale[bond.j] * theta[bond.j]; });
        next[i] = scale[i] * sum;
      }
    double H = 0;
    for (std::size_t i = 0; i < n; ++i) H += bulk[i] / 2 * theta[i] * theta[i] / growth[i];
    return H;
  };
  const double H = energy(), own = std::pow(scene.spacing, D);
  const auto force = hmps::internal_force(bonds, term);
  EXPECT_NEAR(force.energy(hmps::vectors(scene.x), own).total(), H * own,
              64 * std::numeric_limits<typename B::Scalar>::epsilon() * H * own);
  expect_minus_gradient<D>(f, x, energy, scene.spacing, Tolerance<typename B::Scalar, D>(scene).elastic);
  hmps::Vector<double, D> sum = hmps::Vector<double, D>::Zero();
  double sizes = 0, torque = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const hmps::Vector<double, D> at = f[i].template cast<double>(), place = x[i];
    sum += at;
    sizes += at.norm();
    torque += place[0] * at[1] - place[1] * at[0];
  }
  const double extent = 20 * scene.spacing, rounding = 64 * std::numeric_limits<typename B::Scalar>::epsilon() * sizes;
  EXPECT_LE(sum.norm(), rounding);
  EXPECT_LE(std::abs(torque), rounding * extent);
}

TEST(MeanDilatationOfGrowth, ForceIsTheGradientOfTheEnergy) {
  expect_gradient<1, hmps::LatticeBonds<float, 3>>(false);
  expect_gradient<1, hmps::BondList<double, 2>>(true);
  expect_gradient<2, hmps::BondList<double, 2>>(true);
}

// A growth of 1 leaves every bit as it is without growth.
TEST(MeanDilatationOfGrowth, OfOneChangesNoBit) {
  const auto scene = bent_box<3>(false);
  const auto bonds = make_bonds<hmps::LatticeBonds<float, 3>>(scene);
  const auto with = force_of<3>(bonds, scene.x, hmps::mean_dilatation(1e5, 1.0)),
             without = force_of<3>(bonds, scene.x, hmps::mean_dilatation(1e5));
  EXPECT_EQ(with, without);
}

TEST(MeanDilatationOfGrowth, NamesTheInvalidGrowth) {
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)hmps::mean_dilatation(1e5, bad), hmps::InputError);
    GrownCube<1, hmps::BondList<double, 3>> cube(hmps::Matrix<double, 3>::Identity());
    std::vector<double> growth(cube.x.size(), 1.0);
    growth[7] = bad;
    EXPECT_THROW(cube.largest(hmps::mean_dilatation(1e5, hmps::scalars(growth))), hmps::InputError);
    growth.resize(9, 1.0);
    EXPECT_THROW(cube.largest(hmps::mean_dilatation(1e5, hmps::scalars(growth))), hmps::InputError);
  }
}

TEST(SplitBulkModulus, NamesTheInvalidArgument) {
  EXPECT_THROW((void)hmps::split_bulk_modulus(0.0, 1.0), hmps::InputError);
  EXPECT_THROW((void)hmps::split_bulk_modulus(1.0, -1.0), hmps::InputError);
  EXPECT_THROW((void)hmps::mean_dilatation(-1.0), hmps::InputError);
  EXPECT_EQ(hmps::split_bulk_modulus(1.0, 1.0).mean, 0);
}

TEST(SplitBulkModulus, RefusesModuliThatWereInterchanged) {
  EXPECT_NO_THROW((void)hmps::split_bulk_modulus(2e6, 15e3));
  EXPECT_THROW((void)hmps::split_bulk_modulus(15e3, 2e6), hmps::InputError);
}

}  // namespace mean_dilatation_test
