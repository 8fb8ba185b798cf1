// SPDX-License-Identifier: MIT
// expect: kick changes the velocities
#include <vector>

#include "hmps/time/symplectic_euler.hpp"

int main() {
  const std::vector<Eigen::Vector3d> v(1), f(1);
  hmps::kick(hmps::vectors(v), hmps::vectors(f), 1000.0, 1e-5);
}
