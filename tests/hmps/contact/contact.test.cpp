// SPDX-License-Identifier: MIT
#include "hmps/contact/contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/message_of.hpp"
#include "../../reference/scenes.hpp"
#include "bodies.hpp"
#include "hmps/diagnostics/momentum.hpp"
#include "hmps/time/symplectic_euler.hpp"
#include "plain_contact.hpp"

namespace contact_test {

using hmps_test::message_of;

using bodies::Case;
using hmps::CorrectedFriction;
using hmps::Index;
using hmps::MetaballContact;
using hmps::PaperFriction;
using hmps::PaperMetaball;
using hmps::SmoothMetaball;

template <class C>
class ContactTest : public ::testing::Test {};
using Cases = ::testing::Types<Case<double, 3, SmoothMetaball>, Case<double, 2, PaperMetaball>,
                               Case<float, 3, PaperMetaball>, Case<float, 2, SmoothMetaball>>;
TYPED_TEST_SUITE(ContactTest, Cases);

/// Without damping, the normal force is that of the paper.
const hmps::ContactSettings with_friction{.spacing = 1e-3, .density = 1000, .friction = 0.3, .damping = 0};
constexpr double dt = 1e-5;

TYPED_TEST(ContactTest, PushesTheBodiesApartAndSumsToZero) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  bodies::Pile<S, D> pile(0.9);
  pile.shake(S(0.05), S(0.03), 2);
  MetaballContact<S, D, typename TypeParam::Ball> contact(with_friction);
  const auto pair = pile.declare(contact);
  const auto report = pile.apply(contact, dt);
  EXPECT_GT(report.contacts, 2U);
  EXPECT_EQ(report.lost, 0U);
  EXPECT_GT(report.penetration, S(0.02e-3));
  EXPECT_LT(report.penetration, S(0.3e-3));
  EXPECT_LE(pile.total().norm(), S(20) * std::numeric_limits<S>::epsilon() * pile.magnitude());
  S up = 0;
  for (const Index i : pile.block.all) up += pile.f[i][D - 1];
  EXPECT_GT(up, S(0));
  const double volume = std::pow(1e-3, D);
  EXPECT_NEAR(contact.force_on_first(pair)[D - 1], -up * volume, 1e-4 * up * volume);
  std::size_t touches = 0;
  hmps::Vector<double, D> on_first = hmps::Vector<double, D>::Zero();
  contact.for_each_touch([&](const hmps::Touch<D>& touch) {
    ++touches;
    EXPECT_EQ(touch.pair, pair);
    const bool block = std::find(pile.block.all.begin(), pile.block.all.end(), touch.slave) != pile.block.all.end();
    EXPECT_EQ(touch.slave_is_first, !block) << "the block is the second of the pair and stands on the first";
    EXPECT_NEAR(touch.normal.norm(), 1, 1e-6);
    EXPECT_GT(touch.normal[D - 1] * (block ? 1 : -1), 0) << "from the wall to the slave";
    const double normal = touch.force.dot(touch.normal);
    // k = 0.3 rho / dt^2; friction never exceeds its limit. Rounding of single precision.
    EXPECT_NEAR(normal, 0.3 * 1000 / (dt * dt) * touch.penetration * volume, 1e-5 * normal);
    EXPECT_LE((touch.force - normal * touch.normal).norm(), 0.3 * normal * (1 + 1e-5));
    on_first += (touch.slave_is_first ? 1. : -1.) * touch.force;
  });
  EXPECT_EQ(touches, report.contacts);
  EXPECT_LT((on_first - contact.force_on_first(pair)).norm(), 1e-12 * up * volume);
  // Reactions act at the masters' centres, so the torque need not vanish; the rest is recorded as its arm in spacings.
  if constexpr (D == 3) {
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < pile.x.size(); ++i)
      torque += pile.x[i].template cast<double>().cross(pile.f[i].template cast<double>());
    this->RecordProperty("torque_arm_in_spacings", std::to_string(torque.norm() / pile.magnitude() / 1e-3));
    EXPECT_LT(torque.norm() / pile.magnitude(), 1e-3);
  }
}

TYPED_TEST(ContactTest, AddsToTheForcesThatAreThere) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  bodies::Pile<S, D> pile(0.9);
  MetaballContact<S, D, typename TypeParam::Ball> contact(with_friction);
  pile.declare(contact);
  pile.apply(contact, dt);
  const auto once = pile.f;
  for (auto& f : pile.f) f.setConstant(S(1e6));
  contact.add(hmps::vectors(pile.x), hmps::vectors(pile.v), hmps::matrices(pile.F), hmps::vectors(pile.f), dt,
              bodies::Loops{});
  const S biggest = pile.magnitude();
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_LE((pile.f[i] - once[i] - bodies::Scene<S, D>::Point::Constant(S(1e6))).norm(),
              S(4) * std::numeric_limits<S>::epsilon() * biggest);
}

TYPED_TEST(ContactTest, DoesNotCareWhichBodyComesFirst) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  bodies::Pile<S, D> pile(0.9);
  pile.shake(S(0.05), S(0.03), 3);
  MetaballContact<S, D, typename TypeParam::Ball> one(with_friction), other(with_friction);
  pile.declare(one);
  const auto b =
      other.add_organ({.name = "block", .slaves = pile.block.bottom, .masters = pile.block.lower, .prescribed = {}});
  const auto a =
      other.add_organ({.name = "plate", .slaves = pile.plate.top, .masters = pile.plate.upper, .prescribed = {}});
  other.add_pair(b, a);
  pile.apply(one, dt);
  const auto first = pile.f;
  pile.apply(other, dt);
  const S biggest = pile.magnitude();
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_LE((first[i] - pile.f[i]).norm(), S(10) * std::numeric_limits<S>::epsilon() * biggest);
}

TYPED_TEST(ContactTest, FarBodiesCostNothingAndChangeNothing) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  bodies::Pile<S, D> pile(20);
  MetaballContact<S, D, typename TypeParam::Ball> contact(with_friction);
  pile.declare(contact);
  std::size_t loops = 0;
  for (int step = 0; step < 50; ++step) {
    const auto report = pile.apply(contact, dt, {.count = &loops});
    EXPECT_EQ(report.contacts, 0U);
    EXPECT_EQ(report.candidates, 0U);
    EXPECT_EQ(report.rebuilds, 1U);
  }
  // The first call looks at the bodies; each of the others runs a single loop, over no masters at all.
  EXPECT_LE(loops, 50U + 5U);
  EXPECT_EQ(pile.magnitude(), S(0));
}

