// SPDX-License-Identifier: MIT
// What a trial at other states does to a contact that remembers: nothing.
#include "hmps/contact/kept_history.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "bodies.hpp"
#include "hmps/analysis/step_causes.hpp"
#include "hmps/contact/contact.hpp"

namespace kept_history_test {

using hmps::Index;
using Point = hmps::Vector<double, 3>;
constexpr double l0 = 1e-3, density = 1000, dt = 1e-5;

/// A block pressed into a plate and shoved along it, both at rest after that.
struct Shoved {
  bodies::Pile<double, 3> pile{0.9, l0};
  hmps::MetaballContact<double, 3, hmps::SmoothMetaball, hmps::SpringFriction> contact{
      {.spacing = l0, .density = density, .friction = 0.1}};
  Shoved() { pile.declare(contact); }
  void shove() {
    for (int step = 0; step < 10; ++step) {
      for (const Index i : pile.block.all) pile.x[i][0] += 1e-3 * l0;
      pile.apply(contact, dt);
    }
  }
  /// The forces of the next step of the run.
  [[nodiscard]] std::vector<Point> forces() {
    pile.apply(contact, dt);
    return pile.f;
  }
  /// Probes the contact at trial displacements of a tenth of its penetration: more than the elastic slip of the limit.
  void probe() {
    const auto force = [&](const auto& x, const auto& v, const auto& f) { contact.add(x, v, f, dt); };
    const auto x = hmps::vectors(pile.x), v = hmps::vectors(pile.v);
    const hmps::StableStepSettings settings{.spacing = l0, .perturbation = 0.01};
    const auto found = hmps::stable_step(force, x, v, density, settings);
    (void)hmps::step_causes(found, x, v, density, settings, hmps::NamedForce{"contact", force});
  }
};

TEST(KeptHistory, StableStepLeavesTheElasticSlip) {
  Shoved left, probed;
  left.shove();
  probed.shove();
  probed.probe();
  const auto once = probed.forces();
  EXPECT_EQ(once, left.forces());
  probed.probe();
  probed.probe();
  probed.shove();
  left.shove();
  EXPECT_EQ(probed.forces(), left.forces());
}

TEST(KeptHistory, ProbedBeforeItsFirstStepAContactStartsAsNew) {
  Shoved left, probed;
  probed.probe();
  left.shove();
  probed.shove();
  EXPECT_EQ(probed.forces(), left.forces());
}

TEST(KeptHistory, AProgramMakesItsOwnTrial) {
  Shoved left, probed;
  left.shove();
  probed.shove();
  const auto place = probed.pile.x;
  {
    const hmps::Trial trial;
    probed.shove();
  }
  probed.pile.x = place;
  EXPECT_EQ(probed.forces(), left.forces());
}

TEST(KeptHistory, RefreshedAfterATrialItHoldsNoSlip) {
  Shoved left, probed;
  left.shove();
  probed.shove();
  probed.probe();
  left.contact.refresh();
  probed.contact.refresh();
  EXPECT_EQ(probed.forces(), left.forces());
}

}  // namespace kept_history_test
