// SPDX-License-Identifier: MIT
// expect: this call takes views of arrays, not arrays: wrap arrays of vectors in hmps::vectors(array)
// first line: std::vector
#include <vector>

#include "hmps/analysis/stable_step.hpp"

int main() {
  std::vector<Eigen::Vector3d> x(1), v(1);
  const auto force = [](const auto&, const auto&, const auto&) {};
  (void)hmps::stable_step(force, x, v, 1000.0, {.spacing = 1e-3});
}
