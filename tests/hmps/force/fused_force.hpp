// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "equations.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/viscous.hpp"

/// The tests of the three forces together, for both models of bonds and both scalars; one
/// translation unit for each dimension keeps compilation short.
namespace fused_force {

using namespace equations;

template <class B>
class FusedForce : public testing::Test {};
TYPED_TEST_SUITE_P(FusedForce);

// Eqs. (13), (19) and (21) with a different material in every particle, over every kind of body.
TYPED_TEST_P(FusedForce, EqualsTheEquationsEvaluatedOneByOne) {
  constexpr int D = TypeParam::dimension;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    if (is_lattice<TypeParam> && scene.jittered) continue;
    const Materials m(scene.x.size());
    const auto bonds = make_bonds<TypeParam>(scene);
    const auto c1 = hmps::scalars(m.c1), c2 = hmps::scalars(m.c2), d1 = hmps::scalars(m.d1),
               modulus = hmps::scalars(m.modulus);
    auto force = hmps::internal_force(bonds, hmps::elastic([&](const auto& at) {
                                        return hmps::MooneyRivlin{at(c1), at(c2), at(d1)};
                                      }),
                                      hmps::artificial([&](const auto& at) { return at(modulus); }),
                                      hmps::viscous(density, viscosity));
    Vectors<D> f(scene.x.size());
    force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(f));

    const Expected<D> expected(scene, m, bonds.standard_lambda(), bonds.standard_density());
    const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
    const double error = largest_difference<D>(
        f, [&](std::size_t i) { return expected.elastic[i] + expected.artificial[i] + expected.viscous[i]; });
    EXPECT_LE(error, tolerance.elastic + tolerance.artificial + tolerance.viscous);
  }
}

REGISTER_TYPED_TEST_SUITE_P(FusedForce, EqualsTheEquationsEvaluatedOneByOne);

}  // namespace fused_force
