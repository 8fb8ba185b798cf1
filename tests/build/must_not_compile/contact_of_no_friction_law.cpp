// SPDX-License-Identifier: MIT
// expect: a friction law needs the constant needs_load
// first line: Grease
#include "hmps/contact/contact.hpp"

struct Grease {
  static double share(double) { return 0.5; }  // which does not say whether it needs the load
};

int main() {
  const hmps::MetaballContact<double, 3, hmps::SmoothMetaball, Grease> contact({.spacing = 1e-3, .density = 1000});
  (void)contact;
}
