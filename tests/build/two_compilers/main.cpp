// SPDX-License-Identifier: MIT
// The same scene compiled by two compilers gives the same forces in one program, whichever is linked first.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

extern "C" std::size_t of_one_compiler(double*, double*, std::size_t);
extern "C" std::size_t of_the_other(double*, double*, std::size_t);

int main() {
  constexpr std::size_t most = 3000;
  std::vector<double> contact[2], internal[2];
  std::size_t count[2];
  for (int k = 0; k < 2; ++k) {
    contact[k].resize(most);
    internal[k].resize(most);
    count[k] = (k == 0 ? of_one_compiler : of_the_other)(contact[k].data(), internal[k].data(), most);
  }
  const auto difference = [&](const std::vector<double>* forces) {
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < most; ++i) {
      largest = std::max(largest, std::abs(forces[0][i]));
      apart = std::max(apart, std::abs(forces[0][i] - forces[1][i]));
    }
    return largest > 0 ? apart / largest : INFINITY;
  };
  std::printf("%zu and %zu numbers; contact forces differ by %g of the largest, internal forces by %g\n", count[0],
              count[1], difference(contact), difference(internal));
  // Some hundred roundings each.
  return count[0] > 0 && count[0] == count[1] && difference(contact) < 1e-11 && difference(internal) < 1e-11 ? 0 : 1;
}
