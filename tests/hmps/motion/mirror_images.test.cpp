// SPDX-License-Identifier: MIT
#include "hmps/motion/mirror_images.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "../bonds/bonds_of_a_scene.hpp"
#include "hmps/analysis/relaxation.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/gravity.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/viscous.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace mirror_images_test {

using namespace hmps;
using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;
using V2 = Vector<double, 2>;
using V3 = Vector<double, 3>;

constexpr double l0 = 1e-3, rho = 1000;

/// A bar of 4 x 3 particles along x, whose layers lie at `first`, `first` + l0, ... up to `last`.
std::vector<V3> bar(double first, double last) {
  return fill_lattice(Box<double, 3>{V3(first - l0 / 2, 0, 0), V3(last + l0 / 2, 4 * l0, 3 * l0)}, l0,
                      V3(first, l0 / 2, l0 / 2));
}

/// Runs a bar that falls between clamps at its ends, where |x| > `clamp`, after each drift with `finish(x, v)`.
template <class Finish, class... Terms>
std::vector<V3> fall(const std::vector<V3>& reference, double clamp, const Finish& finish, const Terms&... terms) {
  const BondList<double, 3> bonds(vectors(reference), {.spacing = l0});
  const auto law = NeoHookean<>::from_young_poisson(20e3, 0.4);
  auto force = internal_force(bonds, elastic(law), artificial(law.shear_modulus()), viscous(rho, 1e-3),
                              gravity(rho, V3(0, 0, -9.81)), terms...);
  std::vector<V3> x = reference, v(x.size(), V3::Zero()), f = v;
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = 40 * V3(-reference[i][0], 0, std::abs(reference[i][0]));
  for (int step = 0; step < 150; ++step) {
    constexpr double dt = 5e-5;
    force(vectors(x), vectors(v), vectors(f));
    kick(vectors(v), vectors(f), rho, dt);
    for (std::size_t i = 0; i < v.size(); ++i)
      if (std::abs(reference[i][0]) > clamp) v[i].setZero();
    drift(vectors(x), vectors(v), dt);
    finish(vectors(x), vectors(v));
  }
  return x;
}

/// The largest distance between the half of the bar and its images, and the same particles of the whole bar.
template <class... Terms>
double difference_from_the_whole(double first, double last, const Terms&... terms) {
  const auto whole = bar(-last, last), half = bar(first, last);
  const MirrorImages<3> images(vectors(half), l0, V3::Zero(), V3(-2, 0, 0));
  const double clamp = last - l0 / 2;
  const auto expected = fall(
      whole, clamp, [](const auto&, const auto&) {}, terms...);
  const auto found = fall(
      half, clamp, [&](const auto& x, const auto& v) { images.place(x, v); }, terms...);
  double largest = 0, moved = 0;
  for (std::size_t i = 0; i < half.size(); ++i)
    for (std::size_t j = 0; j < whole.size(); ++j)
      if ((half[i] - whole[j]).norm() < l0 / 4) {
        largest = std::max(largest, (found[i] - expected[j]).norm());
        moved = std::max(moved, (expected[j] - whole[j]).norm());
      }
  EXPECT_GT(moved, 0.3 * l0);
  return largest;
}

TEST(MirrorImages, HalfABarMovesAsTheWhole) {
  EXPECT_LT(difference_from_the_whole(-2 * l0, 10 * l0), 1e-9 * l0);     // the plane passes through a layer
  EXPECT_LT(difference_from_the_whole(-1.5 * l0, 9.5 * l0), 1e-9 * l0);  // the plane lies between two
}

// Its mean takes the images further away, and its scales the whole body.
TEST(MirrorImages, NeedMoreLayersWithMeanDilatation) {
  EXPECT_LT(difference_from_the_whole(-4 * l0, 10 * l0, mean_dilatation(1e5)), 5e-5 * l0);
  EXPECT_LT(difference_from_the_whole(-6 * l0, 10 * l0, mean_dilatation<2>(1e5)), 5e-5 * l0);
  EXPECT_GT(difference_from_the_whole(-2 * l0, 10 * l0, mean_dilatation(1e5)), 1e-3 * l0);
}

