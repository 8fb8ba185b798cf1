// SPDX-License-Identifier: MIT
#include "hmps/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "../../reference/message_of.hpp"

namespace error_test {

static_assert(std::is_base_of_v<std::runtime_error, hmps::Error>);
static_assert(std::is_base_of_v<hmps::Error, hmps::InputError>);
static_assert(std::is_base_of_v<hmps::Error, hmps::StateError>);
static_assert(!std::is_base_of_v<hmps::InputError, hmps::StateError>);

TEST(Error, MessageJoinsItsParts) {
  EXPECT_EQ(hmps::detail::message("particle ", 7u, " lies at ", 0.25, " m"), "particle 7 lies at 0.25 m");
  EXPECT_EQ(hmps::detail::message("E", ' ', 3, ')'), "E 3)");
  EXPECT_EQ(hmps::detail::message(), "");
}

// 1.2e-3 and its neighbour in single precision must not read the same.
TEST(Error, MessageKeepsTheDigitsOfAFloat) {
  EXPECT_NE(hmps::detail::message(1.2e-3f), hmps::detail::message(std::nextafter(1.2e-3f, 1.0f)));
}

TEST(Error, RequireThrowsItsMessage) {
  EXPECT_NO_THROW(hmps::detail::require(true, "never"));
  try {
    hmps::detail::require(1 > 2, "hmps: the spacing is ", -1.5, " m");
    FAIL() << "nothing was thrown";
  } catch (const hmps::InputError& error) {
    EXPECT_STREQ(error.what(), "hmps: the spacing is -1.5 m");
  }
}

TEST(Error, RequireIndexNamesTheIndexAndTheSize) {
  const auto message_of_index = [](std::size_t index, std::size_t size) {
    return hmps_test::message_of([&] { hmps::detail::require_index(index, size, "particle", "the list has"); });
  };
  EXPECT_EQ(message_of_index(4, 5), "");
  EXPECT_EQ(message_of_index(5, 5), "hmps: particle 5 is out of range: the list has 5 particles (indices start at 0)");
  EXPECT_EQ(message_of_index(7, 1), "hmps: particle 7 is out of range: the list has 1 particle (indices start at 0)");
}

}  // namespace error_test
