// SPDX-License-Identifier: MIT
// expect: write hmps::PenaltyStiffness::ratio(k_tilde)
// first line: PenaltyStiffness
#include "hmps/contact/contact_settings.hpp"

int main() {
  const hmps::ContactSettings settings{.spacing = 1e-3, .density = 1000, .stiffness = 1e10};
  (void)settings;
}