/// The relative slip velocity of two sheets of free particles after one step of sticking, from 0.02 m/s before it: in
/// the middle, where the edges of the sheets have no influence.
template <class Friction>
double slip_after_one_step(int layers) {
  bodies::Scene<double, 3> scene;
  const hmps::Vector<int, 3> counts(13, 13, layers);
  const double l0 = 1e-3, l = l0 * layers;
  const auto below = scene.add(counts, {0, 0, 0}, l0);
  const auto above = scene.add(counts, {0, 0, l - 0.1 * l0}, l0);
  for (const Index i : above.all) scene.v[i][0] = 0.02;
  MetaballContact<double, 3, PaperMetaball, Friction> contact({.spacing = l0, .density = 1000, .friction = 100});
  const auto a = contact.add_organ({.name = "below", .slaves = below.top, .masters = below.upper, .prescribed = {}});
  const auto b = contact.add_organ({.name = "above", .slaves = above.bottom, .masters = above.lower, .prescribed = {}});
  contact.add_pair(a, b);
  const auto report = scene.apply(contact, dt);
  EXPECT_EQ(report.sticking, report.contacts);
  EXPECT_GE(report.contacts, 200U);
  for (std::size_t i = 0; i < scene.x.size(); ++i) scene.v[i] += scene.f[i] * dt / 1000;
  // The slave in the exact middle and the wall that it sees.
  const Index slave = above.bottom[6 * 13 + 6];
  hmps::Vector<double, 3> sum = hmps::Vector<double, 3>::Zero();
  double C = 0;
  for (const Index j : below.upper) {
    const double s = (scene.x[j] - scene.x[slave]).squaredNorm() / std::pow(1.75 * l0, 2);
    if (s >= 1) continue;
    sum += PaperMetaball::value(s) * scene.v[j];
    C += PaperMetaball::value(s);
  }
  return (scene.v[slave] - sum / C)[0];
}

TEST(Stick, CorrectedFrictionStopsSheetsAndThePapersReversesThem) {
  // All slaves of a single layer slide alike, so the slip stops exactly. With two layers, the wall's inner layer is
  // accelerated less, and a remainder of the right sign is left.
  EXPECT_NEAR(slip_after_one_step<CorrectedFriction>(1), 0, 1e-12);
  EXPECT_NEAR(slip_after_one_step<CorrectedFriction>(2), 0, 0.1 * 0.02);
  EXPECT_NEAR(slip_after_one_step<PaperFriction>(1), -0.060, 1e-12);
  EXPECT_LT(slip_after_one_step<PaperFriction>(2), -0.02);
}

TEST(Stick, StopsEverySlaveOnAPrescribedWallInOneStep) {
  bodies::Pile<double, 3> pile(0.9);
  for (const Index i : pile.block.all) pile.v[i][0] = 0.02;
  const auto forces = [&](double mu) {
    MetaballContact<double, 3, SmoothMetaball, CorrectedFriction> contact(
        {.spacing = 1e-3, .density = 1000, .friction = mu});
    pile.declare(contact, {.roles = hmps::Roles::only_second_is_slave, .excluded_slaves = {}, .excluded = {}}, true);
    const auto report = pile.apply(contact, dt);
    EXPECT_EQ(report.contacts, pile.block.bottom.size());
    EXPECT_EQ(report.sticking, mu > 0 ? report.contacts : 0U);
    return pile.f;
  };
  const auto with = forces(100), without = forces(0);
  // Friction alone leaves the part of the velocity along the normal.
  for (const Index i : pile.block.bottom) {
    const hmps::Vector<double, 3> n = without[i].normalized(), left = pile.v[i] + (with[i] - without[i]) * dt / 1000;
    EXPECT_LT((left - pile.v[i].dot(n) * n).norm(), 1e-12);
  }
}

TEST(Friction, IsTheCoefficientTimesTheNormalForceWhereItSlides) {
  bodies::Pile<double, 3> pile(0.9);
  for (const Index i : pile.block.all) pile.v[i][0] = 5;
  double drag[2];
  for (const double mu : {0., 0.2}) {
    MetaballContact<double, 3> contact({.spacing = 1e-3, .density = 1000, .friction = mu});
    pile.declare(contact);
    const auto report = pile.apply(contact, dt);
    EXPECT_EQ(report.sticking, 0U);
    hmps::Vector<double, 3> on_block = hmps::Vector<double, 3>::Zero();
    for (const Index i : pile.block.all) on_block += pile.f[i];
    drag[mu > 0] = -on_block[0] / on_block[2];
  }
  // Frictionless drag is the tilt of the normals: at most 0.012 at this height on an endless wall. The block's edges
  // tilt the normals that the plate's slaves see.
  EXPECT_NEAR(drag[0], 0, 0.1);
  EXPECT_NEAR(drag[1] - drag[0], 0.2, 0.02);
}

// Earlier, the force was zero where density times k exceeds the range of float, although there is no damping.
TEST(Damping, OfZeroNeedsNoProductOfDensityAndStiffness) {
  bodies::Pile<float, 3> pile(0.9F);
  const auto lift = [&](double scale) {
    MetaballContact<float, 3> contact(
        {.spacing = 1e-3, .density = 1000 * scale, .stiffness = hmps::PenaltyStiffness::fixed(3e12 * scale)});
    pile.declare(contact);
    pile.apply(contact, dt);
    double up = 0;
    for (const Index i : pile.block.all) up += static_cast<double>(pile.f[i][2]);
    return up / scale;
  };
  EXPECT_GT(lift(1), 0);
  EXPECT_NEAR(lift(1e13), lift(1), 1e-5 * lift(1));
}

