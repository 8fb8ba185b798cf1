// SPDX-License-Identifier: MIT
// How much contact shakes the body that it presses: a rigid plate is pressed 1.2 spacings into a block of three layers
// on a bonded one, then slides. Prints the table of docs/theory.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "bodies.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/contact/contact.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/viscous.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace chatter_test {

using hmps::Index;

struct Chatter {
  double fastest = 0, rms = 0;  // m/s, of the block's particles
  double sticking = 0;          // share of the contacts
  double friction = 0;          // tangential over normal force
};

template <class Ball>
Chatter slide(double ratio, double damping) {
  bodies::Scene<double, 3> scene;
  const double l0 = 2.4e-3, rho = 1000, dt = 2.2e-5, pressed = 0.03, end = 0.07;
  const auto block = scene.add({10, 10, 4}, {0, 0, 0}, l0);
  const auto plate = scene.add({6, 6, 2}, {2.3 * l0, 2.2 * l0, 4.05 * l0}, l0);
  const std::size_t count = block.all.size();
  const auto reference = scene.x;
  const auto x = hmps::vectors(scene.x), v = hmps::vectors(scene.v), f = hmps::vectors(scene.f);
  const auto F = hmps::matrices(scene.F);
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference).part(0, count), {.spacing = l0});
  auto force = hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(20e3, 1e6)),
                                    hmps::artificial(20e3), hmps::viscous(rho, 2e-3), hmps::record(F.part(0, count)));
  hmps::MetaballContact<double, 3, Ball, hmps::CorrectedFriction> contact(
      {.spacing = l0,
       .density = rho,
       .friction = 0.1,
       .stiffness = hmps::PenaltyStiffness::ratio(ratio),
       .damping = damping});
  const auto held = [](Index) { return true; };
  const auto pair = contact.add_pair(
      contact.add_organ({.name = "block", .slaves = block.top, .masters = block.upper, .prescribed = {}}),
      contact.add_organ({.name = "plate", .slaves = plate.bottom, .masters = plate.lower, .prescribed = held}));
  Chatter result;
  double contacts = 0, sticking = 0, squares = 0, samples = 0;
  hmps::Vector<double, 3> total = hmps::Vector<double, 3>::Zero();
  for (double t = 0; t < end; t += dt) {
    const auto hold = [&] {
      for (const Index i : plate.all) scene.v[i] = {t < pressed ? 0 : 0.1, 0, t < pressed ? -1.2 * l0 / pressed : 0};
      for (const Index i : block.bottom) scene.v[i].setZero();
    };
    force(x.part(0, count), v.part(0, count), f.part(0, count));
    hmps::kick(v.part(0, count), f.part(0, count), rho, dt);
    hold();
    scene.rest();
    const auto report = contact.add(x, v, F, f, dt);
    hmps::kick(v, f, rho, dt);
    hold();
    hmps::drift(x, v, dt);
    if (t < pressed + 0.02) continue;
    for (const Index i : block.all) {
      result.fastest = std::max(result.fastest, scene.v[i].norm());
      squares += scene.v[i].squaredNorm() / static_cast<double>(count);
    }
    samples += 1;
    contacts += static_cast<double>(report.contacts);
    sticking += static_cast<double>(report.sticking);
    total += contact.force_on_first(pair);
  }
  result.rms = std::sqrt(squares / samples);
  result.sticking = sticking / contacts;
  result.friction = -total[0] / total[2];
  return result;
}

/// Runs all dampings of one kernel and penalty ratio. Returns the sum of the mean square speeds.
template <class Ball>
double measure(const char* name, double ratio) {
  double squares = 0;
  for (const double damping : {0., 0.3}) {
    const Chatter c = slide<Ball>(ratio, damping);
    std::printf("| %s | %.3f | %.1f | %.2f | %.3f | %.0f %% | %.3f |\n", name, ratio, damping, c.fastest, c.rms,
                100 * c.sticking, c.friction);
    EXPECT_TRUE(std::isfinite(c.fastest));
    // mu is 0.1; the plate's front edge, which ploughs, adds to it.
    EXPECT_NEAR(c.friction, 0.1, 0.05);
    squares += c.rms * c.rms;
  }
  return squares;
}

// The runs are chaotic: only the order of the figures is reproducible, not their values.
TEST(Chatter, IsLessWithSmoothMetaballs) {
  std::printf("| kernel | k~ | damping | largest speed, m/s | rms, m/s | sticking | F_t / F_n |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const double ratio : {0.3, 0.075, 0.02}) {
    const double paper = measure<hmps::PaperMetaball>("paper", ratio);
    EXPECT_LT(measure<hmps::SmoothMetaball>("smooth", ratio), 0.5 * paper) << "at k~ = " << ratio;
  }
}

}  // namespace chatter_test
