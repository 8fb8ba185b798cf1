// SPDX-License-Identifier: MIT
#include "hmps/contact/overlaps.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "bodies.hpp"
#include "hmps/contact/contact.hpp"

namespace overlaps_test {

using hmps::Index;
using Contact = hmps::MetaballContact<double, 3>;
using Pile = bodies::Pile<double, 3>;

std::vector<hmps::Overlap> overlaps(const Pile& pile, const hmps::PairSettings& settings = {}) {
  Contact contact({.spacing = 1e-3, .density = 1000});
  pile.declare(contact, settings);
  return contact.overlaps(hmps::vectors(pile.x), hmps::matrices(pile.F));
}

TEST(Overlaps, NoneWhereBodiesDoNotTouch) {
  for (const double gap : {1.05, 1.5, 3., 20.}) EXPECT_TRUE(overlaps(Pile(gap)).empty()) << gap;
}

/// From a tenth of a spacing to three spacings, where contact no longer sees the overlap at all.
TEST(Overlaps, TellTheDepthAndTheDeepest) {
  for (const double gap : {0.9, 0.5, -0.2, -1., -1.5, -2.}) {
    Pile pile(gap);
    const Index low = pile.block.bottom[5];  // one of the middle
    pile.x[low][2] -= 0.1e-3;
    const auto found = overlaps(pile);
    ASSERT_EQ(found.size(), 2U) << gap;
    EXPECT_EQ(found[0].slaves, "plate");
    EXPECT_EQ(found[1].slaves, "block");
    EXPECT_EQ(found[1].masters, "plate");
    EXPECT_EQ(found[1].count, 16U) << gap;
    EXPECT_EQ(found[1].deepest, low) << gap;
    // Tolerance: a few hundredths of a spacing for metaballs over a flat wall, half a spacing for the estimate below.
    EXPECT_NEAR(found[1].depth, (1.1 - gap) * 1e-3, (gap > 0.3 ? 0.05 : 0.5) * 1e-3) << gap;
    EXPECT_GE(found[0].count, 4U) << gap;
  }
}

TEST(Overlaps, KnowWhatContactDoesNotSee) {
  Pile pile(-2);
  Contact contact({.spacing = 1e-3, .density = 1000});
  pile.declare(contact);
  const auto before = pile.apply(contact, 1e-5);
  const auto found = contact.overlaps(hmps::vectors(pile.x));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_GT(found[1].depth, 2.5e-3);
  EXPECT_GT(found[1].count, before.lost);
  EXPECT_EQ(contact.overlaps(hmps::vectors(pile.x)).size(), 2U) << "asking changes nothing";
  EXPECT_EQ(pile.apply(contact, 1e-5).contacts, before.contacts);
}

TEST(Overlaps, ReachAsFarAsTheSlavesDo) {
  for (const double radius : {0.4e-3, 0.6e-3})
    for (const double gap : {0.8, -1.5}) {
      const Pile pile(gap);
      Contact contact({.spacing = 1e-3, .density = 1000});
      const auto wall = contact.add_organ({.name = "wall", .slaves = pile.plate.top, .masters = pile.plate.upper});
      contact.add_pair(contact.add_organ({.name = "block",
                                          .slaves = pile.block.bottom,
                                          .masters = pile.block.lower,
                                          .radius = [=](Index) { return radius; }}),
                       wall);
      const auto found = contact.overlaps(hmps::vectors(pile.x));
      ASSERT_EQ(found.size(), 2U);
      const auto without = overlaps(pile);
      EXPECT_NEAR(found[0].depth - without[1].depth, radius - 0.5e-3, 1e-9) << gap;
    }
}

TEST(Overlaps, LeaveOutWhatIsExcluded) {
  const Pile pile(-1);
  const auto found = overlaps(pile, {.excluded_slaves = pile.block.bottom});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].slaves, "plate");
  EXPECT_TRUE(overlaps(pile, {.excluded = [](Index, Index) { return true; }}).empty());
}

/// A body beside a wall, lower than the wall's surface, is not inside it.
TEST(Overlaps, ABodyBesideAWallIsOutside) {
  for (const double aside : {1.2, 2., 3.})
    for (const double gap : {0., -1., -2.}) {
      Pile pile(gap);
      for (const Index i : pile.block.all) pile.x[i][1] += (10 - 2.8 - 1 + aside) * 1e-3;
      EXPECT_TRUE(overlaps(pile).empty()) << aside << ' ' << gap;
    }
}

TEST(Overlaps, InTwoDimensionsAndFloat) {
  bodies::Pile<float, 2> pile(-1.5);
  hmps::MetaballContact<float, 2> contact({.spacing = 1e-3, .density = 1000});
  pile.declare(contact);
  const auto found = contact.overlaps(hmps::vectors(pile.x), hmps::matrices(pile.F));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].count, 4U);
  EXPECT_NEAR(found[1].depth, 2.5e-3, 0.5e-3);
}

TEST(Overlaps, RefuseBadInput) {
  Pile pile(0.9);
  Contact contact({.spacing = 1e-3, .density = 1000});
  pile.declare(contact);
  const auto x = hmps::vectors(pile.x);
  EXPECT_THROW((void)contact.overlaps(x.part(0, 10)), hmps::InputError);
  EXPECT_THROW((void)contact.overlaps(x, hmps::matrices(pile.F).part(0, 10)), hmps::InputError);
  pile.x[pile.block.bottom[2]][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)contact.overlaps(x), hmps::StateError);
}

}  // namespace overlaps_test
