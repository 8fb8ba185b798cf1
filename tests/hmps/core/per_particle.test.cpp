// SPDX-License-Identifier: MIT
#include "hmps/core/per_particle.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace {

using namespace hmps;

static_assert(PerParticle<double> && PerParticle<float> && PerParticle<ScalarView<const float>>);
static_assert(!PerParticle<std::vector<double>> && !PerParticle<std::string>);

TEST(PerParticle, NumberIsSharedAndViewIsEachOnesOwn) {
  std::vector<float> values{1.5f, 2.5f, 3.5f};
  EXPECT_EQ(at_particle(1000.0, 2), 1000.0);
  EXPECT_EQ(at_particle(scalars(values), 2), 3.5f);
}

TEST(PerParticle, ValuesThatAreNotPositiveAreNamed) {
  std::vector<double> values{1, 2, 3};
  EXPECT_NO_THROW(require_positive(1000.0, 5, "density", "kg/m3"));
  EXPECT_NO_THROW(require_positive(scalars(values), 3, "density", "kg/m3"));
  EXPECT_THROW(require_positive(scalars(values), 4, "density", "kg/m3"), InputError);
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(require_positive(bad, 3, "density", "kg/m3"), InputError);
    values[1] = bad;
    try {
      require_positive(scalars(values), 3, "density", "kg/m3");
      FAIL() << bad << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("density of particle 1"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
