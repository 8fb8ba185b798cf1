// SPDX-License-Identifier: MIT
// expect: a formula is given integers, to which its results would be rounded
#include "hmps/laws/saint_venant_kirchhoff.hpp"

int main() {
  const hmps::SaintVenantKirchhoff law{100000, 7000};
  return law.mu;
}
