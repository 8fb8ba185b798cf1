// SPDX-License-Identifier: MIT
#include "hmps/bonds/lattice_bonds.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "bonds_of_a_scene.hpp"
#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/bonds.hpp"
#include "hmps/terms/term.hpp"

namespace lattice_bonds_test {

using namespace bonds_of_a_scene;

template <class B>
class LatticeBonds : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<float, 2>, hmps::LatticeBonds<double, 2>, hmps::LatticeBonds<float, 3>,
                              hmps::LatticeBonds<double, 3>>;
TYPED_TEST_SUITE(LatticeBonds, Models);

TYPED_TEST(LatticeBonds, HoldsTheBondsOfEveryKindOfBody) {
  static_assert(hmps::Bonds<TypeParam>);
  for (const auto& scene : scenes::all<TypeParam::dimension>()) {
    SCOPED_TRACE(scene.name);
    if (scene.jittered) continue;
    const auto bonds = make<TypeParam>(scene);
    equal_the_plain_ones(bonds, scene);
    sweep_meets_every_bond_once(bonds);
    EXPECT_GT(bonds.bytes(), bonds.size());
  }
}

TYPED_TEST(LatticeBonds, RefusesBadInput) { refuse_bad_input<TypeParam>(); }

// n^0, lambda and the 26 neighbours of a particle inside a cubic lattice (Eq. (21), r_e = 1.75 l0),
// also where the body itself is too thin to have one.
TEST(LatticeBonds, HaveTheStandardValues) {
  const double l0 = scenes::Scene<3>::spacing;
  for (const auto& points : {scenes::box<3>({5, 5, 5}), scenes::box<3>({5, 5, 2})}) {
    const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(points), {.spacing = l0});
    EXPECT_NEAR(bonds.standard_density(), 7.432146, 5e-7);
    EXPECT_NEAR(bonds.standard_lambda() / (l0 * l0), 1.405677, 5e-7);
  }
}

TEST(LatticeBonds, TakeAnotherWeightAndRadius) {
  const auto points = scenes::box<3>({9, 9, 9});
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(points),
                                            {.spacing = scenes::Scene<3>::spacing, .radius_ratio = 3.0},
                                            hmps::EveryBond{}, [](double, double) { return 0.5; });
  int neighbours = 0;
  bonds.for_each_bond(4 * 81 + 4 * 9 + 4, [&](auto, const auto&, double w) {
    ++neighbours;
    EXPECT_EQ(w, 0.5);
  });
  EXPECT_EQ(neighbours, 122) << "cells with 0 < a^2 + b^2 + c^2 <= 9";
}

// Positions in single precision lie off the lattice by their rounding, far from the origin too.
TEST(LatticeBonds, TolerateRoundingOfPositions) {
  std::vector<std::array<float, 2>> points;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 3; ++j)
      points.push_back({3.0f + 1e-2f * static_cast<float>(i), -1.0f + 1e-2f * static_cast<float>(j)});
  const hmps::LatticeBonds<float, 2> bonds(hmps::vectors(points), {.spacing = 1e-2});
  EXPECT_EQ(bonds.size(), points.size());
}

TEST(LatticeBonds, TakeAnEighthOfTheMemoryOfAList) {
  const auto points = scenes::box<3>({20, 20, 20});
  const hmps::BondSettings settings{.spacing = scenes::Scene<3>::spacing};
  const hmps::LatticeBonds<float, 3> lattice(hmps::vectors(points), settings);
  const hmps::BondList<float, 3> list(hmps::vectors(points), settings);
  const auto own = [](const auto& bonds) {
    return bonds.bytes() - static_cast<const hmps::Blocks<float, 3>&>(bonds).bytes();
  };
  EXPECT_LT(8 * own(lattice), own(list));
}

// 6 neighbours of a particle lie along one axis, 12 along two, 8 along three.
TEST(LatticeBonds, SkipComponentsThatAreZero) {
  const auto points = scenes::box<3>({5, 5, 40});
  const hmps::LatticeBonds<float, 3> bonds(hmps::vectors(points), {.spacing = scenes::Scene<3>::spacing});
  const std::size_t middle = bonds.slot(2 * 200 + 2 * 40 + 20) / bonds.width;
  int rows = 0, along = 0;
  bonds.for_each_row(middle, [&](const auto& row) {
    ++rows;
    for (int c = 0; c < 3; ++c) along += row.along(c) ? 1 : 0;
  });
  EXPECT_EQ(rows, 26);
  EXPECT_EQ(along, 54);
}

TEST(LatticeBonds, KeepTheShapesOfLikeBlocksOnce) {
  const double l0 = scenes::Scene<3>::spacing;
  // Bodies with rows of different lengths differ only in the number of blocks inside.
  const auto bytes = [&](int length) {
    const auto points = scenes::box<3>({3, 3, length});
    const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(points), {.spacing = l0});
    return static_cast<double>(static_cast<const hmps::Blocks<double, 3>&>(bonds).bytes());
  };
  // Position (three doubles), place and slot of a particle (four bytes each), and a byte and an index per block.
  EXPECT_NEAR((bytes(320) - bytes(160)) / (9 * 160), 24 + 8 + 5. / 8, 0.5);
}

