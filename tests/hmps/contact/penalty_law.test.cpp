// SPDX-License-Identifier: MIT
// Contact with a user-defined penalty law.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/message_of.hpp"
#include "bodies.hpp"
#include "hmps/analysis/stable_step.hpp"
#include "hmps/contact/contact.hpp"

namespace penalty_law_test {

using hmps::Index;
using hmps_test::message_of;
using Point = hmps::Vector<double, 2>;

constexpr double l0 = 1e-3, density = 1000;

/// Any law, as functions of s = p / l0: the force over k l0, and its largest slope over k. A single type, compiled
/// once.
struct Law {
  std::function<double(double)> shape, slope;
  [[nodiscard]] double force(double k, double p, double spacing) const { return k * spacing * shape(p / spacing); }
  [[nodiscard]] double largest_stiffness(double k, double p, double spacing) const { return k * slope(p / spacing); }
};
using Contact = hmps::MetaballContact<double, 2, hmps::SmoothMetaball, hmps::CorrectedFriction, Law>;

const Law linear{[](double s) { return s; }, [](double) { return 1.; }};
const Law hertz{[](double s) { return s * std::sqrt(s); }, [](double s) { return 1.5 * std::sqrt(s); }};

hmps::ContactSettings fixed(double k) {
  return {.spacing = l0, .density = density, .stiffness = hmps::PenaltyStiffness::fixed(k)};
}

TEST(PenaltyLaw, GivesTheForceOnEachSlave) {
  constexpr double dt = 1e-5;
  bodies::Pile<double, 2> pile(0.8);
  pile.shake(0.05, 0.03, 2);
  for (const double ratio : {0.3, 0.1}) {  // set for all pairs, set for this pair
    Contact contact({.spacing = l0, .density = density}, hertz);
    pile.declare(contact, ratio == 0.3 ? hmps::PairSettings{}
                                       : hmps::PairSettings{.stiffness = hmps::PenaltyStiffness::ratio(ratio)});
    const auto report = pile.apply(contact, dt);
    EXPECT_GT(report.contacts, 4U);
    const double k = ratio * density / (dt * dt);
    contact.for_each_touch([&](const hmps::Touch<2>& touch) {
      const double s = touch.penetration / l0, expected = k * l0 * s * std::sqrt(s) * l0 * l0;
      EXPECT_NEAR((touch.force - expected * touch.normal).norm(), 0, 1e-13 * expected);
    });
    EXPECT_NEAR(pile.total().norm(), 0, 1e-14 * pile.magnitude());
  }
}

/// A stone, one particle above one of a flat fixed wall.
struct Stone : bodies::Scene<double, 2> {
  Box wall;
  Index stone;
  /// The stone lies `depth` (in spacings) below the place one spacing above the wall, where it just touches.
  explicit Stone(double depth = 0) : wall(add({9, 4}, Point::Zero(), l0)) {
    stone = add({1, 1}, Point(4, 4 - depth) * l0, l0).all[0];
  }
  [[nodiscard]] Contact contact(const hmps::ContactSettings& settings, const Law& law) const {
    Contact made(settings, law);
    const auto above = made.add_organ({.name = "stone", .slaves = {stone}, .masters = {}, .prescribed = {}});
    const auto below =
        made.add_organ({.name = "wall", .slaves = {}, .masters = wall.all, .prescribed = [](Index) { return true; }});
    made.add_pair(above, below, {.roles = hmps::Roles::only_first_is_slave});
    return made;
  }
  [[nodiscard]] double penetration() {
    auto soft = contact(fixed(1), linear);
    return apply(soft, 1e-5).penetration;
  }
};

/// The wall gives back the energy that it takes, and the energy that it holds at the deepest place is the integral of
/// the force. The energy that symplectic Euler conserves differs from the true one only while there is a force, so that
/// the speed after n steps in contact is wrong by O(1 / n^2). The distance of (29) is a mean over the places along the
/// wall; above a particle it errs by a few thousandths of the motion.
TEST(PenaltyLaw, GivesBackTheEnergyOfAThrownParticle) {
  constexpr double k = 1e11, speed = 2, dt = 2.5e-6;
  Stone scene(-0.02);
  auto contact = scene.contact(fixed(k), hertz);
  scene.v[scene.stone] = {0, -speed};
  double deepest = 0;
  int steps = 0;
  do {
    const auto report = scene.apply(contact, dt);
    deepest = std::max(deepest, report.penetration);
    steps += report.contacts > 0;
    scene.v[scene.stone] += dt / density * scene.f[scene.stone];
    scene.x[scene.stone] += dt * scene.v[scene.stone];
  } while (scene.x[scene.stone][1] < 4.03 * l0);
  EXPECT_GT(steps, 150);
  EXPECT_NEAR(scene.v[scene.stone][1], speed, speed / (150. * 150));
  // rho v^2 / 2 = k l0^2 (p / l0)^2.5 / 2.5
  const double expected = l0 * std::pow(1.25 * density * speed * speed / (k * l0 * l0), 0.4);
  EXPECT_NEAR(deepest, expected, 0.01 * expected);
}

TEST(PenaltyLaw, RefusesADepthAtWhichItIsTooStiff) {
  constexpr double dt = 1e-5;
  Stone scene(0.2);
  const double p = scene.penetration(), limit = density / (dt * dt) / (1.5 * std::sqrt(p / l0));
  EXPECT_GT(p, 0.1 * l0);
  EXPECT_GT(limit, density / (dt * dt)) << "k itself may be beyond the limit of the linear law";
  auto good = scene.contact(fixed(0.999 * limit), hertz), bad = scene.contact(fixed(1.001 * limit), hertz);
  scene.apply(good, dt);
  EXPECT_GT(scene.f[scene.stone][1], 0);
  const std::string text = message_of<hmps::StateError>([&] { scene.apply(bad, dt); });
  EXPECT_NE(text.find("particle " + std::to_string(scene.stone) + " of 'stone'"), std::string::npos) << text;
  EXPECT_NE(text.find("wall of 'wall'"), std::string::npos) << text;
  EXPECT_NE(text.find("k~ = 1.001"), std::string::npos) << text;
  EXPECT_EQ(scene.magnitude(), 0) << "no force is added before the error";
  EXPECT_NO_THROW(scene.apply(bad, 0.99 * dt)) << "a shorter step is the remedy";
  // The linear law written as a user-defined one.
  auto stiff = scene.contact(fixed(1.001 * density / (dt * dt)), linear);
  EXPECT_THROW(scene.apply(stiff, dt), hmps::StateError);
}

/// For a light particle, the stiffness of the law at its penetration counts.
TEST(PenaltyLaw, RefusesWhatIsTooLightForItsStiffness) {
  constexpr double dt = 1e-5, k = 0.3 * density / (dt * dt);
  Stone scene(0.2);
  const double least = 0.3 * density * 1.5 * std::sqrt(scene.penetration() / l0);
  auto contact = scene.contact(fixed(k), hertz);
  std::vector<double> rho(scene.x.size(), 1);  // the wall is prescribed
  const auto kick = [&](double of_stone) {
    rho[scene.stone] = of_stone;
    return message_of([&] {
      contact.kick(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::matrices(scene.F), hmps::scalars(rho), dt);
    });
  };
  EXPECT_EQ(kick(1.001 * least), "");
  EXPECT_NE(kick(0.999 * least).find("of 'stone' has the density"), std::string::npos);
  scene.x[scene.stone][1] += l0;  // out of reach
  EXPECT_EQ(kick(0.5 * least), "");
}

/// `stable_step` sees the slope of the law at the penetration: the step is that of a linear law with this stiffness.
TEST(PenaltyLaw, HasTheStableStepOfItsSlope) {
  constexpr double k = 1e11;
  Stone scene(0.2);
  const double slope = k * 1.5 * std::sqrt(scene.penetration() / l0);
  const auto limit = [&](double coefficient, const Law& law) {
    auto contact = scene.contact(fixed(coefficient), law);
    const auto force = [&](const auto& x, const auto& v, const auto& f) {
      contact.add(x, v, hmps::matrices(std::as_const(scene.F)), f, 1e-6);
    };
    return hmps::stable_step(
               force, hmps::vectors(scene.x), hmps::vectors(scene.v), density,
               {.spacing = l0, .tolerance = 1e-3, .moves = [&](std::size_t i) { return i == scene.stone; }})
        .limit;
  };
  const double own = limit(k, hertz), same = limit(slope, linear);
  EXPECT_NEAR(own, same, 1e-5 * same) << "the quotient errs by the square of the residual";
  EXPECT_NEAR(own, 2 * std::sqrt(density / slope), 0.01 * own) << "2 / omega of one mode";
  EXPECT_GT(std::abs(own - limit(k, linear)), 0.1 * same) << "and not that of k";
}

TEST(PenaltyLaw, RefusesALawThatContradictsItself) {
  constexpr double dt = 1e-5, infinity = std::numeric_limits<double>::infinity();
  Stone scene(0.2);
  const double s = scene.penetration() / l0;
  const auto refused = [&](double force, double stiffness) {
    auto contact = scene.contact(fixed(0.1 * density / (dt * dt)),
                                 {[=](double) { return force; }, [=](double) { return stiffness; }});
    return !message_of([&] { scene.apply(contact, dt); }).empty();
  };
  EXPECT_FALSE(refused(s, 1));
  EXPECT_TRUE(refused(1.01 * s, 1)) << "a slope that is too small";
  EXPECT_TRUE(refused(-0.1 * s, 1)) << "a force that pulls";
  EXPECT_TRUE(refused(std::nan(""), 1));
  auto contact = scene.contact(fixed(0.1 * density / (dt * dt)), {hertz.shape, [](double) { return infinity; }});
  EXPECT_THROW(scene.apply(contact, dt), hmps::StateError);
}

}  // namespace penalty_law_test
