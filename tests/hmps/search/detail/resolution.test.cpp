// SPDX-License-Identifier: MIT
#include "hmps/search/detail/resolution.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace resolution_test {

using namespace hmps;

TEST(Resolution, EndsWhereRoundingExceedsTheShare) {
  const double furthest = 0.01 * 1e-3 / static_cast<double>(std::numeric_limits<float>::epsilon());  // 84 m
  for (const double sign : {1.0, -1.0}) {
    EXPECT_NO_THROW(detail::require_resolution<float>(sign * 0.999 * furthest, 1e-3, 0.01, "it lies"));
    EXPECT_THROW(detail::require_resolution<float>(sign * 1.001 * furthest, 1e-3, 0.01, "it lies"), InputError);
  }
  EXPECT_NO_THROW(detail::require_resolution<double>(1e6, 1e-3, 0.01, "it lies"));
}

TEST(Resolution, NamesTheParticleTheRoundingAndTheRemedy) {
  const std::vector<Vector<float, 2>> x{{0, 0}, {0, -1000}};
  try {
    detail::require_resolved(vectors(x), 1e-3);
    FAIL();
  } catch (const InputError& error) {
    const std::string words = error.what();
    for (const char* part : {"particle 1 lies at -1000 m", "32 bits", "rounded to about 0.000119", "double"})
      EXPECT_NE(words.find(part), std::string::npos) << words;
  }
}

}  // namespace resolution_test
