// SPDX-License-Identifier: MIT
#include "hmps/core/executor.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "../../reference/backwards.hpp"
#include "../../reference/two_threads.hpp"

namespace executor_test {

using hmps_test::Backwards;

struct TakesNoBody {
  void operator()(std::size_t) const {}
};
struct TakesAnIndexOfItsOwn {
  void operator()(std::size_t, const std::function<void(std::string)>&) const {}
};

static_assert(hmps::Executor<hmps::Serial>);
static_assert(hmps::Executor<Backwards>);
static_assert(hmps::Executor<decltype([](std::size_t, auto&&) {})>);
static_assert(!hmps::Executor<int>);
static_assert(!hmps::Executor<TakesNoBody>);
static_assert(!hmps::Executor<TakesAnIndexOfItsOwn>);

TEST(Serial, CallsTheBodyOnceForEachInOrder) {
  std::vector<std::size_t> seen;
  hmps::Serial{}(5, [&](std::size_t i) { seen.push_back(i); });
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  hmps::Serial{}(0, [&](std::size_t) { FAIL(); });
}

TEST(Guarded, KeepsExceptionsFromTheExecutorAndThrowsThatOfTheLowestIndex) {
  std::vector<int> calls(100, 0);
  const std::string error = hmps_test::message_in_two_threads([&](const auto& execute) {
    hmps::detail::guarded(execute)(calls.size(), [&](std::size_t i) {
      ++calls[i];
      if (i % 30 == 20) throw hmps::InputError(std::to_string(i));
    });
  });
  EXPECT_EQ(error, "20");
  EXPECT_EQ(calls, std::vector<int>(100, 1));
}

TEST(ForEachInChunks, KeepsExceptionsFromTheExecutor) {
  const std::string error = hmps_test::message_in_two_threads([&](const auto& execute) {
    hmps::detail::for_each_in_chunks(5000, std::cref(execute), [&](std::size_t i) {
      if (i == 3000) throw hmps::InputError("3000");
    });
  });
  EXPECT_EQ(error, "3000");
}

TEST(Reduce, KeepsExceptionsFromTheExecutor) {
  const auto term = [](std::size_t i) {
    if (i == 3000) throw hmps::InputError("3000");
    return 1;
  };
  const std::string error = hmps_test::message_in_two_threads(
      [&](const auto& execute) { (void)hmps::reduce(5000, 0, term, std::plus<>(), execute); });
  EXPECT_EQ(error, "3000");
}

TEST(ForEachInChunks, CallsTheBodyOnceForEach) {
  for (const std::size_t n : {0u, 1u, 1023u, 1024u, 1025u, 5000u}) {
    std::vector<int> calls(n, 0);
    std::size_t chunks = 0;
    const auto backwards = [&](std::size_t count, const auto& body) {
      chunks = count;
      Backwards{}(count, body);
    };
    hmps::detail::for_each_in_chunks(n, backwards, [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(n, 1)) << n;
    EXPECT_EQ(chunks, (n + 1023) / 1024);
  }
}

TEST(Reduce, SumsEveryTermOnce) {
  for (const std::size_t n : {0u, 1u, 2u, 1023u, 1024u, 1025u, 5000u}) {
    const auto sum = hmps::reduce(
        n, std::size_t{0}, [](std::size_t i) { return i; }, std::plus<>());
    EXPECT_EQ(sum, n == 0 ? 0 : n * (n - 1) / 2) << n;
  }
}

TEST(Reduce, StartsFromStart) {
  const auto last = [](std::size_t, std::size_t b) { return b; };
  EXPECT_EQ(hmps::reduce(
                0, std::size_t{42}, [](std::size_t i) { return i; }, last),
            42u);
  // Combined in order, whatever the executor: the last term wins.
  EXPECT_EQ(hmps::reduce(
                4000, std::size_t{42}, [](std::size_t i) { return i; }, last, Backwards{}),
            3999u);
  EXPECT_EQ(hmps::reduce(
                3, 10, [](std::size_t) { return 1; }, std::plus<>()),
            13);
}

TEST(Reduce, DoesNotDependOnTheExecutor) {
  const auto term = [](std::size_t i) { return std::sin(static_cast<double>(i * i)) * 1e3; };
  const double forwards = hmps::reduce(10007, 0.0, term, std::plus<>());
  const double backwards = hmps::reduce(10007, 0.0, term, std::plus<>(), Backwards{});
  EXPECT_EQ(std::bit_cast<std::uint64_t>(forwards), std::bit_cast<std::uint64_t>(backwards));
}

}  // namespace executor_test
