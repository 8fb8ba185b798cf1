// SPDX-License-Identifier: MIT
// Problems with known answers: a block on an incline, and a slide without friction. The block is one
// rigid body that does not turn: its particles share one velocity, driven by the sum of their forces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "hmps/contact/contact.hpp"

namespace {

using hmps::Index;
using hmps::MetaballContact;
using Point = hmps::Vector<double, 3>;

constexpr double l0 = 1.2e-3, density = 1000, dt = 2e-5, gravity = 9.81, pi = 3.14159265358979323846;

struct Setting {
  double friction = 0, degrees = 0, turn = 0;  // turn: of the wall's lattice about its normal
  double speed = 0, damping = 0.1, seconds = 0.06;
};
struct Outcome {
  double acceleration = 0;  // over the second half
  double speed = 0;         // at the end
  double bounce = 0;        // rms of the speed across the wall in the second half
  double slope = 0;         // largest of drag over normal force
};

/// A block of 6 x 6 x 4 on a prescribed wall of three layers that fills the strip it slides along.
template <class Ball, class Friction>
Outcome slide(const Setting& setting) {
  bodies::Scene<double, 3> scene;
  std::vector<Index> wall, top, block, bottom;
  const auto add = [&](const Point& place) {
    scene.x.push_back(place);
    return static_cast<Index>(scene.x.size() - 1);
  };
  const double c = std::cos(setting.turn), s = std::sin(setting.turn);
  for (int k = -2; k <= 0; ++k)
    for (int j = -20; j <= 20; ++j)
      for (int i = -30; i <= 40; ++i) {
        const Point place(c * i - s * j, s * i + c * j, k);
        if (place[0] < -3 || place[0] > 15 || place[1] < -3 || place[1] > 9) continue;
        wall.push_back(add(place * l0));
        if (k == 0) top.push_back(wall.back());
      }
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) {
        block.push_back(add(Point(i + 0.3, j + 0.2, k + 1) * l0));
        if (k == 0) bottom.push_back(block.back());
      }
  scene.v.assign(scene.x.size(), Point::Zero());
  scene.f.assign(scene.x.size(), Point::Zero());
  scene.F.assign(scene.x.size(), hmps::Matrix<double, 3>::Identity());

  // k~ = 0.3 at the paper's step of 1e-5 s, four times softer.
  MetaballContact<double, 3, Ball, Friction> contact({.spacing = l0,
                                                      .density = density,
                                                      .friction = setting.friction,
                                                      .stiffness = hmps::PenaltyStiffness::fixed(0.75e12),
                                                      .damping = setting.damping});
  const auto a =
      contact.add_organ({.name = "wall", .slaves = top, .masters = wall, .prescribed = [](Index) { return true; }});
  const auto b = contact.add_organ({.name = "block", .slaves = bottom, .masters = block, .prescribed = {}});
  contact.add_pair(a, b);

  const double angle = setting.degrees * pi / 180;
  const Point pull = gravity * Point(std::sin(angle), 0, -std::cos(angle));
  Point velocity(setting.speed, 0, 0), middle = velocity;
  Outcome outcome;
  const int steps = static_cast<int>(setting.seconds / dt);
  for (int step = 0; step < steps; ++step) {
    velocity += pull * dt;
    for (const Index i : block) scene.v[i] = velocity;
    scene.apply(contact, dt);
    Point force = Point::Zero();
    for (const Index i : block) force += scene.f[i];
    velocity += force * (dt / density / static_cast<double>(block.size()));
    // On rails: the tilt across the slide does not steer the block.
    velocity[1] = 0;
    for (const Index i : block) scene.x[i] += velocity * dt;
    if (step == steps / 2) middle = velocity;
    if (step < steps / 2) continue;
    outcome.bounce += velocity[2] * velocity[2] / (steps - steps / 2);
    if (force[2] > 0) outcome.slope = std::max(outcome.slope, std::abs(force[0]) / force[2]);
  }
  outcome.acceleration = (velocity - middle)[0] / (setting.seconds / 2);
  outcome.speed = velocity[0];
  outcome.bounce = std::sqrt(outcome.bounce);
  return outcome;
}

