// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "bodies.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/contact/contact.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace contact_bits_test {

using bodies::Case;
using hmps::Index;
using hmps::MetaballContact;
using hmps::PaperMetaball;
using hmps::SmoothMetaball;

template <class C>
class ContactBits : public ::testing::Test {};
using Cases = ::testing::Types<Case<double, 3, SmoothMetaball>, Case<float, 3, PaperMetaball>,
                               Case<float, 3, SmoothMetaball>, Case<float, 2, SmoothMetaball>>;
TYPED_TEST_SUITE(ContactBits, Cases);

TYPED_TEST(ContactBits, AreTheSameInAnyOrderAndHoweverOldTheLists) {
  using S = typename TypeParam::S;
  constexpr int D = TypeParam::D;
  const hmps::ContactSettings with_friction{.spacing = 1e-3, .density = 1000, .friction = 0.3};
  constexpr double dt = 1e-5;
  bodies::Pile<S, D> pile(1.3);
  pile.shake(S(0.05), S(0.03), 4);
  using Contact = MetaballContact<S, D, typename TypeParam::Ball, hmps::CorrectedFriction>;  // which forgets nothing
  Contact serial(with_friction), reversed(with_friction), fresh(with_friction);
  for (auto* contact : {&serial, &reversed, &fresh}) pile.declare(*contact);
  std::size_t contacts = 0;
  for (int step = 0; step < 100; ++step) {
    for (const Index i : pile.block.all) pile.x[i][D - 1] -= S(6e-6);
    const auto report = pile.apply(serial, dt);
    contacts += report.contacts;
    EXPECT_EQ(report.late, 0U);
    const auto bits = pile.f;
    pile.apply(reversed, dt, bodies::Loops{.backwards = true});
    ASSERT_EQ(bits, pile.f) << "reversed, step " << step;
    fresh.refresh();
    pile.apply(fresh, dt);
    ASSERT_EQ(bits, pile.f) << "fresh lists, step " << step;
  }
  EXPECT_GT(contacts, 100U);
}

/// Presses a plate into a block held below until contact chatters. Returns the positions after the last step and the
/// largest speed on the way.
std::pair<std::vector<hmps::Vector<double, 3>>, double> pressed(bool fresh_lists) {
  bodies::Scene<double, 3> scene;
  const double l0 = 2.4e-3, step = 2.2e-5;
  const auto block = scene.add({8, 8, 4}, {0, 0, 0}, l0);
  const auto plate = scene.add({5, 5, 2}, {1.3 * l0, 1.2 * l0, 4.05 * l0}, l0);
  const std::size_t count = block.all.size();
  const auto reference = scene.x;
  const auto x = hmps::vectors(scene.x), v = hmps::vectors(scene.v), f = hmps::vectors(scene.f);
  const auto F = hmps::matrices(scene.F);
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference).part(0, count), {.spacing = l0});
  auto force = hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(20e3, 1e6)),
                                    hmps::artificial(20e3), hmps::record(F.part(0, count)));
  MetaballContact<double, 3, PaperMetaball, hmps::CorrectedFriction> contact(
      {.spacing = l0, .density = 1000, .friction = 0.1});
  contact.add_pair(
      contact.add_organ({.name = "block", .slaves = block.top, .masters = block.upper, .prescribed = {}}),
      contact.add_organ({.name = "plate", .slaves = plate.bottom, .masters = plate.lower, .prescribed = {}}));
  double fastest = 0;
  for (int k = 0; k < 1500; ++k) {
    const auto hold = [&] {
      for (const Index i : plate.all) scene.v[i] = {0.05, 0, -0.1};
      for (const Index i : block.bottom) scene.v[i].setZero();
    };
    force(x.part(0, count), v.part(0, count), f.part(0, count));
    hmps::kick(v.part(0, count), f.part(0, count), 1000, step);
    hold();
    scene.rest();
    if (fresh_lists) contact.refresh();
    contact.add(x, v, F, f, step);
    hmps::kick(v, f, 1000, step);
    hold();
    hmps::drift(x, v, step);
    for (const auto& velocity : scene.v) fastest = std::max(fastest, velocity.norm());
  }
  return {scene.x, fastest};
}

TEST(Lists, MissNothingWhileABlockIsPressedUntilItChatters) {
  const auto [kept, fastest] = pressed(false);
  EXPECT_GT(fastest, 1) << "contact was meant to chatter";
  for (const auto& place : kept) ASSERT_TRUE(place.allFinite());
  EXPECT_EQ(kept, pressed(true).first);
}

}  // namespace contact_bits_test
