// SPDX-License-Identifier: MIT
// expect: operator=
#include <vector>

#include "hmps/core/view.hpp"

int main() {
  std::vector<Eigen::Vector3d> values(3);
  const auto f = hmps::vectors(values);
  f[0] = Eigen::Vector3d(1, 2, 3);
}
