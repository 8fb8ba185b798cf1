// SPDX-License-Identifier: MIT
// expect: bonds need to be derived from Blocks<K, D>
// first line: Network
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"

struct Network {
  using Scalar = double;
  static constexpr int dimension = 3;
};

int main() {
  const Network bonds;
  auto force = hmps::internal_force(bonds, hmps::artificial(2e4));
  (void)force;
}
