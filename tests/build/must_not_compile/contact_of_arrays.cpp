// SPDX-License-Identifier: MIT
// expect: of tensors in hmps::matrices(array)
// first line: std::vector
#include <vector>

#include "hmps/contact/contact.hpp"

int main() {
  std::vector<Eigen::Vector3d> x(1), v(1), f(1);
  std::vector<Eigen::Matrix3d> F(1);
  hmps::MetaballContact<double, 3> contact({.spacing = 1e-3, .density = 1000});
  contact.add(hmps::vectors(x), hmps::vectors(v), F, hmps::vectors(f), 1e-5);
}
