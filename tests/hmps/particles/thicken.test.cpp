// SPDX-License-Identifier: MIT
#include "hmps/particles/thicken.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hmps/particles/lattice.hpp"
#include "hmps/shapes/combine.hpp"

namespace thicken_test {

using hmps::Box;
using hmps::Vector;

template <class S>
class Thicken : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Thicken, Scalars);

TYPED_TEST(Thicken, SupportsAThinOrganThatRemovalWouldDestroy) {
  using S = TypeParam;
  using V = Vector<S, 3>;
  const double l0 = 1e-3;
  const hmps::SupportSettings settings{.spacing = l0};
  // A curved sheet little more than one spacing thick.
  const auto sheet = hmps::shell(hmps::Ball<S, 3>{.radius = S(0.012)}, S(1.3e-3));
  const auto points = hmps::fill_lattice(sheet, Box<S, 3>{V::Constant(S(-0.014)), V::Constant(S(0.014))}, S(l0));
  const auto weak = hmps::find_weak(hmps::vectors(points), settings);
  ASSERT_GT(weak.size(), 100u);
  EXPECT_THROW((void)hmps::supported_particles(hmps::vectors(points), settings), hmps::InputError);  // removes all

  const auto added = hmps::thicken(hmps::vectors(points), settings);
  EXPECT_LE(added.size(), 2 * weak.size());
  auto all = points;
  all.insert(all.end(), added.begin(), added.end());
  EXPECT_LE(hmps::find_weak(hmps::vectors(all), settings).size(), weak.size() / 100);
  EXPECT_GE(hmps::supported_particles(hmps::vectors(all), settings).size(), points.size());
  // The added particles lie on the lattice, beside the sheet.
  for (const V& x : added) {
    EXPECT_GE(sheet(x), S(0));
    EXPECT_LE(sheet(x), S(2.5e-3));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(x[c] / S(l0), std::round(x[c] / S(l0)), S(1e-4));
  }
}

TYPED_TEST(Thicken, LeavesForbiddenSitesFreeAndSupportedBodiesAlone) {
  using S = TypeParam;
  using V = Vector<S, 2>;
  const hmps::SupportSettings settings{.spacing = 1, .threshold = 0.5};
  const auto block = hmps::fill_lattice(Box<S, 2>{V(-1, -1), V(6, 6)}, Box<S, 2>{V(0, 0), V(5, 5)}, S(1));
  EXPECT_TRUE(hmps::thicken(hmps::vectors(block), settings).empty());
  const std::vector<V> none;
  EXPECT_TRUE(hmps::thicken(hmps::vectors(none), settings).empty());
  // A row along x grows to one side only, where it may.
  std::vector<V> row;
  for (int k = 0; k < 8; ++k) row.push_back(V(static_cast<S>(k), 0));
  const auto above = hmps::thicken(hmps::vectors(row), settings, [](const V& x) { return x[1] > S(0.5); });
  EXPECT_GE(above.size(), 4u);
  for (const V& x : above) EXPECT_GT(x[1], S(0.5));
  EXPECT_TRUE(hmps::thicken(hmps::vectors(row), settings, [](const V&) { return false; }).empty());
}

TYPED_TEST(Thicken, RejectsCloudsThatAreNotALattice) {
  using S = TypeParam;
  using V = Vector<S, 2>;
  std::vector<V> points{V(0, 0), V(1, 0), V(S(1.3), 1)};
  EXPECT_THROW((void)hmps::thicken(hmps::vectors(points), {.spacing = 1}), hmps::InputError);
  points[2] = points[1];
  EXPECT_THROW((void)hmps::thicken(hmps::vectors(points), {.spacing = 1}), hmps::InputError);
  points[2] = V(1, 1);
  EXPECT_THROW((void)hmps::thicken(hmps::vectors(points), {.spacing = 0}), hmps::InputError);
  EXPECT_THROW((void)hmps::thicken(hmps::vectors(points), {.spacing = S(0.5)}), hmps::InputError)
      << "each second site of a lattice that is too fine";
  EXPECT_NO_THROW((void)hmps::thicken(hmps::vectors(points), {.spacing = 1}));
}

// Every particle would stay weak, and the body would grow in each pass.
TEST(ThickenMisuse, RefusesAThresholdThatNoParticleReaches) {
  using V = Vector<double, 3>;
  const auto points = hmps::fill_lattice(Box<double, 3>{V(0, 0, 0), V(4, 4, 4)}, 1.0);
  EXPECT_NO_THROW((void)hmps::thicken(hmps::vectors(points), {.spacing = 1, .threshold = 3.4}));
  EXPECT_THROW((void)hmps::thicken(hmps::vectors(points), {.spacing = 1, .threshold = 3.6}), hmps::InputError);
  EXPECT_THROW((void)hmps::thicken(hmps::vectors(points), {.spacing = 1, .radius_ratio = 1.2}), hmps::InputError)
      << "the threshold is that of another radius";
}

}  // namespace thicken_test
