// SPDX-License-Identifier: MIT
// expect: a shape returns its signed distance in m, negative inside, not whether a point is inside
#include "hmps/particles/lattice.hpp"

int main() {
  using V = hmps::Vector<double, 3>;
  const auto inside = [](const V& x) { return x.norm() < 1; };
  return static_cast<int>(hmps::fill_lattice(inside, hmps::Box<double, 3>{V(-1, -1, -1), V(1, 1, 1)}, 0.1).size());
}
