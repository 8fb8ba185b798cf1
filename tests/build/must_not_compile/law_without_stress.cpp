// SPDX-License-Identifier: MIT
// expect: a law needs second_piola_kirchhoff
// first line: Glass
#include "hmps/laws/law.hpp"

struct Glass {
  double young;
};

int main() {
  const hmps::Matrix<double, 3> F = hmps::Matrix<double, 3>::Identity();
  return static_cast<int>(hmps::first_piola_kirchhoff(Glass{1e4}, F)(0, 0));
}
