// SPDX-License-Identifier: MIT
// expect: positions are views of float or double
#include <vector>

#include "hmps/bonds/bond_list.hpp"

int main() {
  std::vector<hmps::Vector<long double, 3>> X(8);
  hmps::BondList<double, 3> bonds(hmps::vectors(X), {.spacing = 1e-3});
}