TEST(Damping, OpposesTheClosingSpeedAndIsOffByDefault) {
  bodies::Pile<double, 3> pile(0.9);
  const auto lift = [&](double damping, double speed) {
    for (const Index i : pile.block.all) pile.v[i][2] = speed;
    MetaballContact<double, 3> contact({.spacing = 1e-3, .density = 1000, .damping = damping});
    pile.declare(contact);
    pile.apply(contact, dt);
    double up = 0;
    for (const Index i : pile.block.all) up += pile.f[i][2];
    return up;
  };
  EXPECT_EQ(lift(0, -0.1), lift(0, 0.1));
  EXPECT_GT(lift(0.1, -3), 1.05 * lift(0.1, 0));
  EXPECT_LT(lift(0.1, 3), 0.95 * lift(0.1, 0));
  EXPECT_GE(lift(0.1, 100), 0) << "contact must not pull";
  EXPECT_NEAR(lift(0.1, 0), lift(0, 0), 1e-9 * lift(0, 0));
}

TEST(Stretch, AMasterStretchedTwiceIsTouchedTwiceAsFarAway) {
  for (const double gap : {1.9, 2.1}) {
    bodies::Pile<double, 3> pile(gap);
    for (const Index i : pile.plate.all) pile.F[i] *= 2;
    for (const Index i : pile.block.all) pile.F[i] *= 2;
    // As if the spacing of block and plate were doubled: all lengths double.
    for (auto& x : pile.x) {
      x[0] *= 2;
      x[1] *= 2;
    }
    for (const Index i : pile.plate.all) pile.x[i][2] = 2 * (pile.x[i][2] - 2e-3);
    for (const Index i : pile.block.all) pile.x[i][2] = 2 * (pile.x[i][2] - (2 + gap) * 1e-3) + gap * 1e-3;
    MetaballContact<double, 3> contact(with_friction);
    pile.declare(contact);
    const auto report = pile.apply(contact, dt);
    if (gap < 2)
      EXPECT_GT(report.contacts, 10U);
    else
      EXPECT_EQ(report.contacts, 0U);
  }
}

TEST(Deep, ASlaveInsideAWallIsReportedAndNeverNaN) {
  for (const double gap : {0.3, 0., -0.5, -0.9, -1.5}) {
    bodies::Pile<double, 3> pile(gap);
    MetaballContact<double, 3> contact(with_friction);
    pile.declare(contact);
    const auto report = pile.apply(contact, dt);
    for (const auto& f : pile.f) EXPECT_TRUE(f.allFinite());
    EXPECT_GT(report.contacts, 10U);
    EXPECT_LE(report.penetration, 1.8e-3);
    if (gap > 0) {
      EXPECT_EQ(report.lost, 0U);
    }
    // Half way through the two layers of the wall, where the sum is flat.
    if (gap == -0.5) {
      EXPECT_GT(report.lost, 16U);
    }
  }
  // A wall of three layers saturates.
  bodies::Pile<double, 3> pile(-0.9);
  MetaballContact<double, 3, PaperMetaball> thick(with_friction);
  const auto p = thick.add_organ({.name = "plate", .slaves = {}, .masters = pile.plate.all, .prescribed = {}});
  const auto q = thick.add_organ({.name = "block", .slaves = pile.block.bottom, .masters = {}, .prescribed = {}});
  thick.add_pair(p, q, {.roles = hmps::Roles::only_second_is_slave, .excluded_slaves = {}, .excluded = {}});
  EXPECT_GT(pile.apply(thick, dt).lost, 8U);

  // The middle of a symmetric wall has no normal at all: no force, but a report.
  bodies::Scene<double, 3> scene;
  const auto wall = scene.add({7, 7, 3}, {0, 0, 0}, 1e-3);
  const auto lost = scene.add({1, 1, 1}, {3e-3, 3e-3, 1e-3}, 1e-3);
  MetaballContact<double, 3, PaperMetaball> contact(with_friction);
  const auto a = contact.add_organ({.name = "wall", .slaves = {}, .masters = wall.all, .prescribed = {}});
  const auto b = contact.add_organ({.name = "lost", .slaves = lost.all, .masters = {}, .prescribed = {}});
  contact.add_pair(a, b, {.roles = hmps::Roles::only_second_is_slave, .excluded_slaves = {}, .excluded = {}});
  const auto report = scene.apply(contact, dt);
  EXPECT_EQ(report.lost, 1U);
  EXPECT_EQ(scene.magnitude(), 0);
}

/// Three organs, pressed onto each other in both roles, move and deform: every force is that of the equations taken
/// literally, whichever lists it was found on.
template <class Ball, class Friction>
void compare_with_plain(int power, bool corrected, const std::function<double(Index)>& radius = {}) {
  using Scene = bodies::Scene<double, 3>;
  Scene scene;
  const double l0 = 1e-3;
  const auto plate = scene.add({9, 9, 3}, {0, 0, 0}, l0);
  const auto block = scene.add({5, 5, 4}, {1.9e-3, 2.2e-3, 3.05e-3}, l0);
  const auto lid = scene.add({6, 6, 2}, {1.4e-3, 1.1e-3, 7.1e-3}, l0);
  MetaballContact<double, 3, Ball, Friction> contact({.spacing = l0, .density = 1000, .friction = 0.1});
  plain::Contact literal{l0, 1000, 0.3 * 1000 / (dt * dt), 0.1, dt, Ball::radius, power, corrected, {}};
  if (radius) literal.slave_radius = radius;
  const auto part = [](const std::vector<Index>& list) { return std::vector<std::size_t>(list.begin(), list.end()); };
  const auto pair = [&](const auto& a, const auto& b) {
    contact.add_pair(contact.add_organ({.name = "a", .slaves = a.top, .masters = a.upper, .radius = radius}),
                     contact.add_organ({.name = "b", .slaves = b.bottom, .masters = b.lower, .radius = radius}));
    literal.sides.push_back({part(a.top), part(b.lower)});
    literal.sides.push_back({part(b.bottom), part(a.upper)});
  };
  pair(plate, block);
  pair(block, lid);
  scene.shake(0.3, 0.1, 9);
  const auto start = scene.x;
  const auto strain = scene.F;
  std::size_t contacts = 0, sticking = 0;
  for (int step = 0; step < 200; ++step) {
    const double phase = std::sin(3.14159265358979323846 * step / 200);
    for (std::size_t i = 0; i < start.size(); ++i) {
      scene.F[i] = Scene::Tensor::Identity() + (0.3 + phase) * (strain[i] - Scene::Tensor::Identity());
      const double down = i < plate.all.size() ? 0 : i < plate.all.size() + block.all.size() ? 0.15 : 0.35;
      scene.x[i] = start[i] + 0.05e-3 * phase * scene.v[i] / 0.3 + l0 * phase * Scene::Point(0.3, 0.1, -down);
    }
    const auto report = scene.apply(contact, dt);
    ASSERT_EQ(report.lost, 0U);
    if (step % 12 != 0) continue;
    const auto x = std::vector<plain::Vec>(scene.x.begin(), scene.x.end());
    const auto v = std::vector<plain::Vec>(scene.v.begin(), scene.v.end());
    const auto expected = literal(x, v, std::vector<plain::Mat>(scene.F.begin(), scene.F.end()));
    EXPECT_EQ(report.contacts, expected.contacts) << "step " << step;
    contacts += report.contacts;
    sticking += report.sticking;
    // Z^-1 is accurate to 1e-6 l0. This error is multiplied by a stretch of 1.2, by friction, and by all reactions on a
    // particle, a few times the force of one slave.
    for (std::size_t i = 0; i < scene.x.size(); ++i)
      EXPECT_LE((scene.f[i] - expected.f[i]).norm(), 6e-6 * l0 * literal.stiffness) << "step " << step << " of " << i;
  }
  EXPECT_GT(contacts, 300U);
  EXPECT_GT(sticking, 20U);
  EXPECT_LT(sticking, contacts - 20);
}

