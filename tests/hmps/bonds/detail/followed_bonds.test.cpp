// SPDX-License-Identifier: MIT
#include "hmps/bonds/detail/followed_bonds.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/lattice_bonds.hpp"

namespace followed_bonds_test {

using Bonds = hmps::LatticeBonds<double, 3>;
using Followed = hmps::detail::FollowedBonds<Bonds>;

Bonds cube(int edge) {
  std::vector<hmps::Vector<double, 3>> X;
  for (int i = 0; i < edge * edge * edge; ++i)
    X.push_back({1. * (i % edge), 1. * (i / edge % edge), 1. * (i / edge / edge)});
  return Bonds(hmps::vectors(X), {.spacing = 1});
}

TEST(FollowedBonds, FollowMoves) {
  auto first = std::make_unique<Bonds>(cube(3));
  const Followed followed(*first);
  const Followed again = followed;
  EXPECT_EQ(&followed.now(), first.get());
  Bonds second = std::move(*first);
  EXPECT_EQ(&followed.now(), &second);
  first.reset();
  Bonds third = cube(4);
  third = std::move(second);
  EXPECT_EQ(&followed.now(), &third);
  EXPECT_EQ(&again.now(), &third);
}

TEST(FollowedBonds, DoNotFollowCopies) {
  const Bonds own = cube(3);
  const Followed followed(own);
  const Bonds copy = own;
  EXPECT_EQ(&followed.now(), &own);
  EXPECT_EQ(&Followed(copy).now(), &copy);
}

TEST(FollowedBonds, RejectsDestroyedBonds) {
  auto bonds = std::make_unique<Bonds>(cube(3));
  const Followed followed(*bonds);
  const Bonds other = cube(3);
  *bonds = other;
  EXPECT_THROW((void)followed.now(), hmps::InputError);
  const Followed assigned(*bonds);
  bonds.reset();
  EXPECT_THROW((void)assigned.now(), hmps::InputError);
  Bonds from = cube(3);
  const Bonds to = std::move(from);
  EXPECT_THROW((void)Followed(from), hmps::InputError);
}

}  // namespace followed_bonds_test
