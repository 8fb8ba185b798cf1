// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// An order of any cloud of particles in which neighbours are consecutive where possible: rods with a cross-section of
/// about one spacing squared, side by side in layers; particles of a rod are consecutive. For a lattice, even one that
/// is jittered or has gaps, the rods are its rows. The order depends on the positions only, except that the given order
/// decides between equivalent axes and coincident positions.
template <int D>
struct CloudOrder {
  template <class Number>
  using PerAxis = std::array<Number, std::size_t{D}>;

  std::vector<Index> order;  ///< The particles in this order.

  /// Orders particles at `reference` (m, finite) that are about `spacing` (m) apart.
  template <class T>
  CloudOrder(const VectorView<T, D>& reference, double spacing) : order(reference.size()) {
    const std::size_t n = reference.size();
    std::iota(order.begin(), order.end(), Index{0});
    if (n == 0) return;
    PerAxis<std::vector<std::int32_t>> cell;
    PerAxis<std::int32_t> extent{};
    for (int c = 0; c < D; ++c) {
      std::vector<std::int32_t>& cells = cell[static_cast<std::size_t>(c)];
      cells.resize(n);
      const double origin = middle_of_layer(reference, c, spacing);
      for (std::size_t i = 0; i < n; ++i) {
        const double place = std::round((static_cast<double>(reference(i, c)) - origin) / spacing);
        cells[i] = static_cast<std::int32_t>(std::clamp(place, -1e9, 1e9));
      }
      const auto [low, high] = std::minmax_element(cells.begin(), cells.end());
      extent[static_cast<std::size_t>(c)] = *high - *low;
    }
    const PerAxis<int> axis = axes(cell, extent);
    const int along = axis[D - 1];
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      for (std::size_t d = 0; d + 1 < D; ++d) {
        const auto& cells = cell[static_cast<std::size_t>(axis[d])];
        if (cells[a] != cells[b]) return cells[a] < cells[b];
      }
      const auto xa = reference(a, along), xb = reference(b, along);
      return xa != xb ? xa < xb : a < b;
    });
  }

 private:
  /// The phase of the layers along component `c`: the mean direction of the positions on a circle whose circumference
  /// is one spacing.
  template <class T>
  [[nodiscard]] static double middle_of_layer(const VectorView<T, D>& reference, int c, double spacing) {
    const double first = static_cast<double>(reference(0, c)), turn = 2 * std::acos(-1.0) / spacing;
    double sine = 0, cosine = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const double angle = turn * (static_cast<double>(reference(i, c)) - first);
      sine += std::sin(angle);
      cosine += std::cos(angle);
    }
    return first + std::atan2(sine, cosine) / turn;
  }

  /// Rods lie along the axis that gives the fewest of them, layers across the longest of the other axes. If axes are
  /// equivalent, rods lie along the first or the last axis, whichever makes more particles consecutive, so that the
  /// sweeps read the user's arrays in order.
  [[nodiscard]] static PerAxis<int> axes(const PerAxis<std::vector<std::int32_t>>& cell,
                                         const PerAxis<std::int32_t>& extent) {
    const std::size_t n = cell[0].size();
    PerAxis<std::size_t> rods{};
    std::vector<std::int64_t> keys(n);
    for (std::size_t along = 0; along < D; ++along) {
      for (std::size_t i = 0; i < n; ++i) {
        keys[i] = 0;
        for (std::size_t d = 0; d < D; ++d)
          if (d != along) keys[i] = keys[i] * (std::int64_t{1} << 31) + cell[d][i];
      }
      std::sort(keys.begin(), keys.end());
      rods[along] = static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) - keys.begin());
    }
    std::size_t along = D - 1;
    for (std::size_t d = D; d-- > 0;)
      if (rods[d] < rods[along]) along = d;
    if (rods[0] == rods[along] && first_axis_is_fastest(cell)) along = 0;
    PerAxis<int> axis;
    std::iota(axis.begin(), axis.end(), 0);
    std::swap(axis[along], axis[D - 1]);
    if constexpr (D == 3) {
      const auto first = extent[static_cast<std::size_t>(axis[0])], second = extent[static_cast<std::size_t>(axis[1])];
      if (first != second ? first < second : (along == 0) == (axis[0] < axis[1])) std::swap(axis[0], axis[1]);
    }
    return axis;
  }

  /// Whether most particles lie next to their predecessor along the first axis.
  [[nodiscard]] static bool first_axis_is_fastest(const PerAxis<std::vector<std::int32_t>>& cell) {
    std::size_t follow = 0;
    for (std::size_t i = 1; i < cell[0].size(); ++i) {
      bool same = cell[0][i] == cell[0][i - 1] + 1;
      for (std::size_t d = 1; d < D; ++d) same = same && cell[d][i] == cell[d][i - 1];
      follow += same ? 1 : 0;
    }
    return 2 * follow > cell[0].size();
  }
};

}  // namespace hmps::inline HMPS_ABI::detail
