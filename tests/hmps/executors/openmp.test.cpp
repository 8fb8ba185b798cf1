// SPDX-License-Identifier: MIT
#include "hmps/executors/openmp.hpp"

#include <gtest/gtest.h>

#include "same_bits.hpp"

namespace openmp_test {

static_assert(hmps::Executor<hmps::OpenMP>);

TEST(OpenMP, CallsTheBodyOnceForEach) {
  for (const int threads : {1, 2, 3, 4}) same_bits::call_every_index_once(hmps::OpenMP{threads});
  same_bits::call_every_index_once(hmps::OpenMP{});
}

TEST(OpenMP, PropagatesExceptions) {
  for (const int threads : {1, 4}) same_bits::pass_exceptions_on(hmps::OpenMP{threads});
}

TEST(OpenMP, HandsOnTheExceptionOfTheLowestIndex) {
  for (const int threads : {1, 2, 4}) same_bits::prefer_the_lowest_index(hmps::OpenMP{threads});
}

TEST(OpenMP, RefusesNoThreads) {
  EXPECT_THROW(hmps::OpenMP{0}(1, [](std::size_t) {}), hmps::InputError);
}

// Thousands of threads that spin while they wait for each other look like a program that hangs.
TEST(OpenMP, RejectsTooManyThreads) {
  const int most = hmps::OpenMP::most_threads();
  EXPECT_GE(most, 4 * omp_get_num_procs());
  bool called = false;
  EXPECT_THROW(hmps::OpenMP{most + 1}(1, [&](std::size_t) { called = true; }), hmps::InputError);
  EXPECT_FALSE(called);
  hmps::OpenMP{most}(1, [&](std::size_t) { called = true; });
  EXPECT_TRUE(called);
}

TEST(OpenMP, GivesTheSameBitsAsOneThread) {
  const auto check = [](const auto& probe) {
    const auto expected = probe(hmps::Serial{});
    for (const int threads : {1, 2, 3, 4})
      EXPECT_TRUE(same_bits::identical(probe(hmps::OpenMP{threads}), expected)) << threads;
  };
  check(same_bits::Probe<hmps::LatticeBonds<float, 3>>());
  check(same_bits::Probe<hmps::BondList<float, 3>>());
  check(same_bits::Probe<hmps::BondList<double, 3>>());
}

}  // namespace openmp_test
