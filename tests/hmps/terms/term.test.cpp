// SPDX-License-Identifier: MIT
#include "hmps/terms/term.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/message_of.hpp"
#include "../bonds/bonds_of_a_scene.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/mean_dilatation.hpp"
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
  std::vector<hmps::Matrix<double, 2>> tensors(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int k = 0; k < 4; ++k) tensors[i](k % 2, k / 2) = static_cast<double>(4 * i) + k;
  const hmps::Matrix<hmps::Lanes<K>, 2> none{};
  for (std::size_t b = 0; b < bonds.block_count(); ++b) {
    const hmps::BlockOfParticles<K, 2> at(bonds, b, none, none);
    const auto own = at(hmps::scalars(stiffness)), of_body = at(hmps::scalars(table), hmps::scalars(body));
    const auto place = at(hmps::vectors(points));
    const auto tensor = at(hmps::matrices(tensors));
    for (int l = 0; l < hmps::Lanes<K>::width; ++l) {
      const hmps::Index i = at.particle(l);
      if (i == hmps::Blocks<K, 2>::none) {
        EXPECT_EQ(own.lane[l], own.lane[0]);
        EXPECT_EQ(of_body.lane[l], of_body.lane[0]);
      } else {
        EXPECT_EQ(own.lane[l], static_cast<K>(i + 1));
        EXPECT_EQ(of_body.lane[l], static_cast<K>(10 * (i % 3 + 1)));
        for (int c = 0; c < 2; ++c) EXPECT_EQ(place[c].lane[l], static_cast<K>(points[i][c]));
        for (int k = 0; k < 4; ++k) EXPECT_EQ(tensor(k % 2, k / 2).lane[l], static_cast<K>(tensors[i](k % 2, k / 2)));
        EXPECT_NEAR(at.inverse_shape_trace().lane[l] * bonds.shape_trace(i), K(1),
                    4 * std::numeric_limits<K>::epsilon());
      }
    }
  }
}

TYPED_TEST(Parameters, RejectOtherSizesAndUnknownBodies) {
  using K = TypeParam;
  const auto points = scenes::box<2>({7, 5});
  const hmps::LatticeBonds<K, 2> bonds(hmps::vectors(points), {.spacing = scenes::Scene<2>::spacing});
  const hmps::Matrix<hmps::Lanes<K>, 2> none{};
  const hmps::BlockOfParticles<K, 2> at(bonds, 0, none, none);
  const std::vector<double> few(34), table(2);
  std::vector<int> body(35, 1);
  std::string text = error_of([&] { (void)at(hmps::scalars(few)); });
  EXPECT_TRUE(has(text, "parameters holds 34 particles but 35 are needed")) << text;
  const std::vector<hmps::Vector<double, 2>> directions(34);
  text = error_of([&] { (void)at(hmps::vectors(directions)); });
  EXPECT_TRUE(has(text, "vectors holds 34 particles but 35 are needed")) << text;
  const std::vector<hmps::Matrix<double, 2>> tensors(34);
  text = error_of([&] { (void)at(hmps::matrices(tensors)); });
  EXPECT_TRUE(has(text, "tensors holds 34 particles but 35 are needed")) << text;
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

struct OwnLaw {
  double factor, turning;
  template <class T, int D>
  [[nodiscard]] hmps::Matrix<T, D> second_piola_kirchhoff(const hmps::Matrix<T, D>& C, const T& J) const {
    hmps::Matrix<T, D> S;
    for (int k = 0; k < D * D; ++k) S(k % D, k / D) = T(factor) * (C(k % D, k / D) - T(k % D == k / D ? 1.0 : 0.0));
    S(0, 1) = S(0, 1) + T(turning) * J;
    return S;
  }
};

// Each of these used to give a force that is NaN, that feeds on motion, or that turns the body.
TEST(ParametersOfTerms, AreCheckedWhenTheForceIsMade) {
  std::vector<hmps::Vector<double, 2>> X;
  for (int i = 0; i < 25; ++i) X.emplace_back(i % 5, i / 5);
  const hmps::BondList<double, 2> bonds(hmps::vectors(X), {.spacing = 1});
  std::vector<double> numbers(25, 1e4);
  const auto view = hmps::scalars(std::as_const(numbers));
  const auto law = [&](const auto& at) { return hmps::NeoHookean{at(view), at(view)}; };
  const auto try_all = [&](auto&& expect) {
    expect([&] { (void)hmps::internal_force(bonds, hmps::elastic(law)); }, "modulus of the law");
    expect([&] { (void)hmps::internal_force(bonds, hmps::artificial(view)); }, "artificial");
    expect([&] { (void)hmps::internal_force(bonds, hmps::mean_dilatation(view)); }, "mean_dilatation");
    expect([&] { (void)hmps::internal_force(bonds, hmps::viscous(view, 2e-3)); }, "density");
  };
  try_all([](auto&& make, const char*) { EXPECT_NO_THROW(make()); });
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    numbers[7] = bad;
    try_all([](auto&& make, const char* name) {
      const std::string text = hmps_test::message_of(make);
      EXPECT_NE(text.find(name), std::string::npos) << text;
      EXPECT_NE(text.find("particle 7"), std::string::npos) << text;
    });
  }
  const auto own = [&](double factor, double turning) {
    return hmps_test::message_of([&] { (void)hmps::internal_force(bonds, hmps::elastic(OwnLaw{factor, turning})); });
  };
  EXPECT_EQ(own(1e4, 0), "");
  EXPECT_NE(own(std::numeric_limits<double>::quiet_NaN(), 0).find("not finite"), std::string::npos);
  EXPECT_NE(own(1e4, 100).find("symmetric"), std::string::npos);
}

}  // namespace term_test
