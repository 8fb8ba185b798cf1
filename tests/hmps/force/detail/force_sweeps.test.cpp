// SPDX-License-Identifier: MIT
#include "hmps/force/detail/force_sweeps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "../equations.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/viscous.hpp"

namespace force_sweeps_test {

using namespace equations;
using Lattice = hmps::LatticeBonds<double, 3>;
using List = hmps::BondList<float, 3>;

/// t = k w (|r| - |r0|) + s: springs and a cohesion that does not vanish.
struct Springs {
  double stiffness, cohesion;
  template <class T, int D>
  T tension(const hmps::BondState<T, D>& bond) const {
    return stiffness * bond.weight() * bond.elongation() + cohesion * bond.length() / bond.reference_length();
  }
};
static_assert(hmps::PairTerm<Springs, double, 3> && hmps::ForceTerm<Springs, float, 2>);
static_assert(!hmps::CouplingTerm<Springs, double, 3> && !hmps::PairTerm<hmps::Viscous, double, 3>);

template <class B>
class Pairs : public testing::Test {};
using Models = testing::Types<Lattice, List>;
TYPED_TEST_SUITE(Pairs, Models);

scenes::Scene<3> scene_of(const std::string& name) {
  for (auto& scene : scenes::all<3>())
    if (scene.name == name) return scene;
  throw std::runtime_error(name);
}

// f_i = sum_j t_ij r_ij / |r_ij|, bond by bond in double; one end gains the force and moment that the other loses.
TYPED_TEST(Pairs, PullAlongEachBondAndConserveMomentum) {
  using K = typename TypeParam::Scalar;
  const auto scene = scene_of("box with holes");
  const std::size_t n = scene.x.size();
  const auto bonds = make_bonds<TypeParam>(scene);
  const Springs term{3e9, 2e4};
  auto force = hmps::internal_force(bonds, term);
  Vectors<3> f(n), expected(n, Eigen::Vector3d::Zero());
  force(hmps::vectors(scene.x), hmps::vectors(f));
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    bonds.for_each_bond(i, [&](std::size_t j, const auto&, K w) {
      const Eigen::Vector3d r = scene.x[j] - scene.x[i];
      const double r0 = (scene.reference[j] - scene.reference[i]).norm(), length = r.norm();
      const double t = 3e9 * static_cast<double>(w) * (length - r0) + 2e4 * length / r0;
      expected[i] += t * r / length;
    });
    largest = std::max(largest, expected[i].norm());
  }
  // 26 bonds of k w times the rounding of a displacement of up to a few spacings, and of the state in double.
  const double eps = std::numeric_limits<K>::epsilon() * 4 * scene.spacing + 1e-16;
  EXPECT_GT(largest, 1e5);
  EXPECT_LE(largest_difference<3>(f, [&](std::size_t i) { return expected[i]; }), 26 * 3e9 * eps + 1e-6 * 2e4);

  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = sum;
  for (std::size_t i = 0; i < n; ++i) {
    sum += f[i];
    moment += (scene.x[i] - scene.x[0]).cross(f[i]);
  }
  const double rounding = 100 * static_cast<double>(std::numeric_limits<K>::epsilon()) * largest;
  EXPECT_LE(sum.norm(), rounding * std::sqrt(static_cast<double>(n)));
  EXPECT_LE(moment.norm(), 0.1 * rounding * std::sqrt(static_cast<double>(n)));
}

// Two particles at the same place define no direction: they exert no force, and nothing is NaN.
TEST(ForceSweeps, PairsAtOnePlaceDoNotPull) {
  auto reference = scenes::box<3>({3, 3, 3});
  const auto corner = reference[0];
  for (auto& X : reference)
    for (int c = 0; c < 3; ++c) X[c] = std::round((X[c] - corner[c]) / scenes::Scene<3>::spacing) / 1024;  // exact
  const Lattice bonds(hmps::vectors(reference), {.spacing = 1.0 / 1024});
  const Vectors<3> x(reference.size(), Eigen::Vector3d(1, 2, 3));
  Vectors<3> f(reference.size(), Eigen::Vector3d::Ones());
  auto force = hmps::internal_force(bonds, Springs{1e9, 1e3});
  force(hmps::vectors(x), hmps::vectors(f));
  for (const auto& value : f) EXPECT_EQ(value, Eigen::Vector3d::Zero());
}

