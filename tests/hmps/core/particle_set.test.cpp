// SPDX-License-Identifier: MIT
#include "hmps/core/particle_set.hpp"

#include <gtest/gtest.h>

#include <concepts>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace particle_set_test {

using hmps::Index;
using hmps::ParticleSet;
using List = std::vector<Index>;

static_assert(std::predicate<const ParticleSet&, std::size_t>);

TEST(ParticleSet, IsAListAndAPredicate) {
  const ParticleSet odd(7, [](std::size_t i) { return i % 2 == 1; });
  EXPECT_EQ(odd.indices(), (List{1, 3, 5}));
  EXPECT_TRUE(odd(5));
  EXPECT_FALSE(odd(4));
  EXPECT_FALSE(odd(9));
  EXPECT_TRUE(odd.contains(5));
  EXPECT_FALSE(odd.contains(4));
  EXPECT_EQ(odd.size(), 3u);
  EXPECT_EQ(odd.scene_size(), 7u);
  EXPECT_EQ(List(odd.begin(), odd.end()), odd.indices());
  EXPECT_EQ(ParticleSet(7, List{5, 1, 3}), odd);
}

TEST(ParticleSet, HasAComplementAndUnions) {
  const ParticleSet odd(7, List{1, 3, 5}), low(7, List{0, 1, 2});
  EXPECT_EQ((~odd).indices(), (List{0, 2, 4, 6}));
  EXPECT_EQ(~~odd, odd);
  EXPECT_EQ((odd | low).indices(), (List{0, 1, 2, 3, 5}));
  EXPECT_EQ((odd & low).indices(), (List{1}));
  EXPECT_EQ((odd & ~odd).size(), 0u);
  EXPECT_TRUE((odd & ~odd).empty());
  EXPECT_FALSE(odd.empty());
  EXPECT_THROW((void)(odd | ParticleSet(6, List{})), hmps::InputError);
}

TEST(ParticleSet, RejectsMissingAndRepeatedParticles) {
  const auto text = [](const List& indices) {
    try {
      (void)ParticleSet(4, indices);
    } catch (const hmps::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(text({1, 4}).find("particle 4 but there are only 4"), std::string::npos);
  EXPECT_NE(text({2, 1, 2}).find("particle 2 twice"), std::string::npos);
  EXPECT_EQ(text({3, 0}), "");
}

// A set of another scene would hold, or release, all particles beyond its own.
TEST(ParticleSet, OfAnotherSceneIsRejectedAlsoInsideAFunction) {
  const ParticleSet set(5, [](std::size_t) { return true; });
  EXPECT_THROW(hmps::detail::require_scene(set, 6, "that move"), hmps::InputError);
  EXPECT_NO_THROW(hmps::detail::require_scene(set, 5, "that move"));
  EXPECT_NO_THROW(hmps::detail::require_scene([](std::size_t) { return true; }, 6, "that move"));
  const std::function<bool(std::size_t)> held = set, none;
  EXPECT_NO_THROW(hmps::detail::require_scene(held, 5, "that move"));
  EXPECT_NO_THROW(hmps::detail::require_scene(none, 6, "that move"));
#ifdef __cpp_rtti
  EXPECT_THROW(hmps::detail::require_scene(held, 6, "that move"), hmps::InputError);
#endif
}

}  // namespace particle_set_test
