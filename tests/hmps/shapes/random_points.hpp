// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "hmps/core/types.hpp"

namespace hmps_test {

/// `n` points of a cube of the half width `reach`, always the same.
[[nodiscard]] inline std::vector<hmps::Vector<double, 3>> random_points(std::size_t n, double reach) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-reach, reach);
  std::vector<hmps::Vector<double, 3>> points(n);
  for (auto& p : points) p = hmps::Vector<double, 3>(uniform(random), uniform(random), uniform(random));
  return points;
}

}  // namespace hmps_test
