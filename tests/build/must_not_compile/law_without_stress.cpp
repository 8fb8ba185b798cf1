// SPDX-License-Identifier: MIT
// expect: a law needs second_piola_kirchhoff
#include "hmps/laws/law.hpp"

struct Law {
  double young;
};

int main() {
  const hmps::Matrix<double, 3> F = hmps::Matrix<double, 3>::Identity();
  return static_cast<int>(hmps::first_piola_kirchhoff(Law{1e4}, F)(0, 0));
}
