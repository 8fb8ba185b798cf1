// SPDX-License-Identifier: MIT
#include "hmps/bonds/own_bonds.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bonds_of_a_scene.hpp"
#include "hmps/bonds/bond_list.hpp"

namespace own_bonds_test {

using namespace bonds_of_a_scene;
using Pairs = std::vector<std::pair<int, int>>;
using Lists = std::vector<std::vector<std::size_t>>;

static_assert(hmps::BondNeighbours<Pairs> && hmps::BondNeighbours<std::vector<std::array<hmps::Index, 2>>>);
static_assert(hmps::BondNeighbours<Lists> && hmps::BondNeighbours<hmps::NeighbourList>);
static_assert(!hmps::BondNeighbours<hmps::BondSettings> && !hmps::BondNeighbours<std::vector<double>>);

/// Four particles that span space, with all six bonds.
const std::vector<hmps::Vector<double, 3>> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Pairs all{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

template <class N, class W>
std::string refused(const N& neighbours, const W& weights) {
  return error_of([&] { (void)hmps::BondList<float, 3>(hmps::vectors(corners), neighbours, weights); });
}

// The bonds of the search, given as pairs in any order, as lists, and with weights in any form, are the same to the
// bit.
TEST(OwnBonds, AgreeWithTheSearch) {
  const auto scene = scenes::all<2>().front();
  const double reach = 1.75 * scene.spacing;
  const auto x = hmps::vectors(scene.reference);
  const auto same = [](std::size_t, std::size_t) { return true; };
  const hmps::BondList<double, 2> expected(x, {.spacing = scene.spacing}, same);
  const auto lists = hmps::find_neighbours(x, reach * (1 + 1e-12));
  const auto weight = [&](std::size_t i, std::size_t j) {
    const double r = (scene.reference[i] - scene.reference[j]).norm();
    return hmps::PaperWeight{}(std::min(r, reach), reach);
  };
  std::vector<std::array<std::size_t, 2>> pairs;
  std::vector<std::vector<double>> shaped(scene.reference.size());
  for (std::size_t i = 0; i < lists.size(); ++i)
    for (const hmps::Index j : lists[i]) {
      shaped[i].push_back(weight(i, j));
      if (j > i) pairs.push_back({j, i});
    }
  scenes::Random(3).shuffle(pairs);
  std::vector<double> weights;
  for (const auto& [i, j] : pairs) weights.push_back(weight(i, j));
  const auto equal = [&](const hmps::BondList<double, 2>& own) {
    sweep_meets_every_bond_once(own);
    for (std::size_t i = 0; i < own.size(); ++i) {
      std::map<std::size_t, std::pair<hmps::Vector<double, 2>, double>> a, b;
      own.for_each_bond(i, [&](std::size_t j, const auto& r0, double w) { a.emplace(j, std::pair(r0, w)); });
      expected.for_each_bond(i, [&](std::size_t j, const auto& r0, double w) { b.emplace(j, std::pair(r0, w)); });
      ASSERT_EQ(a, b) << i;
      ASSERT_EQ(own.shape_inverse(i), expected.shape_inverse(i)) << i;
    }
    EXPECT_EQ(own.standard_density(), expected.standard_density());
  };
  equal({x, pairs, weights});
  equal({x, pairs, weight});
  equal({x, lists, weight});
  equal({x, lists, shaped});
}

TEST(OwnBonds, MayHaveEqualWeights) {
  const hmps::BondList<float, 3> bonds(hmps::vectors(corners), all, 2);
  int count = 0;
  for (std::size_t i = 0; i < 4; ++i)
    bonds.for_each_bond(i, [&](auto, const auto&, float w) {
      EXPECT_EQ(w, 2.0f);
      ++count;
    });
  EXPECT_EQ(count, 12);
}

TEST(OwnBonds, AreRefusedWithTheNamesOfTheParticles) {
  EXPECT_EQ(refused(all, 1.0), "nothing was thrown");
  const auto with = [](std::pair<int, int> extra) {
    Pairs pairs = all;
    pairs.push_back(extra);
    return pairs;
  };
  EXPECT_TRUE(has(refused(with({1, 4}), 1.0), "bond 6 names particle 4 but there are only 4"));
  EXPECT_TRUE(has(refused(with({-1, 2}), 1.0), "bond 6 names particle -1 but"));
  EXPECT_TRUE(has(refused(with({2, 2}), 1.0), "particle 2 is bonded to itself"));
  EXPECT_TRUE(has(refused(with({1, 3}), 1.0), "the bond of particles 1 and 3 is given twice"));
  EXPECT_TRUE(has(refused(with({3, 1}), 1.0), "the bond of particles 1 and 3 is given twice"));
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           1e-60, 1e60}) {  // the last two in float
    std::vector<double> weights(6, 1.0);
    weights[4] = bad;
    const std::string text = refused(all, weights);
    EXPECT_TRUE(has(text, "the weight of the bond of particles 1 and 3 is " + hmps::detail::message(bad) + "; it must"))
        << text;
  }
  for (const double bad : {1e-35, 1e35}) {  // A and its inverse overflow or vanish
    const std::string text = refused(all, bad);
    EXPECT_TRUE(has(text, hmps::detail::message("is ", bad, "; give weights between 1e-30 and 1e30"))) << text;
  }
  const std::string sides = refused(all, [](std::size_t i, std::size_t j) { return i == 2 && j == 1 ? 2.0 : 1.0; });
  EXPECT_TRUE(has(sides, "particles 1 and 2 has the weight 1 as w(1, 2) and 2 as w(2, 1)")) << sides;
  EXPECT_TRUE(has(refused(all, std::vector<double>(5, 1.0)), "there are 6 bonds but 5 weights"));
  const std::string weak = refused(Pairs{{0, 1}, {1, 2}, {2, 3}}, 1.0);
  EXPECT_TRUE(has(weak, "particle 0 has 1 neighbour that does not span")) << weak;
  auto twice = corners;
  twice[3] = twice[1];
  const std::string text = error_of([&] { (void)hmps::BondList<float, 3>(hmps::vectors(twice), all, 1.0); });
  EXPECT_TRUE(has(text, "particles 1 and 3 lie at the same place")) << text;
  twice[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(
      has(error_of([&] { (void)hmps::BondList<float, 3>(hmps::vectors(twice), all, 1.0); }), "particle 3 is nan"));
}

TEST(OwnBonds, AsListsMustNameEachBondFromBothEnds) {
  const Lists good{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {2, 1, 0}};
  EXPECT_EQ(refused(good, 1.0), "nothing was thrown");
  Lists lists = good;
  lists[2] = {0, 1};
  EXPECT_TRUE(has(refused(lists, 1.0), "particle 3 has the neighbour 2 but not the other way round"));
  lists = good;
  lists[1].push_back(2);
  EXPECT_TRUE(has(refused(lists, 1.0), "the bond of particles 1 and 2 is given twice"));
  lists = good;
  lists[1][0] = 7;
  EXPECT_TRUE(has(refused(lists, 1.0), "particle 1 has the neighbour 7 but there are only 4 particles"));
  lists[1][0] = 1;
  EXPECT_TRUE(has(refused(lists, 1.0), "particle 1 is bonded to itself"));
  lists = good;
  lists.pop_back();
  EXPECT_TRUE(has(refused(lists, 1.0), "there are 3 lists of neighbours but 4 particles"));
  std::vector<std::vector<double>> weights{{1, 1, 1}, {1, 1, 2}, {1, 1, 1}, {1, 1, 1}};
  EXPECT_TRUE(has(refused(good, weights), "the bond of particles 1 and 3 has the weight 2 from one end and 1 from"));
  weights[1].pop_back();
  EXPECT_TRUE(has(refused(good, weights), "particle 1 has 3 neighbours but another number of weights"));
}

TEST(OwnBonds, AreEmptyWithoutParticles) {
  const std::vector<hmps::Vector<double, 3>> none;
  const hmps::BondList<float, 3> bonds(hmps::vectors(none), Pairs{}, 1.0);
  EXPECT_EQ(bonds.size(), 0u);
  const std::vector<hmps::Vector<double, 3>> lonely(2, hmps::Vector<double, 3>::Zero());
  EXPECT_THROW((hmps::BondList<float, 3>(hmps::vectors(lonely), Pairs{}, 1.0)), hmps::InputError);
}

}  // namespace own_bonds_test