double exact(double friction, double degrees) {
  const double angle = degrees * pi / 180;
  return std::max(0., gravity * (std::sin(angle) - friction * std::cos(angle)));
}

TEST(Incline, ExactIsTheTextbook) {
  EXPECT_NEAR(exact(0.1, 10), 0.7374, 1e-4);
  EXPECT_NEAR(exact(0.1, 20), 2.4334, 1e-4);
  EXPECT_NEAR(exact(0.1, 30), 4.0554, 1e-4);
  EXPECT_EQ(exact(0.3, 10), 0);
  EXPECT_NEAR(exact(0.3, 20), 0.5897, 1e-4);
  EXPECT_NEAR(exact(0.3, 30), 2.3563, 1e-4);
}

/// The defaults hold the incline on both lattices. What is left is the tilt of the normals over the
/// stretch that the block slid (1 to 6 spacings): 0.010 m/s2 at most were measured, a thousandth of g.
TEST(Incline, SmoothWallAndCorrectedFrictionHoldIt) {
  for (const double turn : {0., 15 * pi / 180})
    for (const double friction : {0.1, 0.3})
      for (const double degrees : {10., 20., 30.}) {
        if (turn > 0 && degrees != 20) continue;
        const auto outcome = slide<hmps::SmoothMetaball, hmps::CorrectedFriction>(
            {.friction = friction, .degrees = degrees, .turn = turn});
        EXPECT_NEAR(outcome.acceleration, exact(friction, degrees), 0.02)
            << friction << " at " << degrees << " degrees, lattice turned by " << turn;
        EXPECT_LT(outcome.bounce, 1e-3);
      }
}

/// Without damping the block keeps bouncing on the lattice's ripple, and the friction is that of a
/// bouncing block: 0.06 m/s2 off at most were measured.
TEST(Incline, SmoothWallHoldsItWithoutDampingMoreCoarsely) {
  for (const double friction : {0.1, 0.3}) {
    const auto outcome =
        slide<hmps::SmoothMetaball, hmps::CorrectedFriction>({.friction = friction, .degrees = 20, .damping = 0});
    EXPECT_NEAR(outcome.acceleration, exact(friction, 20), 0.1);
  }
}

/// The paper's friction differs from the corrected one in stick only: at these angles, by nothing.
TEST(Incline, SmoothWallAndPaperFrictionSlideAlike) {
  const auto outcome = slide<hmps::SmoothMetaball, hmps::PaperFriction>({.friction = 0.1, .degrees = 20});
  EXPECT_NEAR(outcome.acceleration, exact(0.1, 20), 0.02);
}

/// The washboard of the paper's metaballs: the block jumps from bump to bump and its acceleration has
/// little to do with the coefficient (-1.1 to +0.1 m/s2 off were measured on this wall, -1.5 on one
/// that is turned). The test is here to notice if that should ever be cured.
TEST(Incline, PaperWallDoesNotHoldIt) {
  const auto outcome = slide<hmps::PaperMetaball, hmps::CorrectedFriction>({.friction = 0.1, .degrees = 20});
  EXPECT_GT(std::abs(outcome.acceleration - exact(0.1, 20)), 0.2);
  EXPECT_GT(outcome.bounce, 0.01);
}

/// A slide without friction keeps its speed on the smooth wall.
TEST(Slide, HasNoDragOnTheSmoothWall) {
  for (const double turn : {0., 15 * pi / 180}) {
    const auto smooth =
        slide<hmps::SmoothMetaball, hmps::CorrectedFriction>({.turn = turn, .speed = 0.2, .seconds = 0.04});
    const auto paper =
        slide<hmps::PaperMetaball, hmps::CorrectedFriction>({.turn = turn, .speed = 0.2, .seconds = 0.04});
    EXPECT_NEAR(smooth.speed, 0.2, 0.002);
    EXPECT_LT(smooth.slope, 0.03) << "tilt of the block's force";
    RecordProperty("smooth_slope", std::to_string(smooth.slope));
    RecordProperty("paper_slope", std::to_string(paper.slope));
  }
}

}  // namespace
