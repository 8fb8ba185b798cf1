// SPDX-License-Identifier: MIT
#include "hmps/core/per_particle.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "../../reference/message_of.hpp"

namespace per_particle_test {

using namespace hmps;

static_assert(PerParticle<double> && PerParticle<float> && PerParticle<ScalarView<const float>>);
static_assert(!PerParticle<std::vector<double>> && !PerParticle<decltype([](int) { return 1.0; })> &&
              !PerParticle<std::string>);

TEST(PerParticle, NumbersAreSharedAndViewsDifferBetweenParticles) {
  std::vector<float> values{1.5f, 2.5f, 3.5f};
  EXPECT_EQ(at_particle(1000.0, 2), 1000.0);
  EXPECT_EQ(at_particle(scalars(values), 2), 3.5f);
}

// A callable computes the value from parameters of the particle or of its body, and is checked like a view.
TEST(PerParticle, CallableComputesTheValueOfEach) {
  std::vector<float> values{1.5f, 2.5f, 3.5f};
  std::vector<double> table{10, 20};
  std::vector<int> body{0, 1, 0};
  const auto sum = [&](const auto& at) { return 2 * at(scalars(values)) + at(scalars(table), scalars(body)); };
  static_assert(PerParticle<decltype(sum)>);
  EXPECT_EQ(at_particle(sum, 1), 25.0);
  EXPECT_NO_THROW(require_positive(sum, 3, "density", "kg/m3"));
  values[2] = -5;
  const auto message = [&](std::size_t size) {
    return hmps_test::message_of([&] { require_positive(sum, size, "density", "kg/m3"); });
  };
  EXPECT_NE(message(3).find("density of particle 2"), std::string::npos) << message(3);
  EXPECT_NE(message(2), message(3));
  values[2] = 5;
  EXPECT_NE(message(4).find("holds 3 particles"), std::string::npos) << message(4);
  body[1] = 2;
  EXPECT_NE(message(3).find("particle 1 belongs to body 2"), std::string::npos) << message(3);
}

TEST(PerParticle, VectorsDifferBetweenParticles) {
  const std::vector<Vector<float, 2>> directions{{1, 0}, {0.6F, 0.8F}};
  EXPECT_EQ(OneParticle{1}(vectors(directions)), (Vector<double, 2>(0.6F, 0.8F)));
  const std::string message = hmps_test::message_of([&] { (void)OneParticle{2}(vectors(directions)); });
  EXPECT_NE(message.find("holds 2 particles, but particle 2"), std::string::npos) << message;
}

TEST(PerParticle, TensorsDifferBetweenParticles) {
  hmps::Matrix<float, 2> growth;
  growth << 1, 2, 3, 4;
  const std::vector<hmps::Matrix<float, 2>> tensors{hmps::Matrix<float, 2>::Identity(), growth};
  EXPECT_EQ(OneParticle{1}(hmps::matrices(tensors)), (growth.cast<double>()));
  const std::string message = hmps_test::message_of([&] { (void)OneParticle{2}(hmps::matrices(tensors)); });
  EXPECT_NE(message.find("holds 2 particles, but particle 2"), std::string::npos) << message;
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
    const std::string message =
        hmps_test::message_of([&] { require_positive(scalars(values), 3, "density", "kg/m3"); });
    EXPECT_NE(message.find("density of particle 1"), std::string::npos) << message;
  }
}

}  // namespace per_particle_test
