// SPDX-License-Identifier: MIT
#include "hmps/particles/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace support_test {

using hmps::Index;
using hmps::Vector;

template <class S_, int D_>
struct Case {
  using S = S_;
  static constexpr int D = D_;
};
template <class T>
class Support : public testing::Test {
 public:
  using Scalar = typename T::S;
  static constexpr int dimension = T::D;
  using Points = std::vector<Vector<Scalar, dimension>>;
  static constexpr double l0 = 1.2e-3;

  /// The block of `counts` sites from `first`, in metres.
  static void add_block(Points& points, const Vector<double, dimension>& first, const Vector<int, dimension>& counts) {
    Vector<int, dimension> k = Vector<int, dimension>::Zero();
    for (;;) {
      points.push_back((l0 * (first + k.template cast<double>())).template cast<Scalar>());
      int c = dimension - 1;
      for (; c >= 0 && k[c] + 1 == counts[c]; --c) k[c] = 0;
      if (c < 0) return;
      ++k[c];
    }
  }
  static Vector<double, dimension> at(double x) { return x * Vector<double, dimension>::Unit(0); }
  static Vector<int, dimension> all(int n) { return Vector<int, dimension>::Constant(n); }
};
using Cases = testing::Types<Case<float, 2>, Case<double, 2>, Case<float, 3>, Case<double, 3>>;
TYPED_TEST_SUITE(Support, Cases);

/// The paper's weight at distance 1, sqrt 2 and sqrt 3 spacings.
const double w1 = 0.75, w2 = 1.75 / std::sqrt(2.0) - 1, w3 = 1.75 / std::sqrt(3.0) - 1;

TYPED_TEST(Support, IsTheSmallestEigenvalueInSquaredSpacings) {
  using F = TestFixture;
  constexpr int D = F::dimension;
  typename F::Points points;
  F::add_block(points, F::at(0), F::all(5));
  // A threshold above all supports makes every particle weak, and so shows its support.
  const auto weak = hmps::find_weak(hmps::vectors(points), {.spacing = F::l0, .threshold = 100});
  ASSERT_EQ(weak.size(), points.size());
  // Sum over the neighbours along one axis: at the centre of a block and at its corner.
  const double full = D == 2 ? 2 * w1 + 4 * w2 : 2 * w1 + 8 * w2 + 8 * w3;
  const double tolerance = 2e-6;
  EXPECT_NEAR(weak[points.size() / 2].support, full, tolerance);
  // At the corner A is a quarter (an eighth, with halves for faces) on the diagonal, and the
  // off-diagonal terms do not cancel: smallest eigenvalue = diagonal - off-diagonal.
  const double diagonal = D == 2 ? w1 + w2 : w1 + 2 * w2 + w3;
  const double mixed = D == 2 ? w2 : w2 + w3;
  EXPECT_NEAR(weak[0].support, diagonal - mixed, tolerance);
  for (std::size_t k = 0; k < weak.size(); ++k) EXPECT_EQ(weak[k].particle, k);
}

TYPED_TEST(Support, FindsAndRemovesOnlyWhiskers) {
  using F = TestFixture;
  constexpr int D = F::dimension;
  typename F::Points points;
  F::add_block(points, F::at(0), F::all(4));
  const std::size_t block = points.size();
  // A row of single particles that sticks out of the middle of a face; first in the list, to see
  // that the order is kept.
  Vector<int, D> row = F::all(1);
  row[0] = 3;
  Vector<double, D> out = F::at(4);
  for (int c = 1; c < D; ++c) out[c] = 1;
  typename F::Points mixed;
  F::add_block(mixed, out, row);
  mixed.insert(mixed.end(), points.begin(), points.end());
  const hmps::SupportSettings settings{.spacing = F::l0, .threshold = 0.7};
  const auto weak = hmps::find_weak(hmps::vectors(mixed), settings);
  // The base of the whisker stands on the face and may be supported; its middle and tip are not.
  ASSERT_GE(weak.size(), 2u);
  EXPECT_EQ(weak.back().particle, 2u);
  EXPECT_NEAR(weak.back().support, 0, 1e-6);
  const auto left = hmps::supported_particles(hmps::vectors(mixed), settings);
  EXPECT_GE(left.size(), block);
  EXPECT_LE(left.size(), block + 1);
  EXPECT_TRUE(std::is_sorted(left.begin(), left.end()));
  EXPECT_FALSE(left(1) || left(2));
  EXPECT_EQ(left.scene_size(), mixed.size());
  for (const auto& [particle, support] : weak) EXPECT_TRUE((~left)(particle)) << "with the support " << support;
}

TYPED_TEST(Support, RemovalIsIndependentOfTheOrderAndLeavesNoWeakParticle) {
  using F = TestFixture;
  constexpr int D = F::dimension;
  std::mt19937 random(17);
  typename F::Points points;
  F::add_block(points, F::at(0), F::all(D == 2 ? 24 : 9));
  std::shuffle(points.begin(), points.end(), random);
  points.resize(points.size() * 3 / 5);
  const hmps::SupportSettings settings{.spacing = F::l0, .threshold = D == 2 ? 0.5 : 0.75, .smallest_piece = 0};
  const auto survivors = [&](const typename F::Points& cloud) {
    typename F::Points result;
    for (const Index i : hmps::supported_particles(hmps::vectors(cloud), settings)) result.push_back(cloud[i]);
    return result;
  };
  auto first = survivors(points);
  EXPECT_TRUE(hmps::find_weak(hmps::vectors(first), settings).empty());
  EXPECT_GT(first.size(), points.size() / 10);
  EXPECT_LT(first.size(), points.size());
  std::shuffle(points.begin(), points.end(), random);
  auto second = survivors(points);
  const auto before = [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.data(), a.data() + D, b.data(), b.data() + D);
  };
  std::sort(first.begin(), first.end(), before);
  std::sort(second.begin(), second.end(), before);
  EXPECT_EQ(first, second);
}

