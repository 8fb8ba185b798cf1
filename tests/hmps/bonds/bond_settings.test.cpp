// SPDX-License-Identifier: MIT
#include "hmps/bonds/bond_settings.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/view.hpp"

namespace bond_settings_test {

using V = hmps::Vector<double, 2>;
using hmps::EveryBond;
using hmps::InputError;

std::vector<V> square() {
  std::vector<V> points;
  for (int i = 0; i < 25; ++i) points.emplace_back(i % 5, i / 5);
  return points;
}

template <class B>
class BondsOfAnyKind : public testing::Test {};
using Models = testing::Types<hmps::BondList<double, 2>, hmps::LatticeBonds<double, 2>>;
TYPED_TEST_SUITE(BondsOfAnyKind, Models);

// Bonds from one end only would push one particle and not the other.
TYPED_TEST(BondsOfAnyKind, RefuseAPredicateThatIsNotSymmetric) {
  const std::vector<V> points = square();
  const auto one_sided = [](std::size_t i, std::size_t j) { return i < 13 || j > 10; };
  EXPECT_THROW(TypeParam(hmps::vectors(points), {.spacing = 1}, one_sided), InputError);
  EXPECT_NO_THROW(TypeParam(hmps::vectors(points), {.spacing = 1, .unbonded = true}, [](std::size_t i, std::size_t) {
    return i < 12;  // borrows the others
  }));
}

// Earlier, a weight that was negative or NaN at some distance cut the bonds of that length.
TYPED_TEST(BondsOfAnyKind, RejectInvalidWeights) {
  const std::vector<V> points = square();
  const auto with = [&](double far_weight) {
    return TypeParam(hmps::vectors(points), {.spacing = 1}, EveryBond{},
                     [far_weight](double distance, double) { return distance < 1.2 ? 1.0 : far_weight; });
  };
  EXPECT_NO_THROW(with(0));
  for (const double bad : {-0.1, std::numeric_limits<double>::quiet_NaN(), 1e300})
    EXPECT_THROW(with(bad), InputError) << bad;
  const auto tiny = [](double, double) { return 1e-60; };
  EXPECT_THROW(TypeParam(hmps::vectors(points), {.spacing = 1}, EveryBond{}, tiny), InputError);
}

// Earlier, the scale was 0 / 0 if no particle had a bond, and the viscous force NaN.
TYPED_TEST(BondsOfAnyKind, HaveAFiniteScaleWhereNoParticleIsBonded) {
  const std::vector<V> one{V::Zero()};
  const TypeParam bonds(hmps::vectors(one), {.spacing = 1, .unbonded = true});
  EXPECT_GT(bonds.standard_density(), 0);
  EXPECT_GT(bonds.standard_lambda(), 0);
}

}  // namespace bond_settings_test
