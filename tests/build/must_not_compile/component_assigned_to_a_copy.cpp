// SPDX-License-Identifier: MIT
// expect: assign
#include <vector>

#include "hmps/core/view.hpp"

int main() {
  std::vector<Eigen::Vector3d> values(3);
  auto f = hmps::vectors(values);
  f[2][2] = 5;
}
