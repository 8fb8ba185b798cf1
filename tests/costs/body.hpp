// SPDX-License-Identifier: MIT
#pragma once

#include <malloc.h>

#include <cstddef>
#include <vector>

#include "hmps/core/view.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/time/symplectic_euler.hpp"

/// What the programs of tests/costs share: a block of soft tissue that vibrates.
namespace costs {

inline constexpr double spacing = 1.2e-3, density = 1000, time_step = 1e-5, young = 20e3, viscosity = 2e-3;
inline const hmps::MooneyRivlin<> tissue = hmps::MooneyRivlin<>::from_young(young, 1e6);

/// About a thousand particles in either dimension: 10 x 10 x 10 or 32 x 32, moving a little.
template <int D>
struct Body {
  std::vector<hmps::Vector<double, D>> reference, position, velocity, load;
  std::vector<hmps::Matrix<double, D>> gradient;
  std::vector<char> upper;

  Body() {
    const int side = D == 3 ? 10 : 32;
    const int layers = D == 3 ? side : 1;
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j)
        for (int k = 0; k < layers; ++k) {
          hmps::Vector<double, D> x;
          x[0] = spacing * i;
          x[1] = spacing * j;
          if constexpr (D == 3) x[2] = spacing * k;
          reference.push_back(x);
          upper.push_back(i >= side / 2 ? 1 : 0);
        }
    position = reference;
    velocity = load = reference;
    for (std::size_t i = 0; i < reference.size(); ++i) velocity[i] = 0.1 * reference[i];
    gradient.assign(reference.size(), hmps::Matrix<double, D>::Identity());
  }
  [[nodiscard]] std::size_t size() const { return reference.size(); }
};

/// `steps` steps under `force` alone.
template <int D, class Force>
void advance(Body<D>& body, Force& force, int steps) {
  const auto x = hmps::vectors(body.position), v = hmps::vectors(body.velocity), f = hmps::vectors(body.load);
  for (int step = 0; step < steps; ++step) {
    force(x, v, f);
    hmps::kick(v, f, density, time_step);
    hmps::drift(x, v, time_step);
  }
}

/// Bytes on the heap.
inline std::size_t heap() {
  const auto now = mallinfo2();
  return now.uordblks + now.hblkhd;
}

}  // namespace costs
