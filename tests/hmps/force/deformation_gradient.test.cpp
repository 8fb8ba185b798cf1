// SPDX-License-Identifier: MIT
#include "hmps/force/deformation_gradient.hpp"

#include <gtest/gtest.h>

#include "../bonds/bonds_of_a_scene.hpp"
#include "../force/equations.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/record.hpp"

namespace deformation_gradient_test {

using namespace equations;
using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;

template <class B>
class DeformationGradient : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::LatticeBonds<double, 2>, hmps::BondList<float, 2>,
                              hmps::BondList<double, 3>>;
TYPED_TEST_SUITE(DeformationGradient, Models);

// Eqs. (9) to (11), by the function alone and by the term in the sweep, which agree to the last bit.
TYPED_TEST(DeformationGradient, IsThatOfThePlainEquation) {
  constexpr int D = TypeParam::dimension;
  using K = typename TypeParam::Scalar;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    if (is_lattice<TypeParam> && scene.jittered) continue;
    const std::size_t n = scene.x.size();
    const auto bonds = make_bonds<TypeParam>(scene);
    std::vector<hmps::Matrix<K, D>> F(n), recorded(n);
    hmps::deformation_gradient(bonds, hmps::vectors(scene.x), hmps::matrices(F));
    Vectors<D> f(n);
    auto force = hmps::internal_force(bonds, hmps::record(hmps::matrices(recorded)));
    force(hmps::vectors(scene.x), hmps::vectors(f));
    EXPECT_EQ(F, recorded);

    const plain::Body<double, D> body(Expected<D>::convert(scene.reference), 1.75 * scene.spacing, scene.bonded);
    std::vector<Eigen::Matrix<double, D, D>> expected(n);
    body.deformation_gradient(Expected<D>::convert(scene.x), expected);
    const Tolerance<K, D> tolerance(scene);
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_LE((F[i].template cast<double>() - expected[i]).norm(), tolerance.gradient) << i;
  }
}

// Eq. (10): no other tensor fits the neighbours better. The gradient of Eq. (9) at F vanishes.
TYPED_TEST(DeformationGradient, MinimisesTheErrorFunctional) {
  constexpr int D = TypeParam::dimension;
  scenes::Scene<D> scene;
  scene.reference = scenes::box<D>(scenes::extent<D>(8, 6, 5));
  scenes::move(scene);
  const auto bonds = make_bonds<TypeParam>(scene);
  std::vector<hmps::Matrix<double, D>> F(scene.x.size());
  hmps::deformation_gradient(bonds, hmps::vectors(scene.x), hmps::matrices(F));
  const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
  for (std::size_t i = 0; i < scene.x.size(); ++i) {
    Eigen::Matrix<double, D, D> slope = Eigen::Matrix<double, D, D>::Zero();
    double scale = 0;
    bonds.for_each_bond(i, [&](std::size_t j, const auto& bond, auto w) {
      const hmps::Vector<double, D> r0 = bond.template cast<double>(), r = scene.x[j] - scene.x[i];
      slope += (F[i] * r0 - r) * r0.transpose() * static_cast<double>(w);
      scale += r0.squaredNorm() * static_cast<double>(w);
    });
    ASSERT_LE(slope.norm(), 4 * tolerance.gradient * scale) << i;
  }
}

TEST(DeformationGradientErrors, NameTheView) {
  const auto points = scenes::box<2>({5, 4});
  const hmps::BondList<double, 2> bonds(hmps::vectors(points), {.spacing = scenes::Scene<2>::spacing});
  std::vector<hmps::Matrix<double, 2>> F(19);
  std::string text = error_of([&] { hmps::deformation_gradient(bonds, hmps::vectors(points), hmps::matrices(F)); });
  EXPECT_TRUE(has(text, "deformation gradients holds 19 particles but 20 are needed")) << text;
  F.resize(20);
  const scenes::Points<2> few(3);
  text = error_of([&] { hmps::deformation_gradient(bonds, hmps::vectors(few), hmps::matrices(F)); });
  EXPECT_TRUE(has(text, "positions holds 3 particles but 20 are needed")) << text;
}

}  // namespace deformation_gradient_test
