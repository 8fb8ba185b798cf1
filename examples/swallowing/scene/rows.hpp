// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace swallowing {

/// Rows of numbers, interpolated linearly in the first column and held constant beyond its ends.
/// The first column ascends.
template <std::size_t N>
struct Rows {
  std::vector<std::array<double, N>> rows;
  [[nodiscard]] std::array<double, N> operator()(double at) const {
    if (at <= rows.front()[0]) return rows.front();
    if (at >= rows.back()[0]) return rows.back();
    const auto above = std::upper_bound(rows.begin(), rows.end(), at, [](double a, const auto& r) { return a < r[0]; });
    const auto& b = *above;
    const auto& a = *(above - 1);
    const double s = (at - a[0]) / (b[0] - a[0]);
    std::array<double, N> row;
    for (std::size_t c = 0; c < N; ++c) row[c] = a[c] + s * (b[c] - a[c]);
    return row;
  }
};

}  // namespace swallowing