TEST(Plain, EveryForceIsThatOfTheEquationsTakenLiterally) {
  compare_with_plain<SmoothMetaball, CorrectedFriction>(3, true);
  compare_with_plain<SmoothMetaball, PaperFriction>(3, false);
  compare_with_plain<PaperMetaball, CorrectedFriction>(1, true);
  compare_with_plain<PaperMetaball, PaperFriction>(1, false);
}

TEST(Plain, EverySlaveHasTheRadiusOfItsOwn) {
  const auto radius = [](Index i) { return (0.4 + 0.1 * (i % 4)) * 1e-3; };
  compare_with_plain<SmoothMetaball, CorrectedFriction>(3, true, radius);
  compare_with_plain<PaperMetaball, PaperFriction>(1, false, radius);
}

/// The largest error of a force, over the largest force, of a pile that lies `distance` (m) from zero, computed in `S`
/// and compared with double at zero.
template <class S>
double error_far_away(double distance, bool through_far_away) {
  bodies::Pile<double, 3> pile(0.95, 2e-3);
  MetaballContact<double, 3> exact({.spacing = 2e-3, .density = 1000});
  pile.declare(exact);
  pile.apply(exact, dt);
  const auto expected = pile.f;
  double biggest = 0, error = 0;
  for (const auto& f : expected) biggest = std::max(biggest, f.norm());
  MetaballContact<S, 3> contact({.spacing = 2e-3, .density = 1000});
  pile.declare(contact);
  const hmps::Vector<double, 3> shift(distance, 0.5 * distance, -distance);
  // Either it lies there from the beginning, or it travels there after lists have been built at zero.
  if (through_far_away) pile.apply(contact, dt);
  for (auto& x : pile.x) x += shift;
  pile.apply(contact, dt);
  for (std::size_t i = 0; i < expected.size(); ++i) error = std::max(error, (pile.f[i] - expected[i]).norm() / biggest);
  return error;
}

TEST(Precision, FloatIsAsGoodFarFromZeroAsNearIt) {
  // Float resolves places ten spacings from the origin to 10 eps spacings; the penetration is 0.05 spacings. Double
  // adds the rounding of its numbers at `distance`, which are 2e-16 of it apart. Where the middle of all particles is
  // within about a thousand spacings of zero, as at 0.5 m, zero is the origin and places are resolved to 1e-4 spacings.
  const double near = 10 * static_cast<double>(std::numeric_limits<float>::epsilon()) / 0.05;
  for (const double distance : {0., 0.5, 10., 1000.}) {
    const double tolerance = distance == 0.5 ? 1e-4 / 0.05 : near + 2e-16 * distance / 1e-4;
    for (const bool travels : {false, true}) EXPECT_LE(error_far_away<float>(distance, travels), tolerance) << distance;
  }
}

TEST(Overload, UndeformedParticlesNeedNoGradients) {
  bodies::Pile<double, 3> pile(0.9);
  MetaballContact<double, 3> with(with_friction), without(with_friction);
  pile.declare(with);
  pile.declare(without);
  pile.apply(with, dt);
  const auto f = pile.f;
  pile.rest();
  without.add(hmps::vectors(pile.x), hmps::vectors(pile.v), hmps::vectors(pile.f), dt, bodies::Loops{});
  EXPECT_EQ(f, pile.f);
}

// Eq. (3): the same result as `add` followed by `hmps::kick`; prescribed particles follow no force.
TEST(Kick, IsWhatTheForcesGive) {
  bodies::Pile<double, 3> pile(0.9);
  pile.shake(0.05, 0.03, 5);
  MetaballContact<double, 3> forces(with_friction), kicks(with_friction);
  pile.declare(forces, {}, true);
  pile.declare(kicks, {}, true);
  std::vector<double> rho(pile.x.size());
  for (std::size_t i = 0; i < rho.size(); ++i) rho[i] = i % 2 ? 1000 : 1500;
  const auto report = pile.apply(forces, dt);
  auto expected = pile.v, v = pile.v;
  hmps::kick(hmps::vectors(expected), hmps::vectors(pile.f), hmps::scalars(rho), dt);
  for (const Index i : pile.plate.all) expected[i] = pile.v[i];
  EXPECT_NE(expected, pile.v);
  const auto seen = kicks.kick(hmps::vectors(pile.x), hmps::vectors(v), hmps::matrices(pile.F), hmps::scalars(rho), dt,
                               bodies::Loops{});
  EXPECT_EQ(seen.contacts, report.contacts);
  double gain = 0;
  for (std::size_t i = 0; i < v.size(); ++i) gain = std::max(gain, (expected[i] - pile.v[i]).norm());
  for (std::size_t i = 0; i < v.size(); ++i) EXPECT_LE((v[i] - expected[i]).norm(), 1e-15 + 1e-14 * gain);

  const auto before = v;
  for (auto& x : pile.x) x[2] *= 3;  // apart
  kicks.kick(hmps::vectors(pile.x), hmps::vectors(v), hmps::matrices(pile.F), 1000, dt);
  EXPECT_EQ(v, before);
  const bodies::Pile<double, 3> touching(0.9);
  EXPECT_THROW(kicks.kick(hmps::vectors(touching.x), hmps::vectors(v), hmps::matrices(pile.F), -1, dt),
               hmps::InputError);
  EXPECT_THROW(kicks.kick(hmps::vectors(touching.x), hmps::vectors(v), hmps::matrices(pile.F), 1000, 0),
               hmps::InputError);
}

