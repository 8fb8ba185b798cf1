// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/organ_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../../../reference/message_of.hpp"

namespace organ_pairs_test {

using hmps::Index;
using hmps::detail::is_master;
using hmps::detail::is_prescribed;
using hmps::detail::is_slave;
using hmps::detail::OrganPairs;
using List = std::vector<Index>;

TEST(OrganPairs, NumberEachParticleOnceInTheOrderOfIndices) {
  const List slaves{9, 3, 3}, masters{3, 5}, others{5, 7};
  OrganPairs pairs;
  const auto a = pairs.add_organ({.name = "a", .slaves = slaves, .masters = masters}, 1);
  const auto b = pairs.add_organ({.name = "b", .masters = others, .prescribed = [](Index i) { return i == 7; }}, 1);
  pairs.number_particles();
  EXPECT_EQ(pairs.particle(), (List{3, 5, 7, 9}));
  EXPECT_EQ(pairs.flags(),
            (std::vector<std::uint8_t>{is_slave | is_master, is_master, is_master | is_prescribed, is_slave}));
  EXPECT_EQ(pairs.particles_of(a, is_slave), (List{3, 9})) << "a particle that is listed twice counts once";
  EXPECT_EQ(pairs.particles_of(a, is_master), (List{3, 5}));
  for (const auto& member : pairs.members()) EXPECT_EQ(pairs.particle()[member.number], member.particle);
  List movable;
  pairs.for_each_movable(b, [&](const auto& member) { movable.push_back(member.particle); });
  EXPECT_EQ(movable, List{5});
  EXPECT_THROW(pairs.require_particles(9), hmps::InputError);
  EXPECT_NO_THROW(pairs.require_particles(10));
}

TEST(OrganPairs, HaveASideForEachRoleAndASlotForEachMemberOfItsSlaves) {
  const List one{1, 2}, other{3, 4, 5};
  OrganPairs pairs;
  const auto a = pairs.add_organ({.name = "a", .slaves = one, .masters = one}, 1);
  const auto b = pairs.add_organ({.name = "b", .slaves = other, .masters = other}, 1);
  const List out{4};
  EXPECT_EQ(pairs.add_pair(a, b, {.excluded_slaves = out}), 0U);
  ASSERT_EQ(pairs.sides().size(), 2U);
  EXPECT_EQ(pairs.sides()[0].slaves, a);
  EXPECT_EQ(pairs.sides()[1].slaves, b);
  EXPECT_EQ(pairs.sides()[1].first_slot, 2U);
  EXPECT_EQ(pairs.slots(), 5U);
  EXPECT_FALSE(pairs.pairs()[0].may_be_slave(4));
  EXPECT_TRUE(pairs.pairs()[0].may_be_slave(5));
}

TEST(OrganPairs, RefuseWhatWouldCountTwice) {
  const List one{1, 2}, other{3, 4}, third{5, 6};
  OrganPairs pairs;
  const auto add = [&](const List& list) { return pairs.add_organ({.name = "x", .slaves = list, .masters = list}, 1); };
  const auto a = add(one), b = add(other), c = add(third), again = add(other);
  pairs.add_pair(a, b, {});
  EXPECT_THROW(pairs.add_pair(a, b, {}), hmps::InputError);
  EXPECT_THROW(pairs.add_pair(b, a, {}), hmps::InputError);
  EXPECT_THROW(pairs.add_pair(a, again, {}), hmps::InputError);
  EXPECT_NO_THROW(pairs.add_pair(a, c, {})) << "slaves are shared, but no masters";
  EXPECT_NO_THROW(pairs.add_pair(again, c, {})) << "the same with masters shared";
  EXPECT_EQ(pairs.pairs().size(), 3U);
  EXPECT_EQ(pairs.sides().size(), 6U);
}

TEST(OrganPairs, RefuseWhatIsNoOrganOrNoIndex) {
  OrganPairs pairs;
  const List some{1}, none{hmps::detail::no_index};
  EXPECT_THROW(pairs.add_organ({.name = "empty"}, 1), hmps::InputError);
  EXPECT_THROW(pairs.add_organ({.name = "none", .slaves = none}, 1), hmps::InputError);
  const auto a = pairs.add_organ({.name = "a", .slaves = some}, 1);
  EXPECT_THROW(pairs.add_pair(a, a, {}), hmps::InputError);
  EXPECT_THROW(pairs.add_pair(a, 7, {}), hmps::InputError);
}

TEST(OrganPairs, KeepTheRadiusOfEachSlave) {
  const List one{1, 2}, other{3}, third{4};
  OrganPairs pairs;
  const auto a =
      pairs.add_organ({.name = "a", .slaves = one, .masters = one, .radius = [](Index i) { return 0.35 * i; }}, 1);
  const auto b = pairs.add_organ({.name = "b", .slaves = other, .masters = other}, 1);
  const auto c = pairs.add_organ({.name = "c", .slaves = third, .masters = third}, 1);
  pairs.add_pair(c, a, {});
  pairs.add_pair(c, b, {});
  const auto& a_at_c = pairs.sides()[1];
  ASSERT_EQ(a_at_c.slaves, a);
  EXPECT_EQ(pairs.slave_radius(1, a_at_c.first_slot), 0.35);
  EXPECT_EQ(pairs.slave_radius(1, a_at_c.first_slot + 1), 0.7);
  EXPECT_EQ(pairs.slave_radius(3, pairs.sides()[3].first_slot), 0.5) << "half the spacing in another organ";
}

TEST(OrganPairs, RefuseARadiusThatIsNone) {
  const List some{1, 2};
  for (const double radius : {0., -0.5, 0.5e-3, 0.751, 500., std::nan("")}) {
    OrganPairs pairs;
    const auto add = [&] {
      pairs.add_organ(
          {.name = "a", .slaves = some, .masters = {}, .radius = [=](Index i) { return i == 2 ? radius : 0.5; }}, 1);
    };
    EXPECT_NE(hmps_test::message_of(add).find("slave 2 of organ 'a' has a radius of"), std::string::npos) << radius;
    EXPECT_TRUE(pairs.organs().empty() && pairs.members().empty());
  }
}

TEST(OrganPairs, RefuseExclusionsThatDoNotFit) {
  const List one{1, 2}, other{3, 4};
  OrganPairs pairs;
  const auto a = pairs.add_organ({.name = "a", .slaves = one, .masters = one}, 1);
  const auto b = pairs.add_organ({.name = "b", .slaves = other, .masters = other}, 1);
  const List stranger{7}, all{1, 2, 3, 4}, half{1, 2};
  EXPECT_THROW(pairs.add_pair(a, b, {.excluded_slaves = stranger}), hmps::InputError);
  EXPECT_THROW(pairs.add_pair(a, b, {.excluded_slaves = all}), hmps::InputError);
  EXPECT_THROW(pairs.add_pair(a, b, {.roles = hmps::Roles::only_first_is_slave, .excluded_slaves = half}),
               hmps::InputError);
  EXPECT_NO_THROW(pairs.add_pair(a, b, {.excluded_slaves = half}));
#ifdef __cpp_rtti
  const hmps::ParticleSet of_another_scene(4, [](std::size_t) { return true; });
  EXPECT_THROW(pairs.add_organ({.name = "c", .slaves = other, .masters = other, .prescribed = of_another_scene}, 1),
               hmps::InputError);
#endif
}

}  // namespace organ_pairs_test
