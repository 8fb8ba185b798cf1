// SPDX-License-Identifier: MIT
#include "hmps/bonds/bond_list.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/message_of.hpp"
#include "bonds_of_a_scene.hpp"
#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/bonds.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/terms/term.hpp"

namespace bond_list_test {

using namespace bonds_of_a_scene;

template <class B>
class BondList : public testing::Test {};
using Models = testing::Types<hmps::BondList<float, 2>, hmps::BondList<double, 2>, hmps::BondList<float, 3>,
                              hmps::BondList<double, 3>>;
TYPED_TEST_SUITE(BondList, Models);

TYPED_TEST(BondList, HoldsTheBondsOfEveryKindOfBody) {
  static_assert(hmps::Bonds<TypeParam>);
  for (const auto& scene : scenes::all<TypeParam::dimension>()) {
    SCOPED_TRACE(scene.name);
    const auto bonds = make<TypeParam>(scene);
    equal_the_plain_ones(bonds, scene);
    sweep_meets_every_bond_once(bonds);
    EXPECT_GT(bonds.bytes(), bonds.size());
  }
}

// Both ends of a bond see the same weight and opposite r0, to the bit: one end pulls as much as the other pushes.
TYPED_TEST(BondList, SeesEveryBondAlikeFromBothEnds) {
  using K = typename TypeParam::Scalar;
  constexpr int D = TypeParam::dimension;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    const auto bonds = make<TypeParam>(scene);
    std::map<std::pair<std::size_t, std::size_t>, std::pair<hmps::Vector<K, D>, K>> found;
    for (std::size_t i = 0; i < bonds.size(); ++i)
      bonds.for_each_bond(i, [&](std::size_t j, const hmps::Vector<K, D>& r0, K w) {
        found.emplace(std::pair(i, j), std::pair(r0, w));
      });
    for (const auto& [pair, bond] : found) {
      const auto back = found.find({pair.second, pair.first});
      ASSERT_NE(back, found.end()) << pair.first << ' ' << pair.second;
      EXPECT_EQ(back->second.first, -bond.first);
      EXPECT_EQ(back->second.second, bond.second);
    }
  }
}

// 26 neighbours inside, in any order of the particles and with a jitter of a quarter of a spacing in all: there is
// memory for the weights, 16 or 8 lanes in a row, and little else.
TYPED_TEST(BondList, TakesLittleMemory) {
  constexpr int D = TypeParam::dimension;
  if constexpr (D == 3) {
    auto points = scenes::box<3>({30, 24, 20});
    scenes::Random random(6);
    for (const double jitter : {0.0, 0.12}) {
      random.shuffle(points);
      for (auto& p : points)
        for (int d = 0; d < D; ++d) p[d] += jitter * scenes::Scene<3>::spacing * random(-1, 1);
      const TypeParam bonds(hmps::vectors(points), {.spacing = scenes::Scene<3>::spacing});
      EXPECT_LT(bonds.bytes() / bonds.size(), sizeof(typename TypeParam::Scalar) == 4 ? 250u : 350u) << jitter;
    }
  }
}

TYPED_TEST(BondList, RefusesBadInput) { refuse_bad_input<TypeParam>(); }

// n^0, lambda and the 26 neighbours of a particle inside a cubic lattice (Eq. (21), r_e = 1.75 l0).
TEST(BondList, HasTheStandardValuesOfTheLattice) {
  const auto points = scenes::box<3>({5, 5, 5});
  const double l0 = scenes::Scene<3>::spacing;
  const hmps::BondList<double, 3> bonds(hmps::vectors(points), {.spacing = l0});
  int neighbours = 0;
  bonds.for_each_bond(62, [&](auto, const auto&, double) { ++neighbours; });
  EXPECT_EQ(neighbours, 26);
  EXPECT_NEAR(bonds.standard_density(), 7.432146, 5e-7);
  EXPECT_NEAR(bonds.standard_lambda() / (l0 * l0), 1.405677, 5e-7);
}

// Any weight and radius: here one that does not vanish at the radius, which is the distance of
// neighbours along the axes, in single precision.
TEST(BondList, TakesAnotherWeightAndRadius) {
  std::vector<hmps::Vector<float, 3>> points;
  for (const auto& p : scenes::box<3>({6, 6, 6})) points.push_back(p.cast<float>());
  const hmps::BondSettings settings{.spacing = scenes::Scene<3>::spacing, .radius_ratio = 1.0};
  const hmps::BondList<float, 3> bonds(hmps::vectors(points), settings, hmps::EveryBond{},
                                       [](double distance, double radius) {
                                         EXPECT_LE(distance, radius);
                                         return 2.0;
                                       });
  int neighbours = 0;
  bonds.for_each_bond(43 + 36, [&](auto, const auto&, float w) {
    ++neighbours;
    EXPECT_EQ(w, 2.0f);
  });
  EXPECT_EQ(neighbours, 6);
}

