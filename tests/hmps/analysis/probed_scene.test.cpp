// SPDX-License-Identifier: MIT
#include "hmps/analysis/probed_scene.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace probed_scene_test {

using namespace hmps;

struct Spring {
  template <class X, class V, class F>
  void operator()(const X& x, const V& v, const F& f) const {
    for (std::size_t i = 0; i < x.size(); ++i) f.add(i, x[i] * (-4e6) + v[i] * (-2e3));
  }
};
struct NotAForce {
  void operator()(double) const {}
};
static_assert(ProbedForce<Spring, double, 3> && ProbedForce<Spring, float, 2>);
static_assert(!ProbedForce<NotAForce, double, 3>);

TEST(ProbedScene, DerivativesOfALinearForceAreExact) {
  std::vector<Vector<double, 2>> x{{1, 2}, {3, 4}}, v{{5, 6}, {7, 8}};
  const Spring spring;
  const double density = 1000;
  detail::ProbedScene<double, 2> scene("test", spring, vectors(x), vectors(v), density, 1e-3, Serial{});
  detail::Direction<2> direction(2);
  direction.y = {{0.5, -0.25}, {0, 1}};
  scene.probe(direction);
  scene.forget_damping_if_none(direction);
  EXPECT_TRUE(scene.damped());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((direction.stiffness[i] - 4e3 * direction.y[i]).norm(), 1e-6);
    EXPECT_LT((direction.damping[i] - 2.0 * direction.y[i]).norm(), 1e-6);
  }
}

TEST(ProbedScene, VectorAlgebra) {
  std::vector<Vector<double, 2>> x(3, Vector<double, 2>::Zero());
  const Spring spring;
  const double density = 1000;
  detail::ProbedScene<double, 2> scene("test", spring, vectors(x), vectors(x), density, 1e-3, Serial{});
  detail::Direction<2> a(3), b(3);
  a.y = {{3, 0}, {0, 4}, {0, 0}};
  b.y = {{1, 1}, {1, 1}, {1, 1}};
  EXPECT_TRUE(scene.normalise(a, 1.0));
  EXPECT_NEAR(scene.dot(a.y, a.y), 1.0, 1e-15);
  scene.project_out(b, a);
  EXPECT_NEAR(scene.dot(a.y, b.y), 0.0, 1e-15);
  detail::Direction<2> nothing(3);
  EXPECT_FALSE(scene.normalise(nothing, 1.0));
}

TEST(ProbedScene, NoiseIsCentredAndFillsItsInterval) {
  double sum = 0, squares = 0, largest = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double value = detail::noise(static_cast<std::uint64_t>(i));
    sum += value;
    squares += value * value;
    largest = std::max(largest, std::abs(value));
  }
  // A uniform density on (-1, 1): mean 0 with deviation 1 / sqrt(3 n), mean square 1/3.
  EXPECT_NEAR(sum / n, 0.0, 4 / std::sqrt(3.0 * n));
  EXPECT_NEAR(squares / n, 1.0 / 3, 0.01);
  EXPECT_LT(largest, 1.0);
  EXPECT_GT(largest, 0.99);
}

}  // namespace probed_scene_test
