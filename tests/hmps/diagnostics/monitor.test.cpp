// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/monitor.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace monitor_test {

using namespace hmps;

template <class T>
struct MonitorIn : testing::Test {
  std::vector<Vector<T, 3>> x = std::vector<Vector<T, 3>>(3000, Vector<T, 3>::Zero());
  std::vector<Vector<T, 3>> v = x;
  std::vector<Matrix<T, 3>> F = std::vector<Matrix<T, 3>>(3000, Matrix<T, 3>::Identity());
  StateLimits limits{.time = 1.25, .speed_limit = 44.8, .organ_name = [](std::size_t i) {
                       return i < 2000 ? std::string("the tongue") : std::string("the epiglottis");
                     }};
  std::optional<Fault> fault() { return find_fault(vectors(x), vectors(v), matrices(F), limits); }
  void expect_words(const std::string& text, const std::vector<std::string>& words) {
    for (const auto& word : words) EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
  }
};
using Scalars = testing::Types<double, float>;
TYPED_TEST_SUITE(MonitorIn, Scalars);

TYPED_TEST(MonitorIn, AcceptsAValidState) {
  this->v[5][0] = TypeParam(44.7);
  EXPECT_FALSE(this->fault().has_value());
  EXPECT_NO_THROW(check_state(vectors(this->x), vectors(this->v), matrices(this->F), this->limits));
  EXPECT_NO_THROW(check_state(vectors(this->x), vectors(this->v), this->limits));
}

TYPED_TEST(MonitorIn, MostInvertedParticleIsNamed) {
  this->F[100](0, 0) = TypeParam(-0.25);
  this->F[2500](0, 0) = TypeParam(-0.5);
  this->F[2600](0, 0) = TypeParam(-0.5);
  const auto fault = this->fault();
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->kind, FaultKind::inverted);
  EXPECT_EQ(fault->particle, 2500u);
  EXPECT_EQ(fault->value, -0.5);
  this->expect_words(fault->message,
                     {"t = 1.25 s", "particle 2500", "the epiglottis", "det F is -0.5", "time step", "Continued"});
  try {
    check_state(vectors(this->x), vectors(this->v), matrices(this->F), this->limits);
    FAIL() << "nothing was thrown";
  } catch (const StateError& error) {
    EXPECT_EQ(error.what(), fault->message);
  }
}

TYPED_TEST(MonitorIn, FlattenedParticleCountsAsInverted) {
  this->F[7](0, 0) = 0;
  const auto fault = this->fault();
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->kind, FaultKind::inverted);
  EXPECT_EQ(fault->value, 0.0);
}

TYPED_TEST(MonitorIn, NotANumberComesFirstWhereverItIs) {
  this->F[1](0, 0) = TypeParam(-1);
  for (const TypeParam bad :
       {std::numeric_limits<TypeParam>::quiet_NaN(), std::numeric_limits<TypeParam>::infinity()}) {
    const auto expect_first = [&](TypeParam& component, const char* name) {
      const TypeParam old = component;
      component = bad;
      this->v[2900][2] = bad;  // a later one
      const auto fault = this->fault();
      component = old;
      this->v[2900][2] = 0;
      ASSERT_TRUE(fault.has_value());
      EXPECT_EQ(fault->kind, FaultKind::not_finite);
      EXPECT_EQ(fault->particle, 1500u);
      this->expect_words(fault->message, {"particle 1500", "the tongue", name, "component 1", "stable_step"});
    };
    expect_first(this->x[1500][1], "position");
    expect_first(this->v[1500][1], "velocity");
    expect_first(this->F[1500](1, 0), "deformation gradient");
  }
}

TYPED_TEST(MonitorIn, FastestParticleIsNamed) {
  this->v[10] = Vector<TypeParam, 3>(30, 40, 0);
  this->v[2999] = Vector<TypeParam, 3>(0, 60, 80);
  const auto fault = this->fault();
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->kind, FaultKind::too_fast);
  EXPECT_EQ(fault->particle, 2999u);
  EXPECT_EQ(fault->value, 100.0);
  this->expect_words(fault->message, {"100 m/s", "44.8 m/s", "the epiglottis"});
  EXPECT_THROW(check_state(vectors(this->x), vectors(this->v), this->limits), StateError);
  this->limits.speed_limit = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(this->fault().has_value());
}

TEST(Monitor, MessageWorksWithoutTimeAndOrgan) {
  std::vector<Vector<double, 2>> x(2, Vector<double, 2>::Zero()), v(2, Vector<double, 2>(0, 3));
  const auto fault = find_fault(vectors(x), vectors(v), {.speed_limit = 1});
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->particle, 0u);
  EXPECT_EQ(fault->message.find("t ="), std::string::npos);
  EXPECT_EQ(fault->message.rfind("hmps: particle 0: its speed is 3 m/s", 0), 0u) << fault->message;
}

// Entries of 1e110 are finite, but det F is NaN or infinite.
TEST(Monitor, NamesAParticleWhoseVolumeOverflows) {
  const std::vector<Vector<double, 3>> x(4, Vector<double, 3>::Zero()), v = x;
  Matrix<double, 3> full;
  full << 1, 2, 3, 4, 5, 7, 7, 8, 10;
  for (const Matrix<double, 3>& shape : {full, Matrix<double, 3>(Matrix<double, 3>::Identity())}) {
    std::vector<Matrix<double, 3>> F(4, Matrix<double, 3>::Identity());
    F[2] = 1e110 * shape;
    const auto fault = find_fault(vectors(x), vectors(v), matrices(F), StateLimits{});
    ASSERT_TRUE(fault.has_value()) << shape;
    EXPECT_EQ(fault->kind, FaultKind::not_finite);
    EXPECT_EQ(fault->particle, 2u);
  }
}

TEST(Monitor, ViewsOfDifferentSizesAreRefused) {
  std::vector<Vector<double, 2>> x(3, Vector<double, 2>::Zero()), few(2, Vector<double, 2>::Zero());
  std::vector<Matrix<double, 2>> F(2, Matrix<double, 2>::Identity());
  EXPECT_THROW(check_state(vectors(x), vectors(few), {}), InputError);
  EXPECT_THROW(check_state(vectors(x), vectors(x), matrices(F), {}), InputError);
}

TEST(CheckState, RefusesANegativeSpeedLimit) {
  const std::vector<Vector<double, 3>> x(2, Vector<double, 3>::Zero());
  EXPECT_THROW(check_state(vectors(x), vectors(x), {.speed_limit = -1}), InputError);
  EXPECT_NO_THROW(check_state(vectors(x), vectors(x), {.speed_limit = 1}));
}

}  // namespace monitor_test