// Particles of different volumes: with the mass of each over l0^3 as its density, contact conserves momentum.
TEST(Kick, ConservesTheMomentumOfUnlikeVolumes) {
  bodies::Pile<double, 3> pile(0.9);
  pile.shake(0.05, 0.03, 5);
  MetaballContact<double, 3> contact(with_friction);
  pile.declare(contact);
  scenes::Random random(3);
  std::vector<double> volumes(pile.x.size());
  for (double& own : volumes) own = std::pow(pile.l0, 3) * random(0.9, 1.6);
  const auto V = hmps::scalars(volumes);
  const double cube = std::pow(pile.l0, 3);
  auto v = pile.v;
  const auto seen = contact.kick(
      hmps::vectors(pile.x), hmps::vectors(v), hmps::matrices(pile.F),
      [&](const auto& at) { return 1200 * at(V) / cube; }, dt);
  ASSERT_GT(seen.contacts, 4U);
  const auto before = hmps::linear_momentum(hmps::vectors(pile.v), 1200, V),
             after = hmps::linear_momentum(hmps::vectors(v), 1200, V);
  double gain = 0;
  for (std::size_t i = 0; i < v.size(); ++i) gain = std::max(gain, 1200 * volumes[i] * (v[i] - pile.v[i]).norm());
  EXPECT_GT(gain, 0);
  EXPECT_LE((after - before).norm(), 1e-12 * gain + 1e-15 * before.norm());
}

/// A pile whose particles have volumes between 0.5 and 1.6 cells.
struct UnevenPile {
  bodies::Pile<double, 3> pile{0.9};
  std::vector<double> volumes;

  UnevenPile() {
    pile.shake(0.05, 0.03, 5);
    scenes::Random random(3);
    for (std::size_t i = 0; i < pile.x.size(); ++i) volumes.push_back(std::pow(pile.l0, 3) * random(0.5, 1.6));
  }
  template <class Contact>
  void declare(Contact& contact) const {
    const auto volume = [this](Index i) { return volumes[i]; };
    const auto below =
        contact.add_organ({.name = "plate", .slaves = pile.plate.top, .masters = pile.plate.upper, .volume = volume});
    contact.add_pair(
        below, contact.add_organ(
                   {.name = "block", .slaves = pile.block.bottom, .masters = pile.block.lower, .volume = volume}));
  }
};

TEST(Volumes, MakeTheForcesOfUnlikeParticlesSumToZero) {
  UnevenPile uneven;
  bodies::Pile<double, 3>& pile = uneven.pile;
  MetaballContact<double, 3> contact(with_friction), kicks(with_friction);
  uneven.declare(contact);
  uneven.declare(kicks);
  ASSERT_GT(pile.apply(contact, dt).contacts, 4U);
  hmps::Vector<double, 3> total = hmps::Vector<double, 3>::Zero(), on_block = total, touching = total;
  double size = 0;
  for (std::size_t i = 0; i < pile.f.size(); ++i) {
    total += uneven.volumes[i] * pile.f[i];
    size += uneven.volumes[i] * pile.f[i].norm();
  }
  for (const Index i : pile.block.all) on_block += uneven.volumes[i] * pile.f[i];
  EXPECT_LT(total.norm(), 1e-14 * size);
  EXPECT_LT((on_block + contact.force_on_first(0)).norm(), 1e-14 * size);
  contact.for_each_touch(
      [&](const hmps::Touch<3>& touch) { touching += touch.slave_is_first ? touch.force : -touch.force; });
  EXPECT_LT((touching - contact.force_on_first(0)).norm(), 1e-14 * size);
  auto v = pile.v;
  kicks.kick(hmps::vectors(pile.x), hmps::vectors(v), hmps::matrices(pile.F), 1000, dt);
  hmps::kick(hmps::vectors(pile.v), hmps::vectors(pile.f), 1000, dt);
  EXPECT_EQ(v, pile.v);
}

TEST(Volumes, LeaveNoSlipWhereUnlikeParticlesStick) {
  // The upper sheet is as light as the penalty permits. With the share of particles of one volume, its slip reverses.
  bodies::Scene<double, 3> scene;
  const hmps::Vector<int, 3> counts(13, 13, 1);
  const double l0 = 1e-3;
  const auto below = scene.add(counts, {0, 0, 0}, l0), above = scene.add(counts, {0, 0, 0.9 * l0}, l0);
  for (const Index i : above.all) scene.v[i][0] = 0.02;
  const std::size_t first = below.all.size();
  MetaballContact<double, 3, PaperMetaball, CorrectedFriction> contact(
      {.spacing = l0, .density = 1000, .friction = 100, .stiffness = hmps::PenaltyStiffness::ratio(0.05)});
  const auto volume = [&](Index i) { return (i < first ? 1 : 0.1) * l0 * l0 * l0; };
  contact.add_pair(
      contact.add_organ({.name = "below", .slaves = below.top, .masters = below.upper, .volume = volume}),
      contact.add_organ({.name = "above", .slaves = above.bottom, .masters = above.lower, .volume = volume}));
  scene.apply(contact, dt);
  const Index middle = 6 * 13 + 6;
  const auto slip = [&](Index i, Index j) {
    return (scene.v[i] - scene.v[j] + (scene.f[i] - scene.f[j]) * dt / 1000)[0];
  };
  EXPECT_NEAR(slip(above.all[middle], below.all[middle]), 0, 1e-12);
}

