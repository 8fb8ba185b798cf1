// SPDX-License-Identifier: MIT
// expect: use hmps::select(condition, this, that)
// first line: bool
#include "hmps/lanes/lanes.hpp"

/// Stretched tissue, by an `if` as for a number.
template <class T>
T slack(const T& J) {
  if (J > T(1)) return J - T(1);
  return T(0);
}

int main() { (void)slack(hmps::Lanes<double>(2)); }
