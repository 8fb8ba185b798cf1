// SPDX-License-Identifier: MIT
#include "hmps/terms/term.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "../bonds/bonds_of_a_scene.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/viscous.hpp"

namespace term_test {

using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;

struct DampsByBonds {
  double damping(const hmps::Blocks<float, 3>&) const { return 1; }
};
struct DampsInWords {
  std::string damping(const hmps::Blocks<float, 3>&) const { return "much"; }
};
struct CouplesByValue {
  void couple(const hmps::BlockOfParticles<float, 3>&, hmps::Coupling<float, 3>) const {}
};
struct ChangesItself {
  void couple(const hmps::BlockOfParticles<float, 3>&, hmps::Coupling<float, 3>&) {}
};

using Law = hmps::Elastic<hmps::MooneyRivlin<double>>;
static_assert(hmps::CouplingTerm<Law, float, 3> && !hmps::DampingTerm<Law, float, 3>);
static_assert(hmps::CouplingTerm<hmps::Artificial<double>, double, 2>);
static_assert(hmps::CouplingTerm<hmps::Record<float, 3>, double, 3>);
static_assert(!hmps::CouplingTerm<hmps::Record<float, 2>, double, 3>);
static_assert(hmps::DampingTerm<hmps::Viscous, float, 2> && !hmps::CouplingTerm<hmps::Viscous, float, 2>);
static_assert(hmps::ForceTerm<DampsByBonds, float, 3>);
static_assert(!hmps::ForceTerm<DampsByBonds, double, 3> && !hmps::ForceTerm<DampsByBonds, float, 2>);
static_assert(!hmps::ForceTerm<DampsInWords, float, 3>);
static_assert(!hmps::ForceTerm<ChangesItself, float, 3>);
static_assert(!hmps::ForceTerm<double, float, 3>);
static_assert(hmps::ForceTerm<CouplesByValue, float, 3>);

struct BlocksOnly : hmps::Blocks<float, 3> {};
static_assert(hmps::Bonds<hmps::BondList<float, 3>> && hmps::Bonds<hmps::LatticeBonds<double, 2>>);
static_assert(!hmps::Bonds<BlocksOnly> && !hmps::Bonds<hmps::NeighbourList>);

template <class K>
class Parameters : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Parameters, Scalars);

// Every lane reads its own particle, whatever the order of the blocks; empty lanes read one that exists.
TYPED_TEST(Parameters, ArePerParticleAndPerBody) {
  using K = TypeParam;
  auto points = scenes::box<2>({7, 5});
  scenes::Random(4).shuffle(points);
  const hmps::LatticeBonds<K, 2> bonds(hmps::vectors(points), {.spacing = scenes::Scene<2>::spacing});
  std::vector<float> stiffness(points.size());
  std::vector<std::uint8_t> body(points.size());
  const std::vector<double> table = {10, 20, 30};
  for (std::size_t i = 0; i < points.size(); ++i) {
    stiffness[i] = static_cast<float>(i + 1);
    body[i] = static_cast<std::uint8_t>(i % 3);
  }
  const hmps::Matrix<hmps::Lanes<K>, 2> none{};
  for (std::size_t b = 0; b < bonds.block_count(); ++b) {
    const hmps::BlockOfParticles<K, 2> at(bonds, b, none, none);
    const auto own = at(hmps::scalars(stiffness)), of_body = at(hmps::scalars(table), hmps::scalars(body));
    for (int l = 0; l < hmps::Lanes<K>::width; ++l) {
      const hmps::Index i = at.particle(l);
      if (i == hmps::Blocks<K, 2>::none) {
        EXPECT_EQ(own.lane[l], own.lane[0]);
        EXPECT_EQ(of_body.lane[l], of_body.lane[0]);
      } else {
        EXPECT_EQ(own.lane[l], static_cast<K>(i + 1));
        EXPECT_EQ(of_body.lane[l], static_cast<K>(10 * (i % 3 + 1)));
        EXPECT_NEAR(at.inverse_shape_trace().lane[l] * bonds.shape_trace(i), K(1),
                    4 * std::numeric_limits<K>::epsilon());
      }
    }
  }
}

TYPED_TEST(Parameters, OfAnotherSizeOrOfAnUnknownBodyAreRefused) {
  using K = TypeParam;
  const auto points = scenes::box<2>({7, 5});
  const hmps::LatticeBonds<K, 2> bonds(hmps::vectors(points), {.spacing = scenes::Scene<2>::spacing});
  const hmps::Matrix<hmps::Lanes<K>, 2> none{};
  const hmps::BlockOfParticles<K, 2> at(bonds, 0, none, none);
  const std::vector<double> few(34), table(2);
  std::vector<int> body(35, 1);
  std::string text = error_of([&] { (void)at(hmps::scalars(few)); });
  EXPECT_TRUE(has(text, "parameters holds 34 particles but 35 are needed")) << text;
  text = error_of([&] { (void)at(hmps::scalars(table), hmps::scalars(few)); });
  EXPECT_TRUE(has(text, "bodies holds 34 particles but 35 are needed")) << text;
  const hmps::Index i = at.particle(3);
  for (const int bad : {2, -1}) {
    body[i] = bad;
    text = error_of([&] { (void)at(hmps::scalars(table), hmps::scalars(body)); });
    EXPECT_TRUE(has(text, "particle " + std::to_string(i) + " belongs to body " + std::to_string(bad) +
                              " but the table of parameters has 2"))
        << text;
  }
}

}  // namespace term_test