// With one layer of images, half a bar would differ from the whole by more than 1e-3 l0.
TEST(MirrorImages, ThatAreMissingAreErrors) {
  const auto error = [](const std::vector<V3>& X) {
    return error_of([&] { (void)MirrorImages<3>(vectors(X), l0, V3::Zero(), V3(-1, 0, 0)); });
  };
  EXPECT_TRUE(has(error(bar(-l0, 6 * l0)), "the images reach only 0.001 m behind the plane"));
  EXPECT_TRUE(has(error(bar(-0.5 * l0, 5.5 * l0)), "the images reach only 0.0005 m behind the plane"));
  auto X = bar(-2 * l0, 6 * l0);
  for (std::size_t i = 0; i < X.size(); ++i)
    if (X[i][0] < -0.5 * l0 && X[i][0] > -1.5 * l0) {
      X.erase(X.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
  EXPECT_TRUE(has(error(X), "has no image"));
}

// The recipe of the class for forces whose positions are read-only.
TEST(MirrorImages, HalfABarComesToRestAsTheWhole) {
  const double last = 8 * l0;
  const auto sag = [&](const std::vector<V3>& reference, const auto& moves, const auto& place) {
    const BondList<double, 3> bonds(vectors(reference), {.spacing = l0});
    const auto law = NeoHookean<>::from_young_poisson(20e3, 0.4);
    auto inner = internal_force(bonds, elastic(law), artificial(law.shear_modulus()), viscous(rho, 1e-3),
                                gravity(rho, V3(0, 0, -9.81)));
    std::vector<V3> x = reference, v(x.size(), V3::Zero()), f = v, placed = reference, moving = v;
    const auto force = [&](const auto& at, const auto& velocities, const auto& forces) {
      for (std::size_t i = 0; i < placed.size(); ++i) placed[i] = at[i], moving[i] = velocities[i];
      place(vectors(placed), vectors(moving));
      inner(vectors(placed), vectors(moving), forces);
    };
    (void)relax(force, vectors(x), vectors(v), vectors(f), rho,
                {.spacing = l0, .tolerance = 1e-6, .load = rho * 9.81 * 1e-7, .moves = moves});
    double lowest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) lowest = std::max(lowest, reference[i][2] - x[i][2]);
    return lowest;
  };
  const auto whole = bar(-last, last), half = bar(-2 * l0, last);
  const MirrorImages<3> images(vectors(half), l0, V3::Zero(), V3(-1, 0, 0));
  const double expected = sag(
      whole, [&](std::size_t i) { return std::abs(whole[i][0]) < last - l0 / 2; }, [](const auto&, const auto&) {});
  const double found = sag(
      half, [&](std::size_t i) { return half[i][0] < last - l0 / 2 && !images.particles()(i); },
      [&](const auto& x, const auto& v) { images.place(x, v); });
  EXPECT_GT(expected, 1e-3 * l0);
  EXPECT_NEAR(found / expected, 1, 1e-4);
}

// The images keep the places of the reference: a body at rest stays at rest.
TEST(MirrorImages, OfAPlaneThatIsSlightlyOffExertNoForce) {
  const auto X = bar(-2 * l0, 6 * l0);
  const MirrorImages<3> images(vectors(X), l0, V3(4e-3 * l0, 0, 0), V3(-1, 1e-4, 0));
  auto x = X;
  images.place(vectors(x));
  for (std::size_t i = 0; i < X.size(); ++i) EXPECT_LT((x[i] - X[i]).norm(), 1e-12 * l0) << i;
}

TEST(MirrorImages, AreMirroredAtAPlaneAtAnyAngle) {
  const std::vector<V2> X{{0, 0}, {1, 1}, {2, 0}, {0, 2}, {3, 0}, {0, 3}};  // mirrored at y = x
  const MirrorImages<2> images(vectors(X), 1, V2(5, 5), V2(-1, 1));
  EXPECT_EQ(images.particles().indices(), (std::vector<Index>{3, 5}));
  std::vector<V2> x = X, v(X.size(), V2(0, 1));
  x[0] = V2(0.5, 0), x[2] = V2(2, 0.25), x[4] = V2(3, -1), v[2] = V2(1, 0), v[4] = V2(0, 2);
  images.place(vectors(x), vectors(v));
  const auto is = [](const V2& a, const V2& b) { return (a - b).norm() < 1e-15 * 16; };
  EXPECT_TRUE(is(x[0], V2(0.25, 0.25)) && is(x[1], V2(1, 1)) && is(x[2], V2(2, 0.25))) << x[0].transpose();
  EXPECT_TRUE(is(x[3], V2(0.25, 2)) && is(x[5], V2(-1, 3))) << x[3].transpose() << ", " << x[5].transpose();
  EXPECT_TRUE(is(v[0], V2(0.5, 0.5)) && is(v[3], V2(0, 1)) && is(v[5], V2(2, 0))) << v[3].transpose();
}

TEST(MirrorImages, OfBodiesThatAreNotSymmetricAreErrors) {
  auto X = bar(-4 * l0, 6 * l0);
  const auto make = [&](const V3& point, const V3& normal, double spacing = l0) {
    return error_of([&] { (void)MirrorImages<3>(vectors(X), spacing, point, normal); });
  };
  EXPECT_EQ(make(V3::Zero(), V3(-1, 0, 0)), "nothing was thrown");
  EXPECT_TRUE(has(make(V3(0.3 * l0, 0, 0), V3(-1, 0, 0)), "no particle lies at its mirrored position"));
  EXPECT_TRUE(has(make(V3::Zero(), V3(1, 0, 0)), "no particle lies at its mirrored position"));  // the longer side
  EXPECT_TRUE(has(make(V3(-1, 0, 0), V3(-1, 0, 0)), "no particle lies behind the plane"));
  EXPECT_TRUE(has(make(V3::Zero(), V3::Zero()), "nonzero length"));
  EXPECT_TRUE(has(make(V3(std::numeric_limits<double>::quiet_NaN(), 0, 0), V3(-1, 0, 0)), "finite"));
  for (const double spacing : {0.0, 1e-3 * l0, 1e3 * l0})
    EXPECT_TRUE(has(make(V3::Zero(), V3(-1, 0, 0), spacing), "spacing of mirror images")) << spacing;
  const MirrorImages<3> images(vectors(X), l0, V3::Zero(), V3(-1, 0, 0));
  std::vector<V3> less(X.size() - 1);
  EXPECT_THROW(images.place(vectors(less)), InputError);
  EXPECT_THROW(images.place(vectors(X), vectors(less)), InputError);
}

}  // namespace mirror_images_test
