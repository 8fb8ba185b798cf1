// SPDX-License-Identifier: MIT
// Problems with known answers: a block on an incline, and a slide without friction. The block is one
// rigid body that does not turn: its particles share one velocity, driven by the sum of their forces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "hmps/contact/contact.hpp"
#include "hmps/contact/surface_correction.hpp"
#include "hmps/shapes/implicit.hpp"

namespace incline_test {

using hmps::Index;
using hmps::MetaballContact;
using Point = hmps::Vector<double, 3>;

constexpr double l0 = 1.2e-3, density = 1000, dt = 2e-5, gravity = 9.81, pi = 3.14159265358979323846;

struct Setting {
  double friction = 0, degrees = 0, turn = 0;  // turn: of the wall's lattice about its normal
  double speed = 0, seconds = 0.06;
  std::optional<double> damping = 0.1;
  double cut = 0;       // degrees between the wall's surface and its lattice, about y
  bool raised = false;  // contact sees the wall's skin raised to the surface
};
struct Outcome {
  double acceleration = 0;  // over the second half
  double speed = 0;         // at the end
  double bounce = 0;        // rms of the speed across the wall in the second half
  double slope = 0;         // largest of drag over normal force
  double moved = 0;         // along the wall in the second half, spacings
  double contacts = 0;      // mean in the second half
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
  const double up = std::cos(setting.cut * pi / 180), along = std::sin(setting.cut * pi / 180);
  const int rows = setting.cut > 0 ? 20 : 2;  // of the lattice below and above its origin; the surface is at 0.5
  for (int k = -rows; k <= (setting.cut > 0 ? rows : 0); ++k)
    for (int j = -20; j <= 20; ++j)
      for (int i = -30; i <= 40; ++i) {
        const Point flat(c * i - s * j, s * i + c * j, k);
        const Point place(up * flat[0] - along * flat[2], flat[1], along * flat[0] + up * flat[2]);
        if (place[0] < -3 || place[0] > 15 || place[1] < -3 || place[1] > 9) continue;
        if (place[2] > 0.5 || place[2] < -2.6) continue;
        wall.push_back(add(place * l0));
        if (place[2] > 0.5 - up) top.push_back(wall.back());
      }
  if (setting.raised) {
    const hmps::HalfSpace<double, 3> inside{Point(0, 0, 0.5 * l0), Point::UnitZ()};
    const hmps::SurfaceCorrection<double, 3> raise(hmps::vectors(scene.x), top, inside, l0);
    for (std::size_t n = 0; n < top.size(); ++n) scene.x[top[n]] += raise.offsets()[n];
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
  // On a staircase the block starts where its weight is borne, otherwise where it just touches.
  const double weight = gravity * density * static_cast<double>(block.size());
  const auto shift = [&](double by) {
    for (const Index i : block) scene.x[i][2] += by;
  };
  for (double step = setting.cut > 0 ? 0.5 * l0 : 0; step > 1e-7 * l0; step /= 2) {
    scene.apply(contact, dt);
    double push = 0;
    for (const Index i : block) push += scene.f[i][2];
    shift(push > weight ? step : -step);
  }
  Point velocity(setting.speed, 0, 0), middle = velocity;
  Outcome outcome;
  const int steps = static_cast<int>(setting.seconds / dt);
  for (int step = 0; step < steps; ++step) {
    velocity += pull * dt;
    for (const Index i : block) scene.v[i] = velocity;
    const auto report = scene.apply(contact, dt);
    Point force = Point::Zero();
    for (const Index i : block) force += scene.f[i];
    velocity += force * (dt / density / static_cast<double>(block.size()));
    // The block runs as if on rails: normals tilted sideways do not steer it.
    velocity[1] = 0;
    for (const Index i : block) scene.x[i] += velocity * dt;
    if (step == steps / 2) middle = velocity, outcome.moved = -scene.x[block[0]][0] / l0;
    if (step < steps / 2) continue;
    outcome.contacts += static_cast<double>(report.contacts) / (steps - steps / 2);
    outcome.bounce += velocity[2] * velocity[2] / (steps - steps / 2);
    if (force[2] > 0) outcome.slope = std::max(outcome.slope, std::abs(force[0]) / force[2]);
  }
  outcome.acceleration = (velocity - middle)[0] / (setting.seconds / 2);
  outcome.speed = velocity[0];
  outcome.moved += scene.x[block[0]][0] / l0;
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

/// The block slides as it should on both lattices. The remaining error is the tilt of the normals over the distance
/// that the block slid (1 to 6 spacings): at most 0.010 m/s2 was measured, a thousandth of g.
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

/// Without damping the block keeps bouncing on the ripple of the lattice, and its friction is that of a bouncing block:
/// errors of at most 0.06 m/s2 were measured.
TEST(Incline, SmoothWallHoldsItWithoutDampingMoreCoarsely) {
  for (const double friction : {0.1, 0.3}) {
    const auto outcome =
        slide<hmps::SmoothMetaball, hmps::CorrectedFriction>({.friction = friction, .degrees = 20, .damping = 0});
    EXPECT_NEAR(outcome.acceleration, exact(friction, 20), 0.1);
  }
}

/// How fast a sticking block creeps: to hold, (40) needs a slip velocity v, with the force share rho v / dt in each of
/// `contacts`, which together carry the pull on all 144 particles. The share is a half, because particles that touch
/// the wall do so in both roles.
double creep(double degrees, double contacts) {
  return gravity * std::sin(degrees * pi / 180) * dt * 144 / (0.5 * contacts);
}

/// On a wall that is cut out of its lattice at an angle, with its skin raised, a block that should hold does, and one
/// that should slide does so at the right rate. For a soft block, `benchmarks/walls` measured errors up to 0.047 m/s2,
/// which come from the remaining bumps; this test allows twice that, because its block is rigid and touches in fewer
/// places.
TEST(Incline, SurfaceCorrectionHoldsItOnEveryCut) {
  for (const double cut : {15., 30., 45.}) {
    const auto held = slide<hmps::SmoothMetaball, hmps::CorrectedFriction>(
        {.friction = 0.3, .degrees = 10, .seconds = 0.16, .cut = cut, .raised = true});
    EXPECT_LT(std::abs(held.moved), 1.2 * 0.08 * creep(10, held.contacts) / l0)
        << cut << ", contacts " << held.contacts;
    EXPECT_LT(std::abs(held.moved), 0.1) << "otherwise the bound above proves nothing";
    const auto slid = slide<hmps::SmoothMetaball, hmps::CorrectedFriction>(
        {.friction = 0.3, .degrees = 20, .seconds = 0.12, .cut = cut, .raised = true});
    EXPECT_NEAR(slid.acceleration, exact(0.3, 20), 0.1) << cut;
    EXPECT_GT(slid.moved, 1) << cut;
  }
}

static_assert(
    std::is_same_v<MetaballContact<double, 3>, MetaballContact<double, 3, hmps::SmoothMetaball, hmps::SpringFriction>>,
    "the default of contact");

/// At 95 % of the limit the default, the spring, holds the block still: it is at rest to rounding, whereas with
/// `CorrectedFriction` it creeps by a tenth of a millimetre per second and more.
TEST(Incline, SpringHoldsItUpToTheLimit) {
  constexpr double most = 0.01e-6;  // m/s
  for (const double friction : {0.1, 0.5, 1.0})
    for (const double cut : {0., 15.}) {
      if (cut > 0 && friction != 0.5) continue;
      Setting setting{.friction = friction, .seconds = 0.16, .damping = {}, .cut = cut, .raised = cut > 0};
      setting.degrees = 0.95 * std::atan(friction) * 180 / pi;
      const auto held = slide<hmps::SmoothMetaball, hmps::SpringFriction>(setting);
      EXPECT_LT(std::abs(held.moved) * l0 / 0.08, most) << friction << ", cut " << cut;
      EXPECT_LT(std::abs(held.speed), most) << friction << ", cut " << cut;
    }
  const auto crept = slide<hmps::SmoothMetaball, hmps::CorrectedFriction>(
      {.friction = 0.5, .degrees = 0.95 * std::atan(0.5) * 180 / pi, .seconds = 0.16});
  EXPECT_GT(crept.moved * l0 / 0.08, 1e-4) << "otherwise the bound above proves nothing";
}

/// Beyond the limit the block slides as with `CorrectedFriction`.
TEST(Incline, SpringSlidesBeyondTheLimit) {
  for (const double friction : {0.1, 0.3}) {
    const auto outcome =
        slide<hmps::SmoothMetaball, hmps::SpringFriction>({.friction = friction, .degrees = 20, .damping = {}});
    EXPECT_NEAR(outcome.acceleration, exact(friction, 20), 0.02);
  }
  const auto just = slide<hmps::SmoothMetaball, hmps::SpringFriction>(
      {.friction = 0.5, .degrees = 1.05 * std::atan(0.5) * 180 / pi, .seconds = 0.16, .damping = {}});
  EXPECT_NEAR(just.acceleration, exact(0.5, 1.05 * std::atan(0.5) * 180 / pi), 0.02);
}

/// Without the correction the cut wall is a staircase, which stops a block that should slide.
TEST(Incline, StairsStopIt) {
  const auto stopped = slide<hmps::SmoothMetaball, hmps::CorrectedFriction>(
      {.friction = 0.3, .degrees = 20, .seconds = 0.12, .cut = 15});
  EXPECT_LT(stopped.acceleration, exact(0.3, 20) - 0.3);
}

/// The paper's friction differs from the corrected one only where particles stick: at these angles, not at all.
TEST(Incline, SmoothWallAndPaperFrictionSlideAlike) {
  const auto outcome = slide<hmps::SmoothMetaball, hmps::PaperFriction>({.friction = 0.1, .degrees = 20});
  EXPECT_NEAR(outcome.acceleration, exact(0.1, 20), 0.02);
}

/// The washboard of the paper's metaballs: the block jumps from bump to bump, and its acceleration has little to do
/// with the coefficient (errors of -1.1 to +0.1 m/s2 were measured on this wall, and of -1.5 on a turned one). This
/// test would notice if that were ever cured.
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

}  // namespace incline_test
