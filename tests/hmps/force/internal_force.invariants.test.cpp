// SPDX-License-Identifier: MIT
// Properties of the elastic and artificial forces in every state: they derive from an energy that rigid motion does not
// change.
#include <gtest/gtest.h>

#include <cmath>

#include "equations.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/record.hpp"

namespace internal_force_invariants_test {

using namespace equations;

template <class B>
class Invariants : public testing::Test {
 protected:
  static constexpr int dimension = B::dimension;
  /// Force and deformation gradients of `scene` with the materials `m`.
  struct Answer {
    Vectors<dimension> force;
    std::vector<hmps::Matrix<double, dimension>> F;
  };
  static Answer evaluate(const B& bonds, const scenes::Points<dimension>& x, const Materials& m) {
    Answer answer{Vectors<dimension>(x.size()), std::vector<hmps::Matrix<double, dimension>>(x.size())};
    auto force = hmps::internal_force(
        bonds, hmps::elastic([&](const auto& at) {
          using T = hmps::Lanes<typename B::Scalar>;
          return hmps::MooneyRivlin<T>{at(hmps::scalars(m.c1)), at(hmps::scalars(m.c2)), at(hmps::scalars(m.d1))};
        }),
        hmps::artificial([&](const auto& at) { return at(hmps::scalars(m.modulus)); }),
        hmps::record(hmps::matrices(answer.F)));
    force(hmps::vectors(x), hmps::vectors(answer.force));
    return answer;
  }
  static Eigen::Matrix<double, dimension, dimension> rotation(double degrees) {
    const double angle = degrees * std::acos(-1.0) / 180;
    Eigen::Matrix<double, dimension, dimension> R = Eigen::Matrix<double, dimension, dimension>::Identity();
    R(0, 0) = R(1, 1) = std::cos(angle);
    R(0, 1) = -std::sin(angle);
    R(1, 0) = std::sin(angle);
    if constexpr (dimension == 3) {
      // About an axis that is not one of the lattice.
      Eigen::Matrix3d tilt = Eigen::Matrix3d::Identity();
      tilt(1, 1) = tilt(2, 2) = 0.6;
      tilt(1, 2) = -0.8;
      tilt(2, 1) = 0.8;
      R = tilt * R * tilt.transpose();
    }
    return R;
  }
};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::LatticeBonds<double, 2>, hmps::BondList<float, 2>,
                              hmps::BondList<float, 3>, hmps::BondList<double, 3>>;
TYPED_TEST_SUITE(Invariants, Models);

// f_i = -(1 / V) dH/dx_i with H = sum V [W(F_i) + C_i / 2 sum |r - F_i r0|^2 w], by central differences
// of the plain energy.
TYPED_TEST(Invariants, ForceIsTheGradientOfTheEnergy) {
  constexpr int D = TypeParam::dimension;
  using K = typename TypeParam::Scalar;
  using Mat = Eigen::Matrix<double, D, D>;
  for (const bool jittered : {false, true}) {
    if (jittered && is_lattice<TypeParam>) continue;
    const auto scene = bent_box<D>(jittered);
    const Materials m(scene.x.size());
    const auto bonds = make_bonds<TypeParam>(scene);
    const auto answer = this->evaluate(bonds, scene.x, m);

    const plain::Body<double, D> body(Expected<D>::convert(scene.reference), 1.75 * scene.spacing);
    std::vector<Eigen::Matrix<double, D, 1>> x = Expected<D>::convert(scene.x);
    std::vector<Mat> F(x.size());
    const auto energy = [&] {
      body.deformation_gradient(x, F);
      double H = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        H += plain::MooneyRivlin<double>{m.c1[i], m.c2[i], m.d1[i]}.template energy<D>(F[i]) +
             body.artificial_energy(i, x, F[i], [&](std::size_t k) { return m.modulus[k]; });
      return H;
    };
    expect_minus_gradient<D>(answer.force, x, energy, scene.spacing, Tolerance<K, D>(scene).elastic);
  }
}

// Verification problem 2: F is the rotation, and no force arises, up to 100 degrees and after a
// translation of metres.
TYPED_TEST(Invariants, RigidMotionMakesNoForce) {
  constexpr int D = TypeParam::dimension;
  for (auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    if (is_lattice<TypeParam> && scene.jittered) continue;
    const auto bonds = make_bonds<TypeParam>(scene);
    const Materials m(scene.x.size());
    for (const double degrees : {0.0, 1.0, 35.0, 100.0}) {
      const auto R = this->rotation(degrees);
      for (std::size_t i = 0; i < scene.x.size(); ++i) {
        scene.x[i] = R * scene.reference[i];
        scene.x[i][0] += 2;
      }
      const auto answer = this->evaluate(bonds, scene.x, m);
      const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
      // Positions of 2 m round twenty times more coarsely than those the tolerance is made for.
      const double state = 20 * std::numeric_limits<double>::epsilon() * 2 / scene.spacing;
      EXPECT_LE(largest_difference<D>(answer.force, [](std::size_t) { return hmps::Vector<double, D>::Zero(); }),
                tolerance.elastic + tolerance.artificial + 10 * state * 8e4 / scene.spacing)
          << degrees;
      for (const auto& F : answer.F) ASSERT_LE((F - R).norm(), tolerance.gradient + state) << degrees;
    }
  }
}

// Forces and torques sum to zero, with a different material in every particle.
TYPED_TEST(Invariants, ForcesAndTorquesSumToZero) {
  constexpr int D = TypeParam::dimension;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    if (is_lattice<TypeParam> && scene.jittered) continue;
    const auto bonds = make_bonds<TypeParam>(scene);
    const auto answer = this->evaluate(bonds, scene.x, Materials(scene.x.size()));
    const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
    const double each = tolerance.elastic + tolerance.artificial, n = static_cast<double>(scene.x.size());
    hmps::Vector<double, D> sum = hmps::Vector<double, D>::Zero();
    double size = 0, largest = 0;
    Eigen::Matrix<double, D, D> torque = Eigen::Matrix<double, D, D>::Zero();
    for (std::size_t i = 0; i < scene.x.size(); ++i) {
      const hmps::Vector<double, D> arm = scene.x[i] - scene.x[0];
      sum += answer.force[i];
      torque += arm * answer.force[i].transpose() - answer.force[i] * arm.transpose();
      size = std::max(size, arm.norm());
      largest = std::max(largest, answer.force[i].norm());
    }
    EXPECT_GT(largest, 100 * each) << "the state has no forces to speak of";
    // Independent errors of each particle.
    EXPECT_LE(sum.norm(), std::sqrt(n) * each);
    EXPECT_LE(torque.norm(), std::sqrt(n) * each * size);
  }
}

