// SPDX-License-Identifier: MIT
#include <cstdio>
#include <hmps/hmps.hpp>
#include <vector>

double second(const hmps::VectorView<const double, 3>& positions);

int main() {
  std::vector<Eigen::Vector3d> x(10, Eigen::Vector3d::Ones());
  const double sum = second(hmps::vectors(x));
  std::printf("%g\n", sum);
  return sum == 30 ? 0 : 1;
}
