// SPDX-License-Identifier: MIT
#include "hmps/terms/artificial.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "../bonds/bonds_of_a_scene.hpp"
#include "../force/equations.hpp"
#include "hmps/force/internal_force.hpp"

namespace artificial_test {

using namespace equations;
using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;

template <class B>
class ArtificialForce : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::LatticeBonds<double, 2>, hmps::BondList<float, 2>,
                              hmps::BondList<double, 3>>;
TYPED_TEST_SUITE(ArtificialForce, Models);

// Eqs. (19) and (20) alone, with one modulus for all particles and one for each.
TYPED_TEST(ArtificialForce, IsThatOfThePlainEquation) {
  constexpr int D = TypeParam::dimension;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    if (is_lattice<TypeParam> && scene.jittered) continue;
    const auto bonds = make_bonds<TypeParam>(scene);
    const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
    Vectors<D> f(scene.x.size());
    for (const bool uniform : {true, false}) {
      const Materials m(scene.x.size(), uniform);
      if (uniform) {
        auto force = hmps::internal_force(bonds, hmps::artificial(m.modulus[0]));
        force(hmps::vectors(scene.x), hmps::vectors(f));
      } else {
        const auto modulus = hmps::scalars(m.modulus);
        auto force = hmps::internal_force(bonds, hmps::artificial([&](const auto& at) { return at(modulus); }));
        force(hmps::vectors(scene.x), hmps::vectors(f));
      }
      const Expected<D> expected(scene, m, 1, 1);
      EXPECT_LE(largest_difference<D>(f, [&](std::size_t i) { return expected.artificial[i]; }), tolerance.artificial);
    }
  }
}

// Eq. (20) in a full cubic lattice: sum |r0|^2 w = lambda n^0 = 10.4472 l0^2.
TEST(Artificial, CoefficientIsTheModulusTimesTheDimensionOverTheTrace) {
  EXPECT_DOUBLE_EQ(hmps::artificial_coefficient(20e3, 3, 1 / 1.5e-5), 20e3 * 3 / 1.5e-5);
  const auto points = scenes::box<3>({3, 3, 3});
  const double l0 = scenes::Scene<3>::spacing;
  const hmps::BondList<double, 3> bonds(hmps::vectors(points), {.spacing = l0});
  EXPECT_NEAR(hmps::artificial_coefficient(1.0, 3, 1 / bonds.shape_trace(13)), 3 / (1.405677 * 7.432146 * l0 * l0),
              1e-6 * 3 / (10 * l0 * l0));
}

TEST(Artificial, RefusesAModulusThatIsNegativeOrNotFinite) {
  EXPECT_NO_THROW((void)hmps::artificial(0.0));
  EXPECT_NO_THROW((void)hmps::artificial(20000));
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const std::string text = error_of([&] { (void)hmps::artificial(bad); });
    EXPECT_TRUE(has(text, "modulus of the artificial force is " + hmps::detail::message(bad) + " Pa")) << text;
  }
}

}  // namespace artificial_test
