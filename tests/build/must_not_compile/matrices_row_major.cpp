// SPDX-License-Identifier: MIT
// expect: a viewed tensor must be column-major
#include <vector>

#include "hmps/core/view.hpp"

struct Particle {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> gradient;
};

int main() {
  std::vector<Particle> particles(1);
  return static_cast<int>(hmps::matrices(particles, &Particle::gradient).size());
}
