// SPDX-License-Identifier: MIT
// How much stiffer a body is that is pressed between two plates of particles: as if it were shorter.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "hmps/analysis/relaxation.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/contact/contact.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/view.hpp"
#include "hmps/diagnostics/net_force.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/particles/surface_layers.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/shear_wave_modulus.hpp"

namespace pressed_faces_test {

using namespace hmps;
using V = Vector<double, 3>;

constexpr double l0 = 1e-3, young = 20e3, density = 1000, strain = 0.05;
constexpr int width = 4;  // layers of the prism

/// The length in spacings that a prism of `layers` layers with Poisson's ratio 0 seems to lack at each of its two
/// faces, from the force with which plates press it by `strain`. `stiffness` is that of contact, in E / l0^2.
double missing_length(int layers, double stiffness) {
  const double height = layers * l0, side = width * l0, rim = 2 * l0;
  const auto block = [](const V& lower, const V& upper) {
    return fill_lattice(Box<double, 3>{lower, upper}, l0, V(V::Constant(l0 / 2)));
  };
  std::vector<V> reference = block(V(0, 0, 0), V(side, side, height));
  const std::size_t n = reference.size();
  for (const double base : {-2 * l0, height})
    for (const V& place : block(V(-rim, -rim, base), V(side + rim, side + rim, base + 2 * l0)))
      reference.push_back(place);
  std::vector<V> x = reference, v(x.size(), V::Zero()), f = v;
  std::vector<Matrix<double, 3>> gradients(x.size(), Matrix<double, 3>::Identity());
  const auto F = matrices(gradients);
  const auto body = vectors(std::as_const(reference)).part(0, n);
  const LatticeBonds<double, 3> bonds(body, {.spacing = l0});
  const auto law = NeoHookean<>::from_young_poisson(young, 0.0);
  auto internal =
      internal_force(bonds, elastic(law), artificial(shear_wave_modulus(law.shear_modulus())), record(F.part(0, n)));
  std::vector<Index> top, bottom;
  for (std::size_t i = n; i < x.size(); ++i)
    (reference[i][2] > height / 2 ? top : bottom).push_back(static_cast<Index>(i));
  MetaballContact<double, 3> contact(
      {.spacing = l0, .density = density, .stiffness = PenaltyStiffness::fixed(stiffness * young / (l0 * l0))});
  const auto prism = contact.add_organ({"prism", surface_layers(body, l0).outermost});
  for (const auto& wall : {top, bottom})
    contact.add_pair(prism, contact.add_organ({"plate", {}, wall}), {.roles = Roles::only_first_is_slave});
  const auto force = [&](const auto& at, const auto& speed, const auto& out) {
    internal(at.part(0, n), speed.part(0, n), out.part(0, n));
    contact.add(at, speed, F, out, 1e-6);
  };
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i][2] = i < n ? height / 2 + (1 - strain) * (reference[i][2] - height / 2)
                    : reference[i][2] + (reference[i][2] > height / 2 ? -0.5 : 0.5) * strain * height;
  const double load = young * strain * side * side;
  (void)relax(force, vectors(x), vectors(v), vectors(f), density,
              {.spacing = l0, .load = load, .moves = [&](std::size_t i) { return i < n; }});
  Matrix<double, 3> shortened = Matrix<double, 3>::Identity();
  shortened(2, 2) = 1 - strain;
  const double exact = -first_piola_kirchhoff(law, shortened)(2, 2) * side * side;
  const double found = net_force(vectors(f), ParticleSet(x.size(), top), l0 * l0 * l0)[2];
  return layers * (1 - exact / found) / 2;
}

TEST(PressedFaces, OfAPrismShortenItByHalfASpacingBetweenStiffPlates) {
  EXPECT_NEAR(missing_length(9, 100), 0.48, 0.02);
  EXPECT_NEAR(missing_length(18, 100), 0.48, 0.02);
  EXPECT_NEAR(missing_length(9, 10), 0.38, 0.02);
  EXPECT_NEAR(missing_length(9, 4), 0.21, 0.02);
}

}  // namespace pressed_faces_test
