// SPDX-License-Identifier: MIT
#include "hmps/executors/onetbb.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "same_bits.hpp"

namespace onetbb_test {

static_assert(hmps::Executor<hmps::OneTBB>);

TEST(OneTBB, CallsTheBodyOnceForEach) {
  same_bits::call_every_index_once(hmps::OneTBB{});
  same_bits::call_every_index_once(hmps::OneTBB{.grain = 64});
}

TEST(OneTBB, PropagatesExceptions) { same_bits::pass_exceptions_on(hmps::OneTBB{}); }

TEST(OneTBB, HandsOnTheExceptionOfTheLowestIndex) {
  tbb::task_arena(4).execute([] { same_bits::prefer_the_lowest_index(hmps::OneTBB{}); });
}

TEST(OneTBB, GivesTheSameBitsAsOneThread) {
  const auto check = [](const auto& probe) {
    const auto expected = probe(hmps::Serial{});
    for (int repeat = 0; repeat < 3; ++repeat) EXPECT_TRUE(same_bits::identical(probe(hmps::OneTBB{}), expected));
    EXPECT_TRUE(same_bits::identical(probe(hmps::OneTBB{.grain = 8}), expected));
  };
  check(same_bits::Probe<hmps::LatticeBonds<double, 3>>());
  check(same_bits::Probe<hmps::BondList<float, 3>>());
}

}  // namespace onetbb_test
