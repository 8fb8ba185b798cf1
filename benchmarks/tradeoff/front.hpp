// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "common/error.hpp"

namespace tradeoff {

/// The cost and the error of a run; of both, less is better.
struct Point {
  double cost, error;
};

/// Whether `a` is as good as `b` in both respects and better in one.
[[nodiscard]] inline bool dominates(const Point& a, const Point& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

/// The Pareto front: the indices of the points that no other point dominates, in order of rising cost, so that the
/// error falls strictly. Of equal points only the first is returned. Throws `InputError` for a point whose cost or
/// error is negative or not finite.
[[nodiscard]] inline std::vector<std::size_t> pareto_front(std::span<const Point> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto fits = [](double value) { return std::isfinite(value) && value >= 0; };
    examples::require(
        fits(points[i].cost) && fits(points[i].error), "tradeoff: point ", i, " has the cost ", points[i].cost,
        " and the error ", points[i].error,
        "; both must be finite and not negative: leave runs that failed out, and take magnitudes of errors");
  }
  std::vector<std::size_t> order(points.size()), front;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  for (const std::size_t i : order)
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  return front;
}

}  // namespace tradeoff
