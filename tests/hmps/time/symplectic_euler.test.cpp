// SPDX-License-Identifier: MIT
#include "hmps/time/symplectic_euler.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace symplectic_euler_test {

using namespace hmps;

template <class T, int N>
struct Kind {
  using Scalar = T;
  static constexpr int D = N;
};
using Kinds = testing::Types<Kind<double, 2>, Kind<double, 3>, Kind<float, 2>, Kind<float, 3>>;

template <class K>
struct SymplecticEulerOf : testing::Test {};
TYPED_TEST_SUITE(SymplecticEulerOf, Kinds);

TYPED_TEST(SymplecticEulerOf, FunctionsImplementTheEquations) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  std::vector<Vector<T, D>> x(5), v(5), f(5);
  std::vector<float> density{500, 1000, 2000, 4000, 8000};
  for (int i = 0; i < 5; ++i) {
    const auto s = static_cast<std::size_t>(i);
    for (int c = 0; c < D; ++c) {
      x[s][c] = T(i + c);
      v[s][c] = T(2 * i - c);
      f[s][c] = T(1000 * (i + 1) * (c + 1));
    }
  }
  const auto v0 = v, x0 = x;
  kick(vectors(v), vectors(f), scalars(density), 0.25);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(v[i], v0[i] + f[i] * (T(0.25) / static_cast<T>(density[i])));
  const auto v1 = v;
  kick(vectors(v), vectors(f), 1000.0, 0.5);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(v[i], v1[i] + f[i] * T(0.5 / 1000));
  drift(vectors(x), vectors(v), 0.125);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(x[i], x0[i] + v[i] * T(0.125));
}

TYPED_TEST(SymplecticEulerOf, EveryExecutorGivesTheSameBits) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const auto backwards = [](std::size_t n, auto&& body) {
    for (std::size_t i = n; i-- > 0;) body(i);
  };
  std::vector<Vector<T, D>> x(100), v(100), f(100), carry(100, Vector<T, D>::Zero());
  for (std::size_t i = 0; i < 100; ++i) {
    x[i].setConstant(T(0.1) * static_cast<T>(i));
    v[i].setConstant(T(0.3));
    f[i].setConstant(T(-7) * static_cast<T>(i));
  }
  auto x2 = x, v2 = v, carry2 = carry;
  for (int step = 0; step < 10; ++step) {
    kick(vectors(v), vectors(f), 1000.0, 1e-3);
    drift(vectors(x), vectors(v), vectors(carry), 1e-3);
    drift(vectors(x), vectors(v), 1e-3);
    kick(vectors(v2), vectors(f), 1000.0, 1e-3, backwards);
    drift(vectors(x2), vectors(v2), vectors(carry2), 1e-3, backwards);
    drift(vectors(x2), vectors(v2), 1e-3, backwards);
  }
  EXPECT_EQ(x, x2);
  EXPECT_EQ(v, v2);
  EXPECT_EQ(carry, carry2);
}

/// Solves x'' = -x from (1, 0) in `steps` steps. Returns position and velocity after `periods` periods and the largest
/// deviation of the energy on the way.
std::array<double, 3> oscillate(int steps, double periods = 1.25) {
  std::vector<Vector<double, 2>> x(1, Vector<double, 2>(1, 0)), v(1, Vector<double, 2>::Zero()), f(1);
  const double dt = periods * 2 * std::numbers::pi / steps;
  double deviation = 0;
  for (int s = 0; s < steps; ++s) {
    f[0] = -1000 * x[0];
    kick(vectors(v), vectors(f), 1000.0, dt);
    drift(vectors(x), vectors(v), dt);
    deviation = std::max(deviation, std::abs(0.5 * (x[0].squaredNorm() + v[0].squaredNorm()) - 0.5));
  }
  return {x[0][0], v[0][0], deviation};
}

TEST(SymplecticEuler, ConvergesWithTheFirstOrder) {
  const auto error = [](int steps) {
    const auto end = oscillate(steps);
    return std::hypot(end[0] - 0.0, end[1] + 1.0);
  };
  for (const int steps : {200, 400, 800}) {
    const double order = std::log2(error(steps) / error(2 * steps));
    EXPECT_NEAR(order, 1.0, 0.02);
  }
}

