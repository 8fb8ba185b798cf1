// SPDX-License-Identifier: MIT
// A particle is thrown at a held wall, faster and faster until it goes through, which must be reported.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "bodies.hpp"
#include "hmps/contact/contact.hpp"

namespace tunnelling_test {

using hmps::Index;

constexpr double l0 = 1.2e-3, dt = 2e-5;

/// What became of the particle: whether it passed, how deep it was in the wall, and whether that was reported.
struct Throw {
  bool passed = false, reported = false;
  double depth = 0;  // the largest p in spacings before anything was reported
  std::string message = {};
};

/// Throws it at a wall of `layers`, off the wall's lattice, at `pace` spacings per step.
template <class Ball>
Throw at_wall(int layers, double ratio, double pace, double phase) {
  bodies::Scene<double, 3> scene;
  const auto wall = scene.add({9, 9, layers}, {0, 0, -(layers - 1) * l0}, l0);
  const auto thrown = scene.add({1, 1, 1}, {4.3 * l0, 3.8 * l0, (1.1 + phase * pace) * l0}, l0);
  hmps::MetaballContact<double, 3, Ball> contact(
      {.spacing = l0, .density = 1000, .stiffness = hmps::PenaltyStiffness::ratio(ratio)});
  const auto held = [](Index) { return true; };
  contact.add_pair(contact.add_organ({.name = "wall", .slaves = {}, .masters = wall.all, .prescribed = held}),
                   contact.add_organ({.name = "thrown", .slaves = thrown.all, .masters = {}, .prescribed = {}}),
                   {.roles = hmps::Roles::only_second_is_slave, .excluded_slaves = {}, .excluded = {}});
  const Index i = thrown.all[0];
  scene.v[i][2] = -pace * l0 / dt;
  Throw result;
  for (int step = 0; step < 2000; ++step) {
    const auto report = scene.apply(contact, dt);
    try {
      contact.check(report, step * dt);
    } catch (const hmps::StateError& error) {
      result.reported = true;
      if (result.message.empty()) result.message = error.what();
      EXPECT_EQ(report.lost_slave, i);
    }
    if (!result.reported) result.depth = std::max(result.depth, report.penetration / l0);
    scene.v[i] += scene.f[i] * dt / 1000;
    scene.x[i] += scene.v[i] * dt;
    result.passed = scene.x[i][2] < -(layers + 0.5) * l0;
    if (result.passed || scene.x[i][2] > 2 * l0) break;
  }
  return result;
}

template <class Ball>
class Tunnelling : public ::testing::Test {};
using Balls = ::testing::Types<hmps::SmoothMetaball, hmps::PaperMetaball>;
TYPED_TEST_SUITE(Tunnelling, Balls);

/// Up to the speed of sound: at the limit of stability, sound crosses 0.9 spacings per step.
TYPED_TEST(Tunnelling, IsAlwaysReported) {
  std::size_t passed = 0;
  for (const int layers : {1, 2, 3})
    for (const double ratio : {0.3, 0.05})
      for (double pace = 0.02; pace < 0.9; pace += 0.02)
        for (const double phase : {0., 0.5}) {
          const Throw result = at_wall<TypeParam>(layers, ratio, pace, phase);
          passed += result.passed;
          EXPECT_TRUE(!result.passed || result.reported)
              << layers << " layers, k~ = " << ratio << ", " << pace << " spacings per step, phase " << phase << ", p "
              << result.depth;
        }
  EXPECT_GT(passed, 100U) << "nothing goes through, so this test proves nothing";
}

/// A wall of two layers holds a slave that comes 0.8 spacings deep, as the deepest slaves of the swallow do; a wall of
/// a single layer, whose middle is half a spacing deep, holds one at 0.3.
TYPED_TEST(Tunnelling, IsNotReportedOfWhatTheWallThrowsBack) {
  for (const int layers : {1, 2, 3})
    for (const double ratio : {0.3, 0.05}) {
      const double depth = layers == 1 ? 0.3 : 0.8;
      const Throw result = at_wall<TypeParam>(layers, ratio, depth * std::sqrt(ratio), 0);
      EXPECT_FALSE(result.passed);
      EXPECT_FALSE(result.reported) << layers << " layers, k~ = " << ratio << ": " << result.message;
      EXPECT_GT(result.depth, 0.6 * depth);
    }
}

TEST(TunnellingMessage, NamesTimeParticleOrganDepthAndRemedy) {
  const Throw result = at_wall<hmps::SmoothMetaball>(2, 0.05, 0.5, 0);
  ASSERT_TRUE(result.passed);
  for (const char* part : {"at t = ", "'wall'", "particle 162", " m (", " spacings)", "smaller time step", "layers"})
    EXPECT_NE(result.message.find(part), std::string::npos) << part << " in: " << result.message;
}

}  // namespace tunnelling_test
