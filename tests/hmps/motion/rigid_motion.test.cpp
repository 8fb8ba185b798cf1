// SPDX-License-Identifier: MIT
#include "hmps/motion/rigid_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rigid_motion_test {

using hmps::Keyframes;
using hmps::Track;
using V = hmps::Vector<double, 3>;
using V2 = hmps::Vector<double, 2>;

TEST(RigidMotion, ConceptTakesPosesAndUserLambdasOnly) {
  static_assert(hmps::Motion<hmps::Fixed<3>, 3>);
  static_assert(hmps::Motion<hmps::Turn, 3>);
  static_assert(hmps::Motion<hmps::RigidMotion<2>, 2>);
  const auto stretch = [](double t) { return [t](const V& x) { return V((1 + t) * x); }; };
  static_assert(hmps::Motion<decltype(stretch), 3>);
  const auto number = [](double t) { return t; };
  static_assert(!hmps::Motion<decltype(number), 3>);
}

TEST(RigidMotion, TranslatesAndTurns) {
  const Keyframes<3> up{{0.0, {0, 0, 0}}, {1.0, {0, 0, 2}}};
  const Track turn{{0.0, 0.0}, {1.0, std::numbers::pi / 2}};
  EXPECT_EQ(hmps::Fixed<3>{}(0.3)(V(1, 2, 3)), V(1, 2, 3));
  EXPECT_LE((hmps::Translation<3>{up}(0.5)(V(1, 2, 3)) - V(1, 2, 4)).norm(), 1e-15);
  const hmps::Turn hinge{.pivot = V(1, 0, 0), .axis = V(0, 0, 5), .angle = turn};
  EXPECT_LE((hinge(1)(V(2, 0, 7)) - V(1, 1, 7)).norm(), 1e-15);
  const hmps::RigidMotion<2> plane{.pivot = V2(1, 0), .translation = {{0.0, {0, 0}}, {1.0, {0, 2}}}, .turn = turn};
  EXPECT_LE((plane(1)(V2(2, 0)) - V2(1, 3)).norm(), 1e-15);
}

TEST(RigidMotion, RateIsThatOfItsPoints) {
  const hmps::RigidMotion<3> motion{.pivot = V(0.1, 0.2, 0),
                                    .translation = {{0.0, {0, 0, 0}}, {0.4, {1, 0, 1}}, {1.0, {0, 3, 2}}},
                                    .turn = {{0.0, {0, 0, 0}}, {0.5, {0, 1, 0.5}}, {1.0, {2, 1, 0}}}};
  const hmps::RigidMotion<2> plane{
      .pivot = V2(1, 0), .translation = {{0.0, {0, 0}}, {1.0, {0, 2}}}, .turn = {{0.0, 0.0}, {1.0, 3.0}}};
  const double h = 1e-5;
  for (double t = 0.05; t < 1; t += 0.1) {
    const V x(1, -2, 0.5);
    // The error is of the order of h^2 times the third derivative, about 1e2.
    EXPECT_LE((velocity(motion(t), motion.rate(t), x) - (motion(t + h)(x) - motion(t - h)(x)) / (2 * h)).norm(), 1e-7);
    const V2 y(1, -2);
    const hmps::Turn hinge{.pivot = V(1, 0, 0), .axis = V(3, 0, 4), .angle = plane.turn};
    EXPECT_LE((velocity(hinge(t), hinge.rate(t), x) - (hinge(t + h)(x) - hinge(t - h)(x)) / (2 * h)).norm(), 1e-7);
    const hmps::Translation<3> along{motion.translation};
    EXPECT_LE((velocity(along(t), along.rate(t), x) - motion.translation.rate(t)).norm(), 1e-15);
    EXPECT_EQ(velocity(hmps::Fixed<3>()(t), hmps::Fixed<3>().rate(t), x), V(V::Zero()));
    EXPECT_LE((velocity(plane(t), plane.rate(t), y) - (plane(t + h)(y) - plane(t - h)(y)) / (2 * h)).norm(), 1e-7);
  }
}

TEST(RigidMotion, CarriedRegionsMoveWithinTheirCarrier) {
  const hmps::Turn carrier{.pivot = V(0, 0, 0), .axis = V(0, 0, 1), .angle = {{0.0, 0.0}, {1.0, std::numbers::pi / 2}}};
  const hmps::Translation<3> own{{{0.0, {0, 0, 0}}, {1.0, {1, 0, 0}}}};
  const auto both = hmps::carried(carrier, own);
  static_assert(hmps::Motion<decltype(both), 3>);
  // First one metre along the reference's x, then turned with the carrier.
  EXPECT_LE((both(1)(V(1, 0, 0)) - V(0, 2, 0)).norm(), 1e-15);
  const auto stretch = [](double t) { return [t](const V& x) { return V((1 + t) * x); }; };
  const auto soft = hmps::carried(carrier, stretch);
  static_assert(hmps::Motion<decltype(soft), 3>);
  EXPECT_LE((soft(1)(V(1, 0, 0)) - V(0, 2, 0)).norm(), 1e-15);
}

TEST(Turn, RefusesAnAxisWithoutDirection) {
  const Track angle{{.time = 0, .value = 0}, {.time = 1, .value = 1}};
  EXPECT_THROW((void)(hmps::Turn{V::Zero(), V::Zero(), angle}(1.0)), hmps::InputError);
  EXPECT_THROW((void)(hmps::Turn{V::Zero(), V(NAN, 0, 1), angle}(1.0)), hmps::InputError);
}

TEST(Turn, TakesAnAxisOfAnyLength) {
  const Track angle{{.time = 0, .value = 0}, {.time = 1, .value = std::numbers::pi / 2}};
  for (const double length : {1e-320, 1e-200, 1e200, 1e308})
    EXPECT_LE((hmps::Turn{V::Zero(), V(0, 0, length), angle}(1.0)(V(1, 0, 0)) - V(0, 1, 0)).norm(), 1e-15) << length;
}

}  // namespace rigid_motion_test