// Verification problem 1: an affine map is reproduced to round-off at every particle, also jittered ones and
// at surfaces; inside a lattice the elastic and artificial forces vanish. (Between jittered particles
// they do not: sum (A_i^-1 + A_j^-1) r0 w is zero by symmetry alone.)
TYPED_TEST(Invariants, AffineMapsAreReproduced) {
  constexpr int D = TypeParam::dimension;
  Eigen::Matrix<double, D, D> G = this->rotation(25);
  G(0, 0) += 0.2;
  G(0, 1) -= 0.3;
  G(D - 1, 0) += 0.1;
  for (auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    if (is_lattice<TypeParam> && scene.jittered) continue;
    const auto bonds = make_bonds<TypeParam>(scene);
    for (std::size_t i = 0; i < scene.x.size(); ++i) scene.x[i] = G * scene.reference[i];
    const auto answer = this->evaluate(bonds, scene.x, Materials(scene.x.size(), true));
    const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
    for (const auto& F : answer.F) ASSERT_LE((F - G).norm(), tolerance.gradient);
    if (scene.jittered) continue;
    const auto full = [&](std::size_t i) {
      int neighbours = 0;
      bonds.for_each_bond(i, [&](auto, const auto&, auto) { ++neighbours; });
      return neighbours == (D == 3 ? 26 : 8);
    };
    std::size_t inside = 0;
    for (std::size_t i = 0; i < scene.x.size(); ++i) {
      bool deep = full(i);
      bonds.for_each_bond(i, [&](auto j, const auto&, auto) { deep = deep && full(j); });
      if (!deep) continue;
      ++inside;
      EXPECT_LE(answer.force[i].norm(), tolerance.elastic + tolerance.artificial) << i;
    }
    if (scene.name == "box") {
      EXPECT_GT(inside, 10u);
    }
  }
}

// However far a body has travelled, float kernels see the same displacements: positions that both
// doubles hold exactly give the same bits.
TYPED_TEST(Invariants, TravelDoesNotCostPrecision) {
  constexpr int D = TypeParam::dimension;
  scenes::Scene<D> scene;
  scene.reference = scenes::box<D>(scenes::extent<D>(9, 8, 7));
  scenes::move(scene);
  const auto bonds = make_bonds<TypeParam>(scene);
  const Materials m(scene.x.size());
  for (std::size_t i = 0; i < scene.x.size(); ++i)
    for (int d = 0; d < D; ++d) {
      const double u = std::ldexp(std::round(std::ldexp(scene.x[i][d] - bonds.reference(i, d), 36)), -36);
      scene.x[i][d] = bonds.reference(i, d) + u;
    }
  const auto here = this->evaluate(bonds, scene.x, m);
  for (auto& x : scene.x) x[0] += 10;
  const auto there = this->evaluate(bonds, scene.x, m);
  const double state = std::numeric_limits<double>::epsilon() * 10 / scene.spacing;
  EXPECT_LE(largest_difference<D>(here.force, [&](std::size_t i) { return there.force[i]; }),
            10 * state * 8e4 / scene.spacing);
}

// The same if one of two pieces that no bond joins moves away, up to the rounding of displacements to K, which are
// taken from another particle then.
TYPED_TEST(Invariants, TravelOfAPieceDoesNotCostPrecision) {
  constexpr int D = TypeParam::dimension;
  scenes::Scene<D> scene;
  scene.reference = scenes::box<D>(scenes::extent<D>(9, 8, 7));
  scenes::move(scene);
  const double middle = (scene.reference.front()[0] + scene.reference.back()[0]) / 2;
  const auto is_left = [&](std::size_t i) { return scene.reference[i][0] < middle; };
  scene.bonded = [&](std::size_t i, std::size_t j) { return is_left(i) == is_left(j); };
  const auto bonds = make_bonds<TypeParam>(scene);
  EXPECT_EQ(bonds.pieces().middle().size(), 2U);
  const Materials m(scene.x.size());
  const auto here = this->evaluate(bonds, scene.x, m);
  for (const bool left : {true, false}) {
    auto x = scene.x;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (is_left(i) == left) x[i][0] += 16;
    const auto there = this->evaluate(bonds, x, m);
    const Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
    const double state = std::numeric_limits<double>::epsilon() * 16 / scene.spacing;
    EXPECT_LE(largest_difference<D>(here.force, [&](std::size_t i) { return there.force[i]; }),
              tolerance.elastic + tolerance.artificial + 10 * state * 8e4 / scene.spacing)
        << (left ? "left" : "right");
  }
}

}  // namespace internal_force_invariants_test