TEST(Volumes, AreThoseOfOneParticle) {
  MetaballContact<double, 3> contact(with_friction);
  const std::vector<Index> some{3, 4};
  const auto add = [&](double volume) {
    return message_of([&] {
      contact.add_organ({.name = "liver", .slaves = some, .masters = some, .volume = [=](Index) { return volume; }});
    });
  };
  for (const double wrong : {0.0, -1e-9, std::nan(""), 1.0, 1e-12})
    EXPECT_NE(add(wrong).find("particle 3 of organ 'liver' has a volume of "), std::string::npos) << wrong;
  EXPECT_TRUE(add(1e-9).empty());

  UnevenPile uneven;
  uneven.volumes[uneven.pile.block.bottom[7]] = 0.29e-9;
  MetaballContact<double, 3> stiff(with_friction), unlike(with_friction);  // k~ = 0.3
  uneven.declare(stiff);
  const std::string light = message_of([&] { uneven.pile.apply(stiff, dt); });
  EXPECT_NE(light.find("particle " + std::to_string(uneven.pile.block.bottom[7]) + " of 'block'"), std::string::npos)
      << light;
  EXPECT_NE(light.find("the volume 0.29"), std::string::npos) << light;

  uneven.volumes[uneven.pile.block.bottom[7]] = 1e-9;
  uneven.declare(unlike);
  unlike.add_pair(unlike.add_organ({.name = "other", .slaves = {}, .masters = uneven.pile.plate.bottom}),
                  unlike.add_organ({.name = "block again", .slaves = uneven.pile.block.bottom}),
                  {.roles = hmps::Roles::only_second_is_slave});
  const std::string two = message_of([&] { uneven.pile.apply(unlike, dt); });
  // Equal but for rounding, as l0^3 without a volume.
  const auto cell = [](Index) { return 0.7e-3 * 0.7e-3 * 0.7e-3; };
  hmps::detail::OrganPairs alike;
  alike.add_organ({.name = "one", .slaves = some, .volume = cell}, static_cast<double>(0.7e-3F));
  alike.add_organ({.name = "other", .slaves = some}, static_cast<double>(0.7e-3F));
  EXPECT_NO_THROW(alike.number_particles());
  EXPECT_NE(two.find("two organs give particle "), std::string::npos) << two;
}

TEST(Kick, RefusesWhatIsTooLightForThePenalty) {
  bodies::Pile<double, 3> pile(0.9);
  const auto x = hmps::vectors(pile.x), v = hmps::vectors(pile.v);
  const auto F = hmps::matrices(pile.F);
  std::vector<double> rho(pile.x.size(), 1000);
  const auto kick = [&](const auto& density, const hmps::PairSettings& pair, bool fixed_plate) {
    MetaballContact<double, 3> contact(with_friction);  // k~ = 0.3 at 1000 kg/m3
    pile.declare(contact, pair, fixed_plate);
    return message_of([&] { contact.kick(x, v, F, density, dt); });
  };
  EXPECT_TRUE(kick(hmps::scalars(rho), {}, false).empty());
  const Index light = pile.block.bottom[7];
  rho[light] = 100;
  const std::string text = kick(hmps::scalars(rho), {}, false);
  EXPECT_NE(text.find("particle " + std::to_string(light) + " of 'block'"), std::string::npos) << text;
  EXPECT_NE(text.find("= 3;"), std::string::npos) << text;
  EXPECT_TRUE(kick(hmps::scalars(rho), {.stiffness = hmps::PenaltyStiffness::ratio(0.09)}, false).empty());
  EXPECT_FALSE(kick(299, {}, false).empty());
  EXPECT_TRUE(kick(301, {}, false).empty());
  // Prescribed particles may have any density.
  rho.assign(rho.size(), 1000);
  for (const Index i : pile.plate.all) rho[i] = 1;
  EXPECT_FALSE(kick(hmps::scalars(rho), {}, false).empty());
  EXPECT_TRUE(kick(hmps::scalars(rho), {}, true).empty());
}

TEST(SharedParticles, AParticleInTwoOrgansGathersBothContacts) {
  // The left and the right half of the block are separate organs, each paired with its own organ of the plate's top.
  bodies::Pile<double, 3> pile(0.9);
  std::vector<Index> left, right, left_wall, right_wall;
  const auto is_left = [&](Index i) { return pile.x[i][0] < 4.5e-3; };
  for (const Index i : pile.block.bottom) (is_left(i) ? left : right).push_back(i);
  for (const Index i : pile.block.lower) (is_left(i) ? left_wall : right_wall).push_back(i);
  ASSERT_FALSE(left.empty());
  ASSERT_FALSE(right.empty());
  const auto forces = [&](bool with_left, bool with_right) {
    MetaballContact<double, 3> contact(with_friction);
    const auto pair = [&](const std::vector<Index>& slaves, const std::vector<Index>& masters) {
      const auto a =
          contact.add_organ({.name = "plate", .slaves = pile.plate.top, .masters = pile.plate.upper, .prescribed = {}});
      contact.add_pair(a, contact.add_organ({.name = "half", .slaves = slaves, .masters = masters, .prescribed = {}}));
    };
    if (with_left) pair(left, left_wall);
    if (with_right) pair(right, right_wall);
    pile.apply(contact, dt);
    return pile.f;
  };
  const auto both = forces(true, true), one = forces(true, false), other = forces(false, true);
  // Friction aside (nothing slides), forces add up.
  for (std::size_t i = 0; i < both.size(); ++i)
    EXPECT_LE((one[i] + other[i] - both[i]).norm(), 1e-9 * pile.magnitude());
}

