// SPDX-License-Identifier: MIT
// expect: a penalty law needs force(k, p, l0)
// first line: Sponge
#include "hmps/contact/contact.hpp"

struct Sponge {
  double force(double k, double p, double) const { return k * p * p; }  // which says nothing of its stiffness
};

int main() {
  const hmps::MetaballContact<double, 3, hmps::SmoothMetaball, hmps::CorrectedFriction, Sponge> contact(
      {.spacing = 1e-3, .density = 1000});
  (void)contact;
}