TYPED_TEST(Support, DropsLoosePiecesButNotWhatIsKept) {
  using F = TestFixture;
  typename F::Points points;
  F::add_block(points, F::at(0), F::all(6));
  const std::size_t large = points.size();
  F::add_block(points, F::at(20), F::all(2));
  hmps::SupportSettings settings{.spacing = F::l0, .threshold = 0.1, .smallest_piece = 0.25};
  EXPECT_EQ(hmps::supported_particles(hmps::vectors(points), settings).size(), large);
  settings.smallest_piece = 0;
  EXPECT_EQ(hmps::supported_particles(hmps::vectors(points), settings).size(), points.size());
  settings.smallest_piece = 0.25;
  const auto keep = [&](std::size_t i) { return i == large; };
  EXPECT_EQ(hmps::supported_particles(hmps::vectors(points), settings, keep).size(), points.size());
  // A threshold that removes all but what is kept.
  settings.threshold = 100;
  EXPECT_EQ(hmps::supported_particles(hmps::vectors(points), settings, keep).indices(),
            std::vector<Index>{static_cast<Index>(large)});
}

TYPED_TEST(Support, CountsOnlyBondsThatThePredicateAllows) {
  using F = TestFixture;
  constexpr int D = F::dimension;
  // Two layers that support each other only if they are one body.
  typename F::Points points;
  Vector<int, D> layer = F::all(6);
  layer[0] = 1;
  F::add_block(points, F::at(0), layer);
  const std::size_t half = points.size();
  F::add_block(points, F::at(1), layer);
  const hmps::SupportSettings settings{.spacing = F::l0, .threshold = 0.5};
  const auto same_body = [&](std::size_t i, std::size_t j) { return (i < half) == (j < half); };
  EXPECT_TRUE(hmps::find_weak(hmps::vectors(points), settings).empty());
  EXPECT_EQ(hmps::find_weak(hmps::vectors(points), settings, same_body).size(), points.size());
  try {
    (void)hmps::supported_particles(hmps::vectors(points), settings, hmps::KeepNone{}, same_body);
    ADD_FAILURE() << "an empty body is left in silence";
  } catch (const hmps::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("thicken the body"), std::string::npos) << error.what();
  }
}

TYPED_TEST(Support, NamesTheSpacingWhereNothingIsLeft) {
  using F = TestFixture;
  typename F::Points points;
  F::add_block(points, F::at(0), F::all(6));
  typename F::Points none;
  EXPECT_TRUE(hmps::supported_particles(hmps::vectors(none), {.spacing = 1}).empty());
  EXPECT_THROW((void)hmps::supported_particles(hmps::vectors(points), {.spacing = 0.9 * F::l0}), hmps::InputError);
  for (auto& x : points) x[0] *= 1.1f;  // no lattice, whose spacing would be known
  for (const double factor : {0.4, 1e-3}) {
    try {
      (void)hmps::supported_particles(hmps::vectors(points), {.spacing = factor * F::l0});
      ADD_FAILURE() << "an empty body is left in silence";
    } catch (const hmps::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("finds none"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("is the spacing"), std::string::npos) << error.what();
    }
  }
}

TYPED_TEST(Support, RejectsInvalidSettings) {
  using F = TestFixture;
  typename F::Points points;
  F::add_block(points, F::at(0), F::all(2));
  const auto view = hmps::vectors(points);
  EXPECT_THROW((void)hmps::find_weak(view, {}), hmps::InputError);
  EXPECT_THROW((void)hmps::find_weak(view, {.spacing = -1}), hmps::InputError);
  EXPECT_THROW((void)hmps::find_weak(view, {.spacing = 1, .radius_ratio = 0}), hmps::InputError);
  EXPECT_THROW((void)hmps::find_weak(view, {.spacing = 1, .threshold = -1}), hmps::InputError);
  EXPECT_THROW((void)hmps::supported_particles(view, {.spacing = 1, .smallest_piece = 2}), hmps::InputError);
  points[1] = points[0];
  EXPECT_THROW((void)hmps::find_weak(hmps::vectors(points), {.spacing = F::l0}), hmps::InputError);
}

TEST(SupportMisuse, IsRefused) {
  std::vector<Vector<double, 3>> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(i % 10, i / 10 % 10, i / 100);
  EXPECT_THROW((void)hmps::find_weak(hmps::vectors(points), {.spacing = 1e3}), hmps::InputError);
  const hmps::ParticleSet other(3, [](std::size_t) { return true; });
  EXPECT_THROW((void)hmps::supported_particles(hmps::vectors(points), {.spacing = 1}, other), hmps::InputError);
}

}  // namespace support_test
