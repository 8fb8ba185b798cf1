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

}  // namespace hold_symmetry_test
