// SPDX-License-Identifier: MIT
// expect: of numbers in hmps::scalars(array)
// first line: std::vector
#include <vector>

#include "hmps/time/symplectic_euler.hpp"

int main() {
  std::vector<Eigen::Vector3d> v(1), f(1);
  const std::vector<double> density(1, 1000.0);
  hmps::kick(hmps::vectors(v), hmps::vectors(f), density, 1e-5);
}