TEST(SharedParticles, NothingIsPushedTwiceByTheSame) {
  const bodies::Pile<double, 3> pile(0.9);
  const auto& [bottom, top, all, lower, upper] = pile.block;
  struct Made {
    MetaballContact<double, 3> contact{with_friction};
    std::size_t plate, block;
  };
  const auto make = [&] {
    Made made{.plate = 0, .block = 0};
    made.plate = made.contact.add_organ(
        {.name = "plate", .slaves = pile.plate.top, .masters = pile.plate.upper, .prescribed = {}});
    made.block = made.contact.add_organ(
        {.name = "block", .slaves = pile.block.bottom, .masters = pile.block.lower, .prescribed = {}});
    made.contact.add_pair(made.plate, made.block);
    return made;
  };
  Made made = make();
  const std::string again = message_of([&] { made.contact.add_pair(made.plate, made.block); });
  EXPECT_NE(again.find("'plate' and 'block' are already contact pair 0"), std::string::npos) << again;
  EXPECT_FALSE(message_of([&] { made.contact.add_pair(made.block, made.plate); }).empty()) << "reversed";

  const auto twin = made.contact.add_organ({.name = "twin", .slaves = bottom, .masters = lower, .prescribed = {}});
  const std::string twice = message_of([&] { made.contact.add_pair(made.plate, twin); });
  EXPECT_NE(twice.find("'twin'"), std::string::npos) << twice;
  EXPECT_NE(twice.find(std::to_string(pile.plate.top.front())), std::string::npos) << twice;
  EXPECT_FALSE(message_of([&] { made.contact.add_pair(twin, made.plate); }).empty()) << "reversed";

  // One of the two roles is enough: slaves that the block has too, at the plate's masters.
  const auto skin = made.contact.add_organ({.name = "skin", .slaves = bottom, .masters = {}, .prescribed = {}});
  const hmps::PairSettings second{.roles = hmps::Roles::only_second_is_slave};
  EXPECT_FALSE(message_of([&] { made.contact.add_pair(made.plate, skin, second); }).empty());
  // The refused pairs have left nothing behind.
  bodies::Pile<double, 3> expected = pile, seen = pile;
  Made fresh = make();
  expected.apply(fresh.contact, dt);
  seen.apply(made.contact, dt);
  EXPECT_EQ(expected.f, seen.f);

  // No slave meets the same master twice: slaves are shared but masters are not, or the shared ones are excluded.
  const auto lid = made.contact.add_organ({.name = "lid", .slaves = top, .masters = pile.plate.bottom});
  const auto other = made.contact.add_organ({.name = "other", .slaves = bottom, .masters = lower});
  EXPECT_NO_THROW(made.contact.add_pair(lid, other, second));
  std::vector<Index> both_faces(bottom);
  both_faces.insert(both_faces.end(), top.begin(), top.end());
  const auto faces = made.contact.add_organ({.name = "faces", .slaves = both_faces, .masters = {}});
  EXPECT_NO_THROW(made.contact.add_pair(made.plate, faces,
                                        {.roles = hmps::Roles::only_second_is_slave, .excluded_slaves = bottom}));
  const hmps::PairSettings all_excluded{.roles = hmps::Roles::only_second_is_slave, .excluded_slaves = bottom};
  EXPECT_FALSE(message_of([&] { made.contact.add_pair(made.plate, skin, all_excluded); }).empty())
      << "nothing could touch";
  const auto rest = made.contact.add_organ({.name = "rest", .slaves = bottom, .masters = {}});
  EXPECT_NO_THROW(made.contact.add_pair(
      made.plate, rest, {.roles = hmps::Roles::only_second_is_slave, .excluded = [](Index, Index) { return true; }}));
}

TEST(Pairs, MayHaveFrictionAndStiffnessOfTheirOwn) {
  // Two blocks on one plate, which is pulled away.
  bodies::Scene<double, 3> scene;
  const auto plate = scene.add({14, 6, 2}, {0, 0, 0}, 1e-3);
  const auto left = scene.add({4, 4, 2}, {1.1e-3, 1.2e-3, 1.9e-3}, 1e-3);
  const auto right = scene.add({4, 4, 2}, {8.1e-3, 1.2e-3, 1.9e-3}, 1e-3);
  for (const Index i : plate.all) scene.v[i][1] = 1;
  const auto forces = [&](const hmps::ContactSettings& all, const hmps::PairSettings& of_left,
                          const hmps::PairSettings& of_right) {
    MetaballContact<double, 3> contact(all);
    const auto a = contact.add_organ({.name = "plate", .slaves = plate.top, .masters = plate.upper, .prescribed = {}});
    const auto pair = [&](const auto& block, const hmps::PairSettings& own) {
      contact.add_pair(
          a, contact.add_organ({.name = "block", .slaves = block.bottom, .masters = block.lower, .prescribed = {}}),
          own);
    };
    pair(left, of_left);
    pair(right, of_right);
    scene.apply(contact, dt);
    std::vector<std::vector<hmps::Vector<double, 3>>> of_blocks(2);
    for (const Index i : left.all) of_blocks[0].push_back(scene.f[i]);
    for (const Index i : right.all) of_blocks[1].push_back(scene.f[i]);
    return of_blocks;
  };
  auto smooth = with_friction, rough = with_friction;
  smooth.friction = 0;
  const auto none = forces(smooth, {}, {}), full = forces(rough, {}, {});
  EXPECT_NE(none[0], full[0]);
  for (const auto& mixed : {forces(smooth, {}, {.friction = 0.3}), forces(rough, {.friction = 0}, {})}) {
    EXPECT_EQ(mixed[0], none[0]);
    EXPECT_EQ(mixed[1], full[1]);
  }
  auto soft = with_friction;
  soft.stiffness = hmps::PenaltyStiffness::ratio(0.1);
  const auto softer = forces(soft, {}, {});
  EXPECT_NE(softer[0], full[0]);
  const auto mixed = forces(rough, {.stiffness = hmps::PenaltyStiffness::ratio(0.1)}, {});
  EXPECT_EQ(mixed[0], softer[0]);
  EXPECT_EQ(mixed[1], full[1]);
  EXPECT_THROW(forces(rough, {.friction = -0.1}, {}), hmps::InputError);
  EXPECT_THROW(forces(rough, {.friction = std::numeric_limits<double>::quiet_NaN()}, {}), hmps::InputError);
  EXPECT_THROW(forces(rough, {.friction = 30}, {}), hmps::InputError) << "per cent";
  EXPECT_EQ(forces(rough, {.friction = std::numeric_limits<double>::infinity()}, {}),
            forces(rough, {.friction = 1e6}, {}));
}