// Neighbours at exactly the radius: rounding of positions far from the origin must not decide.
template <class S>
void expect_bonds_of_the_lattice(double shift) {
  std::vector<hmps::Vector<S, 3>> points;
  for (const auto& p : scenes::box<3>({6, 6, 6}))
    points.push_back((p + hmps::Vector<double, 3>(shift, -shift, shift)).cast<S>());
  const hmps::BondSettings settings{.spacing = scenes::Scene<3>::spacing, .radius_ratio = 2.0};
  const auto even = [](double, double) { return 1.0; };
  const hmps::BondList<S, 3> list(hmps::vectors(points), settings, hmps::EveryBond{}, even);
  const hmps::LatticeBonds<S, 3> lattice(hmps::vectors(points), settings, hmps::EveryBond{}, even);
  std::size_t of_list = 0, of_lattice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    list.for_each_bond(i, [&](auto, const auto&, S) { ++of_list; });
    lattice.for_each_bond(i, [&](auto, const auto&, S) { ++of_lattice; });
  }
  EXPECT_EQ(of_list, of_lattice) << shift;
}
TEST(BondList, HasTheBondsAtItsRadiusWhereverTheBodyIs) {
  for (const double shift : {0.0, 0.1, 0.3, 1.0, 3.0}) expect_bonds_of_the_lattice<double>(shift);
  for (const double shift : {0.0, 0.05, 0.1}) expect_bonds_of_the_lattice<float>(shift);
}

TEST(BondList, CarriesTheVolumesOfItsParticles) {
  using Bonds = hmps::BondList<double, 3>;
  using hmps_test::message_of;
  const auto places = scenes::box<3>(scenes::extent<3>(5, 4, 3));
  const auto X = hmps::vectors(places);
  const double l0 = scenes::Scene<3>::spacing;
  std::vector<double> volumes(places.size(), l0 * l0 * l0);
  const Bonds plain(X, {.spacing = l0}), like(X, {.spacing = l0}, hmps::scalars(volumes));
  EXPECT_EQ(plain.volume_share(7), 1);
  EXPECT_NEAR(like.volume_share(7), 1, 1e-14);
  volumes[7] *= 3;
  const Bonds unlike(X, {.spacing = l0}, hmps::scalars(volumes));
  EXPECT_NEAR(unlike.volume_share(7), 3, 1e-14);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    std::map<std::size_t, double> weights;
    plain.for_each_bond(i, [&](std::size_t j, const auto&, double w) { weights[j] = w; });
    unlike.for_each_bond(i, [&](std::size_t j, const auto&, double w) {
      EXPECT_NEAR(w, (j == 7 ? 3 : 1) * weights[j], 1e-14) << i << ' ' << j;
    });
  }
  const auto refused = [&](const std::string& text) {
    EXPECT_NE(message_of([&] { Bonds(X, {.spacing = l0}, hmps::scalars(volumes)); }).find(text), std::string::npos);
  };
  volumes[7] = std::numeric_limits<double>::quiet_NaN();
  refused("the volume of particle 7 is");
  for (double& own : volumes) own = 1e9 * l0 * l0 * l0;
  refused("the cube of the spacing");
  volumes.pop_back();
  refused("volumes");
}

// Half a kilometre from the origin a float moves by 3e-5 m or not at all.
TEST(BondList, RefusesPositionsThatTheirScalarDoesNotResolve) {
  const auto made = [](float origin) {
    scenes::Points<3> near = scenes::box<3>({4, 4, 4});
    std::vector<hmps::Vector<float, 3>> X;
    for (const auto& x : near) X.push_back(x.cast<float>() + hmps::Vector<float, 3>::Constant(origin));
    return hmps::BondList<float, 3>(hmps::vectors(X), {.spacing = scenes::Scene<3>::spacing}).size();
  };
  EXPECT_EQ(made(1), 64U);
  EXPECT_NE(hmps_test::message_of([&] { (void)made(500); }).find("take positions in double"), std::string::npos);
}

TEST(BondList, OfNoParticlesIsEmpty) {
  const scenes::Points<2> none;
  const hmps::BondList<double, 2> bonds(hmps::vectors(none), {.spacing = 1});
  EXPECT_EQ(bonds.size(), 0u);
  EXPECT_EQ(bonds.block_count(), 0u);
}

TEST(BondList, RefusesARadiusInPerCent) {
  const auto X = scenes::Scene<3>::spacing;
  std::vector<hmps::Vector<double, 3>> points;
  for (int i = 0; i < 64; ++i) points.emplace_back(X * hmps::Vector<double, 3>(i % 4, i / 4 % 4, i / 16));
  EXPECT_THROW((hmps::BondList<double, 3>(hmps::vectors(points), {.spacing = X, .radius_ratio = 175})),
               hmps::InputError);
}

// Two fills of one body, one of which was moved there and back: earlier, their step was 1e-11 s, without an error.
TEST(BondList, RejectsDuplicatesThatDifferByRounding) {
  constexpr double l0 = scenes::Scene<3>::spacing;
  auto points = scenes::box<3>({5, 4, 4});
  const std::size_t n = points.size();
  points.push_back(points[7] + hmps::Vector<double, 3>(1e-15 * l0, 0, 0));
  if (points.back() == points[7]) points.back()[0] = std::nextafter(points[7][0], 1.0);
  for (const double away : {0.0, 1e-9, 0.9e-3}) {
    points.back()[0] += away * l0;
    const std::string text = error_of([&] { (void)hmps::BondList<double, 3>(hmps::vectors(points), {.spacing = l0}); });
    EXPECT_TRUE(has(text, "particles 7 and " + std::to_string(n) + " are only ")) << text;
  }
  points.back()[0] = points[7][0] + 0.2 * l0;
  const hmps::BondList<double, 3> bonds(hmps::vectors(points), {.spacing = l0});
  EXPECT_EQ(bonds.size(), n + 1);
}

}  // namespace bond_list_test
