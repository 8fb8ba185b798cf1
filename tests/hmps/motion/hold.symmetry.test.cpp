// SPDX-License-Identifier: MIT
// Where the plane of symmetry of half a body lies: the figures of docs/choosing.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hmps/analysis/relaxation.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/motion/hold.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/gravity.hpp"
#include "hmps/terms/shear_wave_modulus.hpp"

namespace hold_symmetry_test {

using namespace hmps;
using Point = Vector<double, 3>;

constexpr double l0 = 2e-3, length = 0.04, density = 1000, gravity_size = 2;  // m, m, kg/m3, m/s2

enum class Volumes { whole, halved };

/// How far the middle of a bar of 5 x 5 particles that is clamped at both ends sinks under its weight (m). Its layers
/// lie at `first` and every spacing beyond; if `first` is not the clamp at -`length`, that layer is a plane of
/// symmetry.
double sag(double first, Volumes volumes) {
  const bool whole = first < -0.9 * length;
  const Box<double, 3> bar{Point(first - l0 / 2, 0, 0), Point(length, 0.01, 0.01)};
  const std::vector<Point> reference = fill_lattice(bar, l0, Point(first, l0 / 2, l0 / 2));
  std::vector<double> volume(reference.size(), l0 * l0 * l0);
  double last = first;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    last = std::max(last, reference[i][0]);
    if (volumes == Volumes::halved && reference[i][0] < first + l0 / 4) volume[i] /= 2;
  }
  const BondList<double, 3> bonds(vectors(reference), {.spacing = l0}, scalars(volume));
  const auto law = NeoHookean<>::from_young_poisson(20e3, 0.3);
  auto force = internal_force(bonds, elastic(law), artificial(shear_wave_modulus(law.shear_modulus())),
                              gravity(density, Point(0, 0, -gravity_size)));
  std::vector<Point> x = reference, v(x.size(), Point::Zero()), f = v;
  (void)relax(force, vectors(x), vectors(v), vectors(f), density,
              {.spacing = l0,
               .tolerance = 1e-3,
               .load = density * gravity_size * length * 1e-4,
               .moves =
                   [&](std::size_t i) {
                     return reference[i][0] < last - l0 / 4 && (!whole || reference[i][0] > first + l0 / 4);
                   },
               .moves_along = [&](std::size_t i, int c) { return c > 0 || whole || reference[i][0] > first + l0 / 4; },
               .volume = [&](std::size_t i) { return volume[i]; }});
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(reference[i][0]) < 0.75 * l0) {
      sum += reference[i][2] - x[i][2];
      ++count;
    }
  return sum / count;
}

TEST(HoldComponent, OnAPlaneOfSymmetryNeedsHalfVolumes) {
  // With an even number of layers, the middle of the whole bar lies between two of them; with an odd one, in a layer.
  const double even = sag(-length + l0 / 2, Volumes::whole), odd = sag(-length + l0, Volumes::whole);
  EXPECT_NEAR(sag(0, Volumes::halved) / odd, 1.015, 0.002);
  EXPECT_NEAR(sag(0, Volumes::whole) / odd, 1.026, 0.002);
  EXPECT_NEAR(sag(l0 / 2, Volumes::whole) / even, 0.934, 0.002);
  EXPECT_NEAR(sag(-l0 / 2, Volumes::whole) / even, 1.124, 0.002);
}

struct Stretched {
  double reaction;       // over the exact one
  double plane, middle;  // lateral stretches
  double exact;          // lateral stretch
};

/// A bar of 5 x 5 particles, stretched by 1.2 between two planes of symmetry, each in a layer of half volumes,
/// `spacings` apart.
Stretched stretched_between_planes(int spacings) {
  constexpr double stretch = 1.2;
  const double end = spacings * l0;
  const Box<double, 3> bar{Point(0, 0, -l0 / 2), Point(5 * l0, 5 * l0, end + l0 / 2)};
  const std::vector<Point> reference = fill_lattice(bar, l0, Point(l0 / 2, l0 / 2, 0));
  const auto on_plane = [&](std::size_t i) { return reference[i][2] < l0 / 4 || reference[i][2] > end - l0 / 4; };
  std::vector<double> volume;
  for (std::size_t i = 0; i < reference.size(); ++i) volume.push_back(l0 * l0 * l0 * (on_plane(i) ? 0.5 : 1));
  const BondList<double, 3> bonds(vectors(reference), {.spacing = l0}, scalars(volume));
  const NeoHookean<> law{20e3, 100e3};
  auto force = internal_force(bonds, elastic(law), artificial(shear_wave_modulus(law.shear_modulus())));
  std::vector<Point> x = reference, v(x.size(), Point::Zero()), f = v;
  for (Point& at : x) at[2] *= stretch;
  (void)relax(force, vectors(x), vectors(v), vectors(f), density,
              {.spacing = l0,
               .moves_along = [&](std::size_t i, int c) { return c < 2 || !on_plane(i); },
               .volume = [&](std::size_t i) { return volume[i]; }});

  double lower = 0.5, upper = 1.5;
  Matrix<double, 3> C = Matrix<double, 3>::Zero();
  for (int k = 0; k < 60; ++k) {
    const double t = (lower + upper) / 2;
    C.diagonal() << t * t, t * t, stretch * stretch;
    (law.second_piola_kirchhoff(C, stretch * t * t)(0, 0) > 0 ? upper : lower) = t;
  }
  const double J = stretch * lower * lower;
  Stretched found{0, 0, 0, lower};
  int on = 0, between = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (reference[i][2] < l0 / 4) found.reaction += f[i][2] * volume[i];
    if (reference[i][0] < 4 * l0 || std::abs(reference[i][1] - 2.5 * l0) > l0 / 4) continue;
    const double t = (x[i][0] - 2.5 * l0) / (2 * l0);
    if (reference[i][2] < l0 / 4) found.plane += t, ++on;
    if (std::abs(reference[i][2] - end / 2) < l0 / 4) found.middle += t, ++between;
  }
  found.plane /= on, found.middle /= between;
  found.reaction /= stretch * law.second_piola_kirchhoff(C, J)(2, 2) * 25 * l0 * l0;
  return found;
}

TEST(HoldComponent, DisturbsAUniformStress) {
  const Stretched few = stretched_between_planes(6), many = stretched_between_planes(24);
  EXPECT_NEAR(few.exact, 0.929, 0.0005);
  EXPECT_NEAR(few.middle, 0.933, 0.001);
  EXPECT_NEAR(many.middle, 0.930, 0.001);
  EXPECT_NEAR(few.plane, 0.915, 0.002);
  EXPECT_NEAR(many.plane, 0.914, 0.002);
  EXPECT_NEAR(few.reaction, 0.979, 0.002);
  EXPECT_NEAR(many.reaction, 0.994, 0.002);
}

}  // namespace hold_symmetry_test
