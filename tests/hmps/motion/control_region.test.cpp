// SPDX-License-Identifier: MIT
#include "hmps/motion/control_region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/two_threads.hpp"

namespace control_region_test {

using hmps::ControlRegion;
using hmps::Index;
using hmps::Vector;

template <class S_, int D_>
struct Case {
  using S = S_;
  static constexpr int D = D_;
};

template <class T>
class ControlRegionTest : public testing::Test {
 public:
  using Scalar = typename T::S;
  static constexpr int dimension = T::D;
  using Positions = std::vector<Vector<Scalar, dimension>>;

  static hmps::RigidMotion<dimension> motion() {
    hmps::RigidMotion<dimension> result{.pivot = Vector<double, dimension>::Constant(0.01),
                                        .translation = {{0.0, Vector<double, dimension>::Zero()},
                                                        {0.5, 0.02 * Vector<double, dimension>::Unit(1)},
                                                        {1.0, -0.01 * Vector<double, dimension>::Unit(0)}},
                                        .turn = turn()};
    return result;
  }
  static auto turn() {
    if constexpr (dimension == 2)
      return hmps::Keyframes<1>{{0.0, 0.0}, {1.0, 1.5}};
    else
      return hmps::Keyframes<3>{{0.0, {0, 0, 0}}, {1.0, {0.5, 1.0, -0.3}}};
  }
  Positions at_rest = [] {
    Positions points;
    for (int k = 0; k < 8; ++k) points.push_back(Vector<Scalar, dimension>::Constant(static_cast<Scalar>(1.2e-3 * k)));
    return points;
  }();
  Positions positions = at_rest;
  Positions velocities{8, Vector<Scalar, dimension>::Zero()};
};
using Cases = testing::Types<Case<float, 2>, Case<double, 2>, Case<float, 3>, Case<double, 3>>;
TYPED_TEST_SUITE(ControlRegionTest, Cases);

TYPED_TEST(ControlRegionTest, DriftLandsOnTheMotionAfterThousandsOfSteps) {
  using S = typename TestFixture::Scalar;
  constexpr int D = TestFixture::dimension;
  const auto motion = this->motion();
  const ControlRegion region({1, 5, 6}, hmps::vectors(this->at_rest), motion);
  const auto x = hmps::vectors(this->positions);
  const auto v = hmps::vectors(this->velocities);
  const double dt = 1.0 / 4096;
  const S h = static_cast<S>(dt);
  double fastest = 0;
  for (int step = 0; step < 4096; ++step) {
    region.prescribe(x, v, (step + 1) * dt, dt);
    for (std::size_t i = 0; i < 8; ++i) {
      fastest = std::max(fastest, static_cast<double>(v[i].norm()));
      x.add(i, Vector<S, D>(v[i] * h));
    }
  }
  // Rounding of only one step, of a position of at most 0.05 m.
  const double bound = 4 * 0.05 * static_cast<double>(std::numeric_limits<S>::epsilon());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LE((x[region.particles()[k]].template cast<double>() - region.position(k, 1.0)).norm(), bound);
  EXPECT_GT((region.position(0, 1.0) - this->at_rest[1].template cast<double>()).norm(), 0.005);
  // The first and the last step are slow and nothing is kicked: below the speeds in between.
  EXPECT_LT(fastest, 1);
  for (const std::size_t i : {0u, 2u, 3u, 4u, 7u}) EXPECT_EQ(this->positions[i], this->at_rest[i]);
}

TYPED_TEST(ControlRegionTest, UnloadsItsOwnParticlesOnly) {
  using S = typename TestFixture::Scalar;
  constexpr int D = TestFixture::dimension;
  const ControlRegion region({1, 5, 6}, hmps::vectors(this->at_rest), this->motion());
  std::vector<Vector<S, D>> f(8, Vector<S, D>::Constant(S(3)));
  region.unload(hmps::vectors(f));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(f[i][0], i == 1 || i == 5 || i == 6 ? S(0) : S(3)) << i;
  f.pop_back();
  EXPECT_THROW(region.unload(hmps::vectors(f)), hmps::InputError);
}

TYPED_TEST(ControlRegionTest, TakesASetOfParticles) {
  const auto reference = hmps::vectors(this->at_rest);
  const hmps::ParticleSet set(8, {5, 1, 6});
  EXPECT_EQ(ControlRegion(set, reference, this->motion()).particles(), (std::vector<Index>{1, 5, 6}));
  EXPECT_THROW(ControlRegion(hmps::ParticleSet(9, {5, 1, 6}), reference, this->motion()), hmps::InputError);
  EXPECT_THROW(ControlRegion(set & ~set, reference, this->motion()), hmps::InputError);
}

TYPED_TEST(ControlRegionTest, StartsWithoutAJumpOfVelocity) {
  const ControlRegion region({1, 5}, hmps::vectors(this->at_rest), this->motion());
  const double dt = 1e-5;
  region.prescribe(hmps::vectors(this->positions), hmps::vectors(this->velocities), dt, dt);
  // Positions rise as the square of time: the velocity is below the largest acceleration, about 1 m/s2, times dt, plus
  // the rounding of positions over dt.
  const double rounding = 0.05 * std::numeric_limits<typename TestFixture::Scalar>::epsilon() / dt;
  EXPECT_LE(static_cast<double>(this->velocities[1].norm()), 1e-5 + rounding);
}

TYPED_TEST(ControlRegionTest, PlacesARunThatStartsWithinTheMotion) {
  using S = typename TestFixture::Scalar;
  constexpr int D = TestFixture::dimension;
  const auto motion = this->motion();
  const ControlRegion<S, D> region({2, 3}, hmps::vectors(this->at_rest), motion);
  const auto x = hmps::vectors(this->positions);
  const auto v = hmps::vectors(this->velocities);
  const double dt = 1e-3;
  EXPECT_THROW(region.prescribe(x, v, 0.4 + dt, dt, 1.0), hmps::StateError);
  region.place(x, v, 0.4);
  for (std::size_t k = 0; k < 2; ++k) {
    const Index i = region.particles()[k];
    const Vector<double, D> at = this->at_rest[i].template cast<double>();
    EXPECT_LE((x[i].template cast<double>() - motion(0.4)(at)).norm(),
              0.05 * static_cast<double>(std::numeric_limits<S>::epsilon()));
    const Vector<double, D> speed = velocity(motion(0.4), motion.rate(0.4), at);
    EXPECT_LE((v[i].template cast<double>() - speed).norm(), 1e-7);
  }
  EXPECT_NO_THROW(region.prescribe(x, v, 0.4 + dt, dt, 1.0));
  EXPECT_EQ(this->positions[0], this->at_rest[0]);
}

// A motion that is over within the 2 microseconds of a difference.
TYPED_TEST(ControlRegionTest, PlacesWithTheRateOfAMotionThatHasOne) {
  using S = typename TestFixture::Scalar;
  constexpr int D = TestFixture::dimension;
  const auto close_to = [](const auto& found, double expected) {
    return std::abs(static_cast<double>(found) - expected) <= 4 * std::numeric_limits<S>::epsilon() * expected;
  };
  const auto x = hmps::vectors(this->positions), v = hmps::vectors(this->velocities);
  Vector<double, D> far = Vector<double, D>::Zero();
  far[1] = 3e-7;
  const hmps::Translation<D> quick{{{0, Vector<double, D>::Zero()}, {1e-7, far}}};
  ControlRegion({1, 5}, hmps::vectors(std::as_const(this->at_rest)), quick).place(x, v, 5e-8);
  EXPECT_EQ(v(1, 0), 0);
  EXPECT_TRUE(close_to(v(1, 1), 1.5 * 3)) << v(1, 1);  // the steepest slope of the cubic
  EXPECT_EQ(v(5, 1), v(1, 1));
  ControlRegion({2}, hmps::vectors(std::as_const(this->at_rest)), hmps::Fixed<D>()).place(x, v, 5e-8);
  EXPECT_EQ(v[2].norm(), 0);
}

TYPED_TEST(ControlRegionTest, TakesMotionsThatAreNotRigid) {
  using S = typename TestFixture::Scalar;
  constexpr int D = TestFixture::dimension;
  const auto stretch = [](double t) {
    return [t](const Vector<double, D>& X) { return Vector<double, D>((1 + t) * X); };
  };
  const ControlRegion region({4}, hmps::vectors(this->at_rest), stretch);
  region.prescribe(hmps::vectors(this->positions), hmps::vectors(this->velocities), 0.5, 0.25);
  EXPECT_LE((this->velocities[4] - S(2) * this->at_rest[4]).norm(), S(1e-7));
}

TYPED_TEST(ControlRegionTest, NamesTheInvalidArgument) {
  using S = typename TestFixture::Scalar;
  constexpr int D = TestFixture::dimension;
  const auto reference = hmps::vectors(this->at_rest);
  const auto motion = this->motion();
  EXPECT_THROW((ControlRegion<S, D>({8}, reference, motion)), hmps::InputError);
  EXPECT_THROW((ControlRegion<S, D>({3, 1, 3}, reference, motion)), hmps::InputError);
  const ControlRegion<S, D> region({3}, reference, motion);
  const auto x = hmps::vectors(this->positions);
  const auto v = hmps::vectors(this->velocities);
  EXPECT_THROW(region.prescribe(x, v, 0.1, 0.0), hmps::InputError);
  EXPECT_THROW(region.prescribe(x.part(0, 7), v, 0.1, 0.1), hmps::InputError);
  EXPECT_THROW(region.prescribe(x, v.part(0, 7), 0.1, 0.1), hmps::InputError);
  this->positions[3][0] = std::numeric_limits<S>::quiet_NaN();
  try {
    region.prescribe(x, v, 0.1, 0.1);
    ADD_FAILURE() << "a position that is NaN was accepted";
  } catch (const hmps::StateError& error) {
    EXPECT_NE(std::string(error.what()).find("particle 3"), std::string::npos) << error.what();
  }
  this->at_rest[3][0] = std::numeric_limits<S>::infinity();
  EXPECT_THROW((ControlRegion<S, D>({3}, reference, motion)), hmps::InputError);
}

TEST(ControlRegionMisuse, IsRefused) {
  using V = Vector<double, 3>;
  std::vector<V> X(3, V::Zero()), x = X, v = X;
  const auto reference = hmps::vectors(std::as_const(X));
  const auto lost = [](double t) {
    hmps::Pose<double, 3> pose;
    pose.translation[0] = t > 0 ? NAN : 0;
    return pose;
  };
  const ControlRegion<double, 3> region({1}, reference, lost);
  EXPECT_THROW(region.place(hmps::vectors(x), hmps::vectors(v), 1), hmps::StateError);
  EXPECT_THROW(region.place(hmps::vectors(x), hmps::vectors(v), NAN), hmps::InputError);
  EXPECT_THROW(region.prescribe(hmps::vectors(x), hmps::vectors(v), -1, 1e-3, -5.0), hmps::InputError);
  EXPECT_EQ(x, X);
  EXPECT_THROW((ControlRegion<double, 3>({1}, reference, nullptr)), hmps::InputError);
  // A region whose reference positions are the positions that it moves would go further with each step.
  const auto shift = [](double t) { return hmps::Pose<double, 3>{.translation = V(t, 0, 0)}; };
  const ControlRegion<double, 3> moving({1}, hmps::vectors(std::as_const(x)), shift);
  EXPECT_THROW(moving.prescribe(hmps::vectors(x), hmps::vectors(v), 1, 1e-3), hmps::InputError);
  EXPECT_THROW(moving.place(hmps::vectors(x), hmps::vectors(v), 1), hmps::InputError);
}

/// A `Pose` is rigid by definition. A motion that is not rigid may be a lambda.
TEST(ControlRegion, RejectsAPoseThatIsNotARotation) {
  using V = Vector<double, 3>;
  std::vector<V> X(3, V(1, 2, 3)), x = X, v(3, V::Zero());
  const auto reference = hmps::vectors(std::as_const(X));
  hmps::Matrix<double, 3> sheared = hmps::Matrix<double, 3>::Identity();
  sheared(0, 1) = 0.3;
  const hmps::Matrix<double, 3> whole = hmps::Matrix<double, 3>::Identity();
  for (const hmps::Matrix<double, 3>& matrix : {hmps::Matrix<double, 3>(0 * whole), hmps::Matrix<double, 3>(2 * whole),
                                                hmps::Matrix<double, 3>(-whole), sheared}) {
    const ControlRegion<double, 3> region({1}, reference,
                                          [&](double) { return hmps::Pose<double, 3>{.rotation = matrix}; });
    EXPECT_THROW(region.prescribe(hmps::vectors(x), hmps::vectors(v), 0, 1e-3), hmps::InputError);
    EXPECT_THROW(region.place(hmps::vectors(x), hmps::vectors(v), 0), hmps::InputError);
    EXPECT_EQ(x, X);
  }
  const ControlRegion squeezed(std::vector<Index>{1}, reference,
                               [&](double) { return [&](const V& place) { return V(sheared * place); }; });
  EXPECT_NO_THROW(squeezed.prescribe(hmps::vectors(x), hmps::vectors(v), 0, 1e-3));
}

TEST(ControlRegion, KeepsTheErrorOfAParticleFromTheUsersThreads) {
  std::vector<Eigen::Vector3d> reference(10, Eigen::Vector3d::Zero()), x = reference, v = reference;
  const hmps::ControlRegion region(
      hmps::ParticleSet(10, [](std::size_t) { return true; }), hmps::vectors(std::as_const(reference)),
      [](double) { return [](const Vector<double, 3>& X) { return (X.array() + 1).matrix().eval(); }; });
  const std::string error = hmps_test::message_in_two_threads<hmps::StateError>(
      [&](const auto& execute) { region.prescribe(hmps::vectors(x), hmps::vectors(v), 0.5, 1e-3, 10.0, execute); });
  EXPECT_NE(error.find("requires particle 0 to move at 1732"), std::string::npos) << error;
}

}  // namespace control_region_test
