// SPDX-License-Identifier: MIT
// expect: this call takes views of arrays, not arrays: wrap arrays of vectors in hmps::vectors(array)
// first line: std::vector
#include <vector>

#include "hmps/time/symplectic_euler.hpp"

int main() {
  std::vector<Eigen::Vector3d> v(1), f(1);
  hmps::kick(v, f, 1000.0, 1e-5);
}