// d of a bond is the mean of its ends; with the same numbers everywhere it is the force of the one number.
TYPED_TEST(Pairs, DampByViscosityOfEachParticle) {
  using K = typename TypeParam::Scalar;
  const auto scene = scene_of("box with holes");
  const std::size_t n = scene.x.size();
  const auto bonds = make_bonds<TypeParam>(scene);
  std::vector<double> nu(n);
  std::vector<float> rho(n, 1000);
  for (std::size_t i = 0; i < n; ++i) nu[i] = 1e-3 * static_cast<double>(1 + i % 7);
  auto force = hmps::internal_force(
      bonds, hmps::viscous(hmps::scalars(rho), [&](const auto& at) { return 2 * at(hmps::scalars(nu)); }));
  Vectors<3> f(n), expected(n, Eigen::Vector3d::Zero()), uniform(n), same(n);
  force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(f));
  const double factor = 1000 * 2 * 3 / (bonds.standard_lambda() * bonds.standard_density());
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    bonds.for_each_bond(i, [&](std::size_t j, const auto&, K w) {
      expected[i] += factor * static_cast<double>(w) * (nu[i] + nu[j]) * (scene.v[j] - scene.v[i]);
    });
    largest = std::max(largest, expected[i].norm());
  }
  const double rounding = 1000 * static_cast<double>(std::numeric_limits<K>::epsilon()) * largest;
  EXPECT_LE(largest_difference<3>(f, [&](std::size_t i) { return expected[i]; }), rounding);

  nu.assign(n, 1e-3);
  force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(same));
  auto one = hmps::internal_force(bonds, hmps::viscous(1000, 2e-3));
  one(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(uniform));
  EXPECT_LE(largest_difference<3>(same, [&](std::size_t i) { return uniform[i]; }), rounding);
  EXPECT_THROW((void)hmps::internal_force(bonds, hmps::viscous(hmps::scalars(nu).part(0, 3), 1e-3)), hmps::InputError);
}

// A number, a view and a callable with the same values give the same bits.
TEST(ForceSweeps, TakeNumbersViewsAndCallables) {
  const auto scene = scene_of("box with holes");
  const std::size_t n = scene.x.size();
  const auto bonds = make_bonds<Lattice>(scene);
  const std::vector<double> moduli(n, 2e4), halves(n, 1e4);
  const auto of = [&](auto modulus) {
    auto force = hmps::internal_force(bonds, hmps::artificial(modulus));
    Vectors<3> f(n);
    force(hmps::vectors(scene.x), hmps::vectors(f));
    return f;
  };
  const auto number = of(2e4);
  EXPECT_EQ(number, of(hmps::scalars(moduli)));
  EXPECT_EQ(number, of([&](const auto& at) { return 2 * at(hmps::scalars(halves)); }));
  EXPECT_THROW((void)hmps::internal_force(bonds, hmps::artificial(hmps::scalars(moduli).part(0, 3))), hmps::InputError);
}

// `add` adds what the call writes, also to a narrower scalar.
TEST(ForceSweeps, AddToTheForces) {
  const auto scene = scene_of("box with holes");
  const std::size_t n = scene.x.size();
  const auto bonds = make_bonds<Lattice>(scene);
  auto force = hmps::internal_force(bonds, hmps::artificial(2e4));
  Vectors<3> f(n), g(n, Eigen::Vector3d::Constant(5));
  force(hmps::vectors(scene.x), hmps::vectors(f));
  force.add(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(g));
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(g[i], f[i] + Eigen::Vector3d::Constant(5)) << i;
  EXPECT_THROW(force.add(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(g).part(0, 3)),
               hmps::InputError);
}

}  // namespace force_sweeps_test
