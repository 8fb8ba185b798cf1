// SPDX-License-Identifier: MIT
// Compiles in seconds and includes both packages that the library needs.
#include <cstdio>
#include <hmps/search/fixed_radius.hpp>
#include <vector>

int main() {
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  const hmps::NeighbourList near_by = hmps::find_neighbours(hmps::vectors(x), 2.0);
  std::printf("%zu\n", near_by.neighbour.size());
  return near_by.neighbour.size() == 4 ? 0 : 1;
}