TEST(LatticeBonds, RejectParticlesOffTheLattice) {
  auto points = scenes::box<2>({8, 4});
  const double l0 = scenes::Scene<2>::spacing;
  points[13][1] += 0.25 * l0;
  const auto text = [&](hmps::BondSettings settings) {
    return error_of([&] { (void)hmps::LatticeBonds<double, 2>(hmps::vectors(points), settings); });
  };
  std::string error = text({.spacing = l0});
  EXPECT_TRUE(has(error, "component 1 of particle 13 lies 1.25 spacings from particle 0")) << error;
  EXPECT_TRUE(has(error, "use BondList")) << error;
  error = text({.spacing = 1.1 * l0});
  EXPECT_TRUE(has(error, "not on the cubic lattice")) << error;
  points = scenes::box<2>({8, 4});
  error = text({.spacing = l0, .radius_ratio = 0.9});
  EXPECT_TRUE(has(error, "the effective radius is 0.9 spacings")) << error;
  error = text({.spacing = l0, .radius_ratio = 20});
  EXPECT_TRUE(has(error, "the effective radius is 20 spacings")) << error;
  points[5][0] += 3e6 * l0;
  error = text({.spacing = l0});
  EXPECT_TRUE(has(error, "particle 5") && has(error, "may span 1e6")) << error;
}

// Rounding is not a reason to leave the lattice either.
TEST(LatticeBonds, RefusePositionsThatTheirScalarDoesNotResolve) {
  const double l0 = scenes::Scene<3>::spacing;
  const auto made = [&](float origin, double spacing) {
    std::vector<hmps::Vector<float, 3>> X;
    for (const auto& x : scenes::box<3>({4, 4, 4}))
      X.push_back(x.cast<float>() + hmps::Vector<float, 3>::Constant(origin));
    return error_of([&] { (void)hmps::LatticeBonds<float, 3>(hmps::vectors(X), {.spacing = spacing}); });
  };
  EXPECT_EQ(made(1, l0), "nothing was thrown");
  for (const float origin : {30.F, 500.F}) {
    const std::string error = made(origin, l0);
    EXPECT_TRUE(has(error, "take positions in double, or an origin near the body")) << origin << ": " << error;
  }
  const std::string error = made(1, 1e-3 * l0);
  EXPECT_TRUE(has(error, "is the spacing")) << error;
}

// A wrong spacing is not a reason to leave the lattice: the right one is named.
TEST(LatticeBonds, NameTheSpacingOfTheParticles) {
  const auto points = scenes::box<3>({6, 5, 4});
  const double l0 = scenes::Scene<3>::spacing;
  const std::string right = hmps::detail::message("is the spacing ", l0, " m?");
  for (const double factor : {1.1, 0.6, 0.5, 2.0, 1e3, 1e-3, 1e-7, 1.005, 0.999}) {
    const std::string error =
        error_of([&] { (void)hmps::LatticeBonds<double, 3>(hmps::vectors(points), {.spacing = factor * l0}); });
    EXPECT_TRUE(has(error, right)) << factor << ": " << error;
  }
}

// In a long body a spacing that is off by less matters. Rounding changes the distances of neighbours by more than that.
TEST(LatticeBonds, NameTheSpacingOfARowInFloat) {
  std::vector<hmps::Vector<float, 2>> points;
  for (int i = 0; i < 2000; ++i)
    for (int k = 0; k < 2; ++k)
      points.push_back(1e-3F * hmps::Vector<float, 2>(static_cast<float>(i), static_cast<float>(k)));
  const auto error_with = [&](double spacing) {
    return error_of([&] { (void)hmps::LatticeBonds<float, 2>(hmps::vectors(points), {.spacing = spacing}); });
  };
  EXPECT_EQ(error_with(1e-3), "nothing was thrown");
  const std::string error = error_with(1.00001e-3);
  EXPECT_TRUE(has(error, "is the spacing 0.001") && !has(error, "BondList")) << error;
  for (auto& x : points) x[1] *= 1.01F;  // no cubic lattice any more
  EXPECT_TRUE(has(error_with(1e-3), "use BondList for a cloud that is no lattice")) << error_with(1e-3);
}

TEST(LatticeBonds, OfNoParticlesAreRefused) {
  const scenes::Points<3> none;
  const std::string error = error_of([&] { (void)hmps::LatticeBonds<float, 3>(hmps::vectors(none), {.spacing = 1}); });
  EXPECT_TRUE(has(error, "no particles to bond")) << error;
}

}  // namespace lattice_bonds_test
