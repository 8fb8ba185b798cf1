// SPDX-License-Identifier: MIT
// expect: operator=
#include <vector>

#include "hmps/core/view.hpp"

int main() {
  std::vector<Eigen::Matrix3d> values(3);
  const auto f = hmps::matrices(values);
  f[0] = Eigen::Matrix3d::Identity();
}
