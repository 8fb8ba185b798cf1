// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <string>
#include <thread>

#include "message_of.hpp"

namespace hmps_test {

/// An executor of a user who thinks of no exceptions: one thread runs the first half of each loop, another the rest. An
/// exception would end the program, and is counted instead.
class TwoThreads {
 public:
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    const auto run = [&](std::size_t begin, std::size_t end) {
      try {
        for (std::size_t i = begin; i < end; ++i) body(i);
      } catch (...) {
        ++exceptions_;
      }
    };
    std::thread other([&] { run(n / 2, n); });
    run(0, n / 2);
    other.join();
  }
  [[nodiscard]] int exceptions() const { return exceptions_; }

 private:
  mutable std::atomic<int> exceptions_ = 0;
};

/// The message of the `Error` that `call(execute)` throws to its caller. Fails if an exception reaches the executor.
template <class Error = hmps::InputError, class Call>
[[nodiscard]] std::string message_in_two_threads(Call&& call) {
  const TwoThreads execute;
  const std::string message = message_of<Error>([&] { call(execute); });
  EXPECT_EQ(execute.exceptions(), 0) << "an exception reached the executor";
  return message;
}

}  // namespace hmps_test
