// SPDX-License-Identifier: MIT
// expect: a metaball needs the constant radius
// first line: Spike
#include "hmps/contact/contact.hpp"

struct Spike {
  static constexpr double radius = 2;
  static double value(double s) { return 1 - s; }  // without its slope
};

int main() {
  const hmps::MetaballContact<double, 3, Spike> contact({.spacing = 1e-3, .density = 1000});
  (void)contact;
}
