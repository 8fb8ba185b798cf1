// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/state_checks.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "../bodies.hpp"
#include "hmps/contact/contact.hpp"

namespace state_checks_test {

using hmps::Index;
using Contact = hmps::MetaballContact<double, 3>;
using Pile = bodies::Pile<double, 3>;

constexpr double dt = 1e-5, nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
const hmps::ContactSettings settings{.spacing = 1e-3, .density = 1000, .friction = 0.3};

/// The message of the `E` that the second call of a contact throws after `spoil(pile)` has been called.
template <class E, class Spoil>
std::string said(double gap, Spoil&& spoil) {
  Pile pile(gap);
  Contact contact(settings);
  pile.declare(contact);
  pile.apply(contact, dt);
  spoil(pile);
  const auto before = pile.f;
  pile.rest();
  try {
    contact.add(hmps::vectors(pile.x), hmps::vectors(pile.v), hmps::matrices(pile.F), hmps::vectors(pile.f), dt);
  } catch (const E& error) {
    EXPECT_EQ(pile.magnitude(), 0) << "a force was given before the error";
    return error.what();
  }
  return {};
}

void expect_named(const std::string& text, Index particle, const char* what) {
  EXPECT_NE(text.find("particle " + std::to_string(particle) + " "), std::string::npos) << text;
  EXPECT_NE(text.find(what), std::string::npos) << text;
}

/// A master of the plate or a slave of the block that has the other body above or below it.
Index near_the_other(const Pile& pile, bool master) {
  return master ? pile.plate.upper[(4 * 10 + 4) * 2 + 1] : pile.block.bottom[5];
}

TEST(StateChecks, NameTheParticleWhoseGradientIsNotFinite) {
  for (const double bad : {nan, inf, -inf})
    for (const bool master : {true, false}) {
      const Pile pile(0.9);
      const Index i = near_the_other(pile, master);
      const auto one = [&](Pile& spoilt) { spoilt.F[i](1, 2) = bad; };
      const auto whole = [&](Pile& spoilt) { spoilt.F[i].setConstant(bad); };
      expect_named(said<hmps::StateError>(0.9, one), i, "gradient");
      expect_named(said<hmps::StateError>(0.9, whole), i, "gradient");
    }
}

TEST(StateChecks, LookAtWhatIsFarFromAllOthersNowAndThen) {
  Pile pile(0.9);
  Contact contact(settings);
  pile.declare(contact);
  pile.apply(contact, dt);
  pile.F[pile.plate.upper.front()].setConstant(nan);  // a corner
  EXPECT_THROW(for (int call = 0; call < 100; ++call) pile.apply(contact, dt), hmps::StateError);
}

TEST(StateChecks, AskForRecordWhereGradientsAreZero) {
  const Pile pile(0.9);
  const Index i = near_the_other(pile, true);
  expect_named(said<hmps::InputError>(0.9, [&](Pile& spoilt) { spoilt.F[i].setZero(); }), i, "record(F)");
  // If nothing was ever recorded, the first call detects it, even if the bodies are far apart.
  for (const double gap : {0.9, 20.}) {
    Pile forgotten(gap);
    for (auto& F : forgotten.F) F.setZero();
    Contact contact(settings);
    forgotten.declare(contact);
    EXPECT_THROW(forgotten.apply(contact, dt), hmps::InputError) << gap;
  }
}

TEST(StateChecks, LetAMasterThatIsSquashedFlatBeNoWall) {
  for (const double thickness : {0., 1e-200}) {
    Pile pile(0.9);
    for (const Index i : pile.plate.upper) pile.F[i](2, 2) = thickness;
    Contact contact(settings);
    const auto a = contact.add_organ({.name = "plate", .slaves = {}, .masters = pile.plate.upper, .prescribed = {}});
    const auto b = contact.add_organ({.name = "block", .slaves = pile.block.bottom, .masters = {}, .prescribed = {}});
    contact.add_pair(a, b, {.roles = hmps::Roles::only_second_is_slave, .excluded_slaves = {}, .excluded = {}});
    EXPECT_EQ(pile.apply(contact, dt).contacts, 0U);
  }
}

TEST(StateChecks, NameTheParticleWhosePositionOrVelocityIsNotFinite) {
  for (const double bad : {nan, inf})
    for (const bool master : {true, false}) {
      const Pile pile(0.9);
      const Index i = near_the_other(pile, master);
      expect_named(said<hmps::StateError>(0.9, [&](Pile& spoilt) { spoilt.v[i][1] = bad; }), i, "velocity");
      expect_named(said<hmps::StateError>(0.9, [&](Pile& spoilt) { spoilt.x[i][1] = bad; }), i, "position");
    }
  EXPECT_TRUE(said<hmps::Error>(0.9, [](Pile&) {}).empty());
}

TEST(StateChecks, RefuseAPenaltyThatTheScalarCannotHold) {
  bodies::Pile<float, 3> pile(0.9);
  for (const double k : {1e39, 1e-46}) {
    hmps::MetaballContact<float, 3> contact(
        {.spacing = 1e-3, .density = 1000, .stiffness = hmps::PenaltyStiffness::fixed(k)});
    pile.declare(contact);
    EXPECT_THROW(pile.apply(contact, 1e-19), hmps::InputError) << k;
  }
  hmps::MetaballContact<float, 3> contact(settings);
  pile.declare(contact);
  EXPECT_THROW(pile.apply(contact, 1e-19), hmps::InputError) << "a ratio at a tiny step";
  EXPECT_NO_THROW(pile.apply(contact, dt));
}

}  // namespace state_checks_test