TEST(Door, RefusesOrgansOfWhichNoneMayTouch) {
  bodies::Pile<double, 3> pile(0.9);
  MetaballContact<double, 3> contact(with_friction);
  contact.add_organ({.name = "plate", .slaves = pile.plate.top, .masters = pile.plate.upper, .prescribed = {}});
  EXPECT_NO_THROW(pile.apply(contact, dt)) << "one organ, to which others may be added";
  contact.add_organ({.name = "block", .slaves = pile.block.bottom, .masters = pile.block.lower, .prescribed = {}});
  const std::string said = message_of([&] { pile.apply(contact, dt); });
  EXPECT_NE(said.find("2 organs but no pair"), std::string::npos) << said;
}

TEST(Door, RefusesASpacingFarBelowThatOfTheParticles) {
  for (const double factor : {1e-3, 0.3, 0.7}) {
    bodies::Pile<double, 3> pile(0.9);
    hmps::ContactSettings settings = with_friction;
    settings.spacing *= factor;
    MetaballContact<double, 3> contact(settings);
    pile.declare(contact);
    const std::string said = message_of([&] { pile.apply(contact, dt); });
    if (factor < 0.4)  // within 2.5 spacings there is no other
      EXPECT_NE(said.find("particles of 'plate'"), std::string::npos) << factor << said;
    else
      EXPECT_EQ(said.find("form no wall"), std::string::npos) << factor << said;
  }
}

TEST(Door, RefusesBadInput) {
  using Contact = MetaballContact<double, 3>;
  const auto refuse = [](hmps::ContactSettings settings) { EXPECT_THROW(Contact{settings}, hmps::InputError); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuse({.spacing = 0, .density = 1000});
  refuse({.spacing = nan, .density = 1000});
  refuse({.spacing = 1e-3, .density = 0});
  refuse({.spacing = 1e-3, .density = 1000, .friction = -0.1});
  refuse({.spacing = 1e-3, .density = 1000, .friction = nan});
  refuse({.spacing = 1e-3, .density = 1000, .damping = -1});
  refuse({.spacing = 1e-3, .density = 1000, .damping = 30});  // per cent
  refuse({.spacing = 1e-3, .density = 1000, .margin = 0});
  refuse({.spacing = 1e-3, .density = 1000, .margin = 500});  // micrometres

  bodies::Pile<double, 3> pile(0.9);
  Contact contact(with_friction);
  const std::vector<Index> some{1, 2}, overlap{2, 3}, outside{100000};
  EXPECT_THROW(contact.add_organ({.name = "empty", .slaves = {}, .masters = {}, .prescribed = {}}), hmps::InputError);
  const auto a = contact.add_organ({.name = "a", .slaves = some, .masters = some, .prescribed = {}});
  const auto b = contact.add_organ({.name = "b", .slaves = overlap, .masters = overlap, .prescribed = {}});
  const auto c = contact.add_organ({.name = "c", .slaves = pile.block.bottom, .masters = {}, .prescribed = {}});
  EXPECT_THROW(contact.set_friction(30), hmps::InputError) << "per cent";
  EXPECT_NO_THROW(contact.set_friction(std::numeric_limits<double>::infinity())) << "sticks";
  EXPECT_THROW(contact.add_pair(a, b), hmps::InputError) << "particle 2 is in both";
  EXPECT_THROW(contact.add_pair(a, a), hmps::InputError);
  EXPECT_THROW(contact.add_pair(a, 7), hmps::InputError);
  EXPECT_THROW((void)contact.force_on_first(0), hmps::InputError) << "there is no pair yet";
  EXPECT_THROW(contact.add_pair(a, c), hmps::InputError) << "c has no masters";

  Contact good(with_friction);
  pile.declare(good);
  auto few = pile.v;
  few.pop_back();
  EXPECT_THROW(good.add(hmps::vectors(pile.x), hmps::vectors(few), hmps::vectors(pile.f), dt), hmps::InputError);
  EXPECT_THROW(pile.apply(good, 0.), hmps::InputError);
  EXPECT_THROW(pile.apply(good, nan), hmps::InputError);
  Contact beyond(with_friction);
  beyond.add_organ({.name = "outside", .slaves = outside, .masters = outside, .prescribed = {}});
  EXPECT_THROW(pile.apply(beyond, dt), hmps::InputError);
  Contact stiff({.spacing = 1e-3, .density = 1000, .stiffness = hmps::PenaltyStiffness::fixed(3e12)});
  pile.declare(stiff);
  EXPECT_THROW(pile.apply(stiff, 2e-5), hmps::InputError);
}

/// With a ratio given as the coefficient, walls do not push.
TEST(Door, RefusesAPenaltyOfNothing) {
  bodies::Pile<double, 3> pile(0.9);
  MetaballContact<double, 3> contact(
      {.spacing = 1e-3, .density = 1000, .stiffness = hmps::PenaltyStiffness::fixed(0.3)});
  pile.declare(contact);
  EXPECT_NE(message_of([&] { pile.apply(contact, dt); }).find("PenaltyStiffness::ratio"), std::string::npos);
}

/// A ratio that gives next to no coefficient, such as with a density in other units.
TEST(Door, NamesDensityAndStepIfARatioGivesNoPenalty) {
  bodies::Pile<double, 3> pile(0.9);
  MetaballContact<double, 3> contact(
      {.spacing = 1e-3, .density = 1e-15, .stiffness = hmps::PenaltyStiffness::ratio(0.3)});
  pile.declare(contact);
  EXPECT_NE(message_of([&] { pile.apply(contact, dt); }).find("check the density, the step"), std::string::npos);
}

/// A step so short that k overflows is not a matter of the particles' density.
TEST(Door, NamesTheStepIfItMakesThePenaltyOverflow) {
  bodies::Pile<double, 3> pile(0.9);
  MetaballContact<double, 3> contact(
      {.spacing = 1e-3, .density = 1000, .stiffness = hmps::PenaltyStiffness::ratio(0.3)});
  pile.declare(contact);
  EXPECT_NE(message_of([&] { pile.apply(contact, 1e-200); }).find("at a step of 1e-200 s"), std::string::npos);
}

/// A report refers to organs by number.
TEST(Door, RefusesTheReportOfAnotherContact) {
  const MetaballContact<double, 3> contact({.spacing = 1e-3, .density = 1000});
  hmps::ContactReport<double> report;
  report.lost = 1;
  report.lost_in = 5;
  EXPECT_THROW(contact.check(report), hmps::InputError);
}

}  // namespace contact_test
