// SPDX-License-Identifier: MIT
#include "hmps/core/detail/anchored.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <type_traits>
#include <utility>

namespace anchored_test {

struct Body : hmps::detail::Anchored {};
using Anchor = hmps::detail::Anchored::Anchor;
static_assert(std::is_nothrow_move_constructible_v<Body>, "a std::vector copies what may throw when it is moved");

TEST(Anchored, IsFoundAfterMoves) {
  std::optional<Body> first(std::in_place);
  const Anchor anchor(*first);
  Body second(std::move(*first));
  first.reset();
  EXPECT_EQ(anchor.object(), &second);
  Body third;
  const Anchor lost(third);
  third = std::move(second);
  EXPECT_EQ(anchor.object(), &third);
  EXPECT_EQ(lost.object(), nullptr);
}

TEST(Anchored, CopiesAreIndependent) {
  Body first;
  const Anchor anchor(first);
  Body second(first);
  EXPECT_EQ(anchor.object(), &first);
  EXPECT_EQ(Anchor(second).object(), &second);
  first = second;
  EXPECT_EQ(anchor.object(), nullptr);
  EXPECT_EQ(Anchor(first).object(), &first);
}

TEST(Anchored, IsNotFoundAfterDestruction) {
  std::optional<Body> body(std::in_place);
  const Anchor anchor(*body);
  body.reset();
  EXPECT_EQ(anchor.object(), nullptr);
}

}  // namespace anchored_test
