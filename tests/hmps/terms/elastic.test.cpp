// SPDX-License-Identifier: MIT
#include "hmps/terms/elastic.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "../bonds/bonds_of_a_scene.hpp"
#include "../force/equations.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/linear_elastic.hpp"

namespace elastic_test {

using namespace equations;
using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;

template <class B>
class ElasticForce : public testing::Test {
 protected:
  /// The force of the term alone.
  template <class Term>
  static Vectors<B::dimension> evaluate(const B& bonds, const scenes::Scene<B::dimension>& scene, const Term& term) {
    Vectors<B::dimension> f(scene.x.size());
    auto force = hmps::internal_force(bonds, term);
    force(hmps::vectors(scene.x), hmps::vectors(f));
    return f;
  }
};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::LatticeBonds<double, 2>, hmps::BondList<float, 2>,
                              hmps::BondList<double, 3>>;
TYPED_TEST_SUITE(ElasticForce, Models);

// Eq. (13) alone, with one law for all particles, one for each, and one for each body.
TYPED_TEST(ElasticForce, IsThatOfThePlainEquation) {
  constexpr int D = TypeParam::dimension;
  using L = hmps::Lanes<typename TypeParam::Scalar>;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    if (is_lattice<TypeParam> && scene.jittered) continue;
    const std::size_t n = scene.x.size();
    const auto bonds = make_bonds<TypeParam>(scene);
    const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
    const auto error = [&](const Vectors<D>& f, const Materials& m) {
      const Expected<D> expected(scene, m, 1, 1);
      return largest_difference<D>(f, [&](std::size_t i) { return expected.elastic[i]; });
    };
    Materials m(n, true);
    EXPECT_LE(
        error(this->evaluate(bonds, scene, hmps::elastic(hmps::MooneyRivlin<double>{m.c1[0], m.c2[0], m.d1[0]})), m),
        tolerance.elastic);
    m = Materials(n);
    const auto c1 = hmps::scalars(m.c1), c2 = hmps::scalars(m.c2), d1 = hmps::scalars(m.d1);
    EXPECT_LE(error(this->evaluate(bonds, scene, hmps::elastic([&](const auto& at) {
                                     return hmps::MooneyRivlin<L>{at(c1), at(c2), at(d1)};
                                   })),
                    m),
              tolerance.elastic);
    const std::vector<float> table = {1000, 2000, 3000};
    std::vector<std::uint8_t> body(n);
    for (std::size_t i = 0; i < n; ++i) {
      body[i] = static_cast<std::uint8_t>((i / 7) % 3);
      m.c1[i] = m.c2[i] = static_cast<double>(table[body[i]]);
      m.d1[i] = 1e4;
    }
    const auto c = hmps::scalars(table);
    const auto b = hmps::scalars(body);
    EXPECT_LE(error(this->evaluate(bonds, scene, hmps::elastic([&](const auto& at) {
                                     return hmps::MooneyRivlin<L>{at(c, b), at(c, b), L(1e4)};
                                   })),
                    m),
              tolerance.elastic);
  }
}

// A law of F itself goes the same way: in linear elasticity Eq. (13) with F S = lambda tr(e) + 2 mu e.
TYPED_TEST(ElasticForce, TakesLawsOfTheDeformationGradient) {
  constexpr int D = TypeParam::dimension;
  using Mat = Eigen::Matrix<double, D, D>;
  scenes::Scene<D> scene;
  scene.reference = scenes::box<D>(scenes::extent<D>(8, 6, 5));
  scenes::move(scene);
  const auto f = this->evaluate(make_bonds<TypeParam>(scene), scene,
                                hmps::elastic(hmps::LinearElastic<double>{.lambda = 9000, .mu = 6000}));
  const Expected<D> plain(scene, Materials(scene.x.size()), 1, 1);
  std::vector<Eigen::Matrix<double, D, 1>> expected(f.size(), Eigen::Matrix<double, D, 1>::Zero());
  plain.body.elastic(
      plain.F,
      [](std::size_t, const Mat& F) -> Mat {
        const Mat e = (F + F.transpose()) / 2 - Mat::Identity();
        return F.inverse() * (9000 * e.trace() * Mat::Identity() + 12000 * e);
      },
      expected);
  const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
  EXPECT_LE(largest_difference<D>(f, [&](std::size_t i) { return expected[i]; }), tolerance.elastic);
}

TEST(ElasticErrors, NameTheModulus) {
  std::string text = error_of([] { (void)hmps::elastic(hmps::MooneyRivlin<double>{-2, 1, 1e6}); });
  EXPECT_TRUE(has(text, "shear modulus") && has(text, "-2 Pa")) << text;
  text = error_of([] { (void)hmps::elastic(hmps::MooneyRivlin<double>{1, 1, 0}); });
  EXPECT_TRUE(has(text, "D1") && has(text, "0 Pa")) << text;
}

}  // namespace elastic_test
