// SPDX-License-Identifier: MIT
#include "hmps/core/detail/first_failure.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>

#include "../../../reference/message_of.hpp"

namespace first_failure_test {

void fail(hmps::detail::FirstFailure& failure, std::size_t index) {
  try {
    throw std::runtime_error(std::to_string(index));
  } catch (...) {
    failure.keep(index);
  }
}

TEST(FirstFailure, IsThatOfTheLowestIndexInAnyOrder) {
  for (const auto& order : {std::initializer_list<std::size_t>{3, 5, 9}, {9, 5, 3}, {5, 3, 9}, {3}}) {
    hmps::detail::FirstFailure failure;
    for (const std::size_t index : order) fail(failure, index);
    EXPECT_EQ(hmps_test::message_of<std::runtime_error>([&] { failure.rethrow(); }), "3");
  }
}

TEST(FirstFailure, ThrowsNothingWithoutOne) { EXPECT_NO_THROW(hmps::detail::FirstFailure().rethrow()); }

}  // namespace first_failure_test