TEST(SymplecticEuler, EnergyStaysBoundedForAThousandPeriods) {
  // The scheme keeps (x^2 + v^2 - dt x v) / 2 exactly, and |x v| <= 1/2 up to dt: the energy is off
  // by at most dt / 4 (1 + O(dt)), however long it runs.
  const double dt = 2 * std::numbers::pi / 100;
  EXPECT_LT(oscillate(100, 1)[2], 0.27 * dt);
  EXPECT_LT(oscillate(100 * 1000, 1000)[2], 0.27 * dt);
  EXPECT_GT(oscillate(100 * 1000, 1000)[2], 0.2 * dt);
}

TEST(SymplecticEuler, StaysBoundedUpToTwoOverOmegaOnly) {
  // omega = 1: a step of 1.99 s holds, of 2.01 s explodes.
  EXPECT_LT(oscillate(2000, 2000 * 1.99 / (2 * std::numbers::pi))[2], 1e3);
  EXPECT_GT(oscillate(2000, 2000 * 2.01 / (2 * std::numbers::pi))[2], 1e10);
}

TEST(SymplecticEuler, CompensatedDriftInFloatAgreesWithDouble) {
  // A particle 0.1 m from the origin moves at up to 0.02 m/s: its increment at dt = 1e-5 s is 27 units in the last
  // place of x, so the plain drift loses a few per cent of each.
  const double dt = 1e-5;
  const int steps = 100000;
  std::vector<Vector<float, 2>> plain(1, Vector<float, 2>(0.1f, 0.05f)), kept = plain,
                                                                         carry(1, Vector<float, 2>::Zero()), v(1);
  Vector<double, 2> exact = plain[0].cast<double>();
  double path = 0, worst_plain = 0, worst_kept = 0;
  for (int s = 0; s < steps; ++s) {
    v[0] = Vector<float, 2>(static_cast<float>(0.02 * std::sin(1e-4 * s)), 0.003f);
    drift(vectors(plain), vectors(v), dt);
    drift(vectors(kept), vectors(v), vectors(carry), dt);
    exact += v[0].cast<double>() * dt;
    path += 0.02 * dt;
    worst_plain = std::max(worst_plain, (plain[0].cast<double>() - exact).norm());
    worst_kept = std::max(worst_kept, (kept[0].cast<double>() - exact).norm());
  }
  const double epsilon = std::numeric_limits<float>::epsilon();
  EXPECT_LT(worst_kept, epsilon * (exact.norm() + path));
  EXPECT_GT(worst_plain, 100 * epsilon * (exact.norm() + path));
}

TEST(SymplecticEuler, BadInputIsRefused) {
  std::vector<Vector<double, 2>> x(3, Vector<double, 2>::Zero()), v = x, f = x, few(2, Vector<double, 2>::Zero());
  std::vector<double> density{1000, 0, 1000};
  EXPECT_THROW(kick(vectors(v), vectors(few), 1000.0, 1e-5), InputError);
  EXPECT_THROW(kick(vectors(v), vectors(f), 0.0, 1e-5), InputError);
  EXPECT_THROW(kick(vectors(v), vectors(f), scalars(density), 1e-5), InputError);
  for (const double bad : {0.0, -1e-5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(kick(vectors(v), vectors(f), 1000.0, bad), InputError);
    EXPECT_THROW(drift(vectors(x), vectors(v), bad), InputError);
    EXPECT_THROW(drift(vectors(x), vectors(v), vectors(f), bad), InputError);
  }
  EXPECT_THROW(drift(vectors(x), vectors(few), 1e-5), InputError);
  EXPECT_THROW(drift(vectors(x), vectors(v), vectors(few), 1e-5), InputError);
}

TEST(Drift, RejectsCarriesThatAreNotRoundingErrors) {
  std::vector<hmps::Vector<float, 2>> x(100, {0.1F, -0.2F}), v(100, {1, 0}), carry(100, {0, 0});
  const auto drift = [&] { hmps::drift(hmps::vectors(x), hmps::vectors(v), hmps::vectors(carry), 1e-3); };
  for (int step = 0; step < 3; ++step) EXPECT_NO_THROW(drift());
  for (const float bad : {1.0F, 1e-3F, std::numeric_limits<float>::quiet_NaN()}) {
    for (auto& own : carry) own[1] = bad;
    EXPECT_THROW(drift(), hmps::InputError) << bad;
  }
  // A run that has become unstable is for `check_state` to report.
  x[0][0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NO_THROW(drift());
}

}  // namespace symplectic_euler_test
