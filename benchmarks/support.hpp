// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "hmps/core/view.hpp"

/// What the benchmarks share: a box of soft tissue and its state.
namespace bench {

inline constexpr double spacing = 1.2e-3, time_step = 1e-5, density = 1000, viscosity = 2e-3, young = 20e3, d1 = 1e6;

/// Numbers in [-1, 1), the same in every run (splitmix64).
inline double noise(std::uint64_t n) {
  n = (n + 1) * 0x9e3779b97f4a7c15u;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
  n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((n ^ (n >> 31)) >> 11) * 0x1.0p-52 - 1;
}

/// The extent in particles of the boxes that are measured: in the cache, the paper's size, beyond the cache.
struct Box {
  std::size_t nx, ny, nz;
  [[nodiscard]] std::size_t size() const { return nx * ny * nz; }
};
inline constexpr std::array<Box, 3> boxes = {{{20, 20, 20}, {40, 40, 47}, {100, 100, 100}}};

/// State of a box in arrays of each component, deformed a little and moving.
template <class S>
struct State {
  std::array<std::vector<S>, 3> x, v, f;

  explicit State(const Box& box) {
    for (std::size_t c = 0; c < 3; ++c)
      for (auto* component : {&x[c], &v[c], &f[c]}) component->reserve(box.size());
    for (std::size_t i = 0; i < box.nx; ++i)
      for (std::size_t j = 0; j < box.ny; ++j)
        for (std::size_t k = 0; k < box.nz; ++k) {
          const std::array<std::size_t, 3> cell = {i, j, k};
          for (std::size_t c = 0; c < 3; ++c) {
            x[c].push_back(static_cast<S>(spacing * static_cast<double>(cell[c])));
            v[c].push_back(static_cast<S>(0.1 * noise(3 * x[c].size() + c)));
            f[c].push_back(S(0));
          }
        }
  }
  [[nodiscard]] std::size_t size() const { return x[0].size(); }
  [[nodiscard]] auto positions() { return hmps::vectors(x[0], x[1], x[2]); }
  [[nodiscard]] auto velocities() { return hmps::vectors(v[0], v[1], v[2]); }
  [[nodiscard]] auto forces() { return hmps::vectors(f[0], f[1], f[2]); }
};

template <class S>
std::string name_of() {
  return std::is_same_v<S, float> ? "float" : "double";
}

}  // namespace bench
