// SPDX-License-Identifier: MIT
#include "hmps/particles/particles_near.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hmps/particles/surface_lattice.hpp"
#include "hmps/shapes/surface_patch.hpp"
#include "hmps/shapes/surfaces.hpp"

namespace particles_near_test {

using namespace hmps;
using V = Vector<double, 3>;

TEST(ParticlesNear, APatchAreThoseOfItsLayer) {
  constexpr double l0 = 2e-3;
  const auto brick = hmps_test::box_surface<double>(V(0, 0, 0), V(0.016, 0.012, 0.02));
  const std::vector<V> x = fill_lattice(brick, l0, V::Constant(l0 / 2));
  const auto base = surface_patch(brick, [](const V&, const V& normal) { return normal[2] < -0.5; });
  const auto held = particles_near(vectors(x), base, 0.99 * l0);
  EXPECT_EQ(held.size(), 8u * 6u);
  EXPECT_EQ(held.scene_size(), x.size());
  for (const Index i : held) EXPECT_NEAR(x[i][2], l0 / 2, 1e-9);
  EXPECT_THROW((void)particles_near(vectors(x), base, 0.4 * l0), InputError);
  EXPECT_THROW((void)particles_near(vectors(x), base, 0), InputError);
  EXPECT_THROW((void)particles_near(vectors(x), base, 2.0), InputError) << "millimetres";
  // In millimetres too, the patch passes close to the particles around the origin.
  auto in_millimetres = base;
  for (V& vertex : in_millimetres.vertices) vertex *= 1e3;
  EXPECT_THROW((void)particles_near(vectors(x), in_millimetres, 0.99 * l0), InputError);
}

/// At a distance of one and a half spacings a layer lies exactly at the limit, except for rounding.
TEST(ParticlesNear, APatchAreTheSameWhereverTheBodyIs) {
  constexpr double l0 = 2e-3;
  for (const double shift : {0.0, 1e-3, 0.1, 0.37, 1.0, 3.0}) {
    const V lower(shift, -shift, shift);
    const auto brick = hmps_test::box_surface<double>(lower, lower + V(0.016, 0.012, 0.02));
    std::vector<V> x;
    for (int i = 0; i < 8 * 6 * 10; ++i) x.push_back(lower + l0 * V(i % 8 + 0.5, i / 8 % 6 + 0.5, i / 48 + 0.5));
    const auto base = surface_patch(brick, [](const V&, const V& normal) { return normal[2] < -0.5; });
    EXPECT_EQ(particles_near(vectors(x), base, 1.5 * l0).size(), 2u * 48u) << shift;
    EXPECT_EQ(particles_near(vectors(x), base, 0.5 * l0).size(), 48u) << shift;
  }
}

}  // namespace particles_near_test
