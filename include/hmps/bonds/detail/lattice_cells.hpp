// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/detail/resolution.hpp"
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// A cell of a simple cubic lattice, or the difference of two: steps along each axis.
template <int D>
using LatticeCell = std::array<std::int32_t, std::size_t{D}>;

/// The cells within `radius` spacings of the origin, except the origin, the first axis fastest.
template <int D>
[[nodiscard]] std::vector<LatticeCell<D>> cells_within(double radius) {
  constexpr double rounding = 1e-12;
  const auto reach = static_cast<std::int32_t>(std::floor(radius * (1 + rounding)));
  std::vector<LatticeCell<D>> cells;
  LatticeCell<D> cell;
  cell.fill(-reach);
  for (std::size_t axis = 0; axis < D;) {
    double squared = 0;
    for (const std::int32_t c : cell) squared += double(c) * c;
    if (squared > 0 && squared <= radius * radius * (1 + rounding)) cells.push_back(cell);
    for (axis = 0; axis < D && cell[axis] == reach; ++axis) cell[axis] = -reach;
    if (axis < D) ++cell[axis];
  }
  return cells;
}

/// The share of a spacing by which a particle may lie beside its lattice site.
inline constexpr double off_lattice = 1e-3;

/// The spacing (m) of the simple cubic lattice along the axes on which all `points` (m) lie; 0 if they lie on none.
template <class T, int D>
[[nodiscard]] double lattice_spacing(const VectorView<T, D>& points) {
  const double nearest = nearest_spacing(points);
  const auto offset = [&](std::size_t i, int c) { return double(points(i, c)) - double(points(0, c)); };
  double extent = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < D; ++c) extent = std::max(extent, std::abs(offset(i, c)));
  if (!(nearest > 0 && extent > nearest / 2)) return 0;
  const double spacing = extent / std::round(extent / nearest);  // the extent tells it more exactly
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < D; ++c) {
      const double place = offset(i, c) / spacing;
      if (!(std::abs(place - std::round(place)) < off_lattice)) return 0;
    }
  return spacing;
}

/// The occupied cells of a simple cubic lattice, sorted row by row.
template <int D>
struct LatticeCells {
  using Cell = LatticeCell<D>;
  std::vector<Cell> cell;                ///< Cell of each particle.
  std::vector<Index> order;              ///< The particles, sorted by cell.
  std::array<int, std::size_t{D}> axis;  ///< axis[0] is the slowest in the order, axis[D - 1] is along the rows.

  /// Sorts by rows and planes along `axes`, the slowest first; if all are zero, along the axes that suit the particles
  /// best.
  template <class T>
  LatticeCells(const VectorView<T, D>& reference, double spacing, const std::array<int, std::size_t{D}>& axes = {})
      : cell(reference.size()), order(reference.size()), axis(axes) {
    for (std::size_t i = 0; i < cell.size(); ++i)
      for (int c = 0; c < D; ++c) {
        const double place = (double(reference(i, c)) - double(reference(0, c))) / spacing;
        if (!is_finite(place) || std::abs(place) >= 1e6)
          throw_input_error({"hmps: particle ", i, " lies ", place, " spacings from particle 0; a lattice may span 1e6",
                             spacing_hint(reference, spacing)});
        const double nearest = std::round(place);
        if (std::abs(place - nearest) >= off_lattice)
          throw_input_error({"hmps: component ", c, " of particle ", i, " lies ", place,
                             " spacings from particle 0, not on the cubic lattice",
                             not_this_lattice(reference, spacing)});
        cell[i][static_cast<std::size_t>(c)] = static_cast<std::int32_t>(nearest);
      }
    std::iota(order.begin(), order.end(), Index{0});
    if (axis == std::array<int, std::size_t{D}>{}) choose_axes();
    require_axes();
    std::sort(order.begin(), order.end(), [this](Index a, Index b) { return key(cell[a]) < key(cell[b]); });
    for (std::size_t s = 1; s < order.size(); ++s)
      if (cell[order[s]] == cell[order[s - 1]])
        throw_input_error({"hmps: particles ", order[s - 1], " and ", order[s],
                           " lie at the same place; remove one of them", spacing_hint(reference, spacing)});
  }

  /// A key that sorts cells row by row; the key of a cell plus an offset is the sum of both keys.
  [[nodiscard]] std::int64_t key(const Cell& c) const {
    std::int64_t k = 0;
    for (int d = 0; d < D; ++d)
      k = k * (std::int64_t{1} << 21) + c[static_cast<std::size_t>(axis[static_cast<std::size_t>(d)])];
    return k;
  }
  /// The cell whose key is `k`, if its coordinates lie within a million.
  [[nodiscard]] Cell cell_of(std::int64_t k) const {
    constexpr std::int64_t base = std::int64_t{1} << 21;
    Cell c;
    for (int d = D - 1; d >= 0; --d) {
      const std::int64_t digit = ((k + base / 2) & (base - 1)) - base / 2;
      c[static_cast<std::size_t>(axis[static_cast<std::size_t>(d)])] = static_cast<std::int32_t>(digit);
      k = (k - digit) / base;
    }
    return c;
  }

 private:
  void require_axes() const {
    for (int d = 0; d < D; ++d)
      require(std::count(axis.begin(), axis.end(), d) == 1, "hmps: the axes of a lattice must be each of 0 to ", D - 1,
              " once, but axis ", d, " is missing or repeated; use those that lattice_axes returns");
  }
  /// Advice for particles that are not on the lattice of `spacing`.
  template <class T>
  [[nodiscard]] HMPS_COLD static std::string not_this_lattice(const VectorView<T, D>& reference, double spacing) {
    constexpr double coarse = 0.3;  // rounding alone changes the distance of nearest neighbours by less
    if (spacing_hint(reference, spacing, coarse).empty()) require_resolved(reference, spacing, off_lattice);
    if (const double found = lattice_spacing(reference); found > 0)
      return "; all particles lie on the lattice of " + ask_for_spacing(found, spacing);
    const std::string hint = spacing_hint(reference, spacing);
    return hint.empty() ? "; use BondList for a cloud that is no lattice"
                        : hint + " For a cloud that is no lattice use BondList";
  }

  /// Rows lie along the axis that gives the fewest of them, so that most neighbours of a block are consecutive; planes
  /// lie across the longest axis, so that neighbouring planes are close in memory.
  void choose_axes() {
    std::array<std::size_t, std::size_t{D}> rows{};
    std::array<std::int32_t, std::size_t{D}> extent{};
    for (int d = 0; d < D; ++d) {
      std::iota(axis.begin(), axis.end(), 0);
      std::swap(axis[static_cast<std::size_t>(d)], axis[D - 1]);
      std::vector<std::int64_t> keys(cell.size());
      std::int32_t low = 0, high = 0;
      for (std::size_t i = 0; i < cell.size(); ++i) {
        keys[i] = key(cell[i]);
        low = std::min(low, cell[i][static_cast<std::size_t>(d)]);
        high = std::max(high, cell[i][static_cast<std::size_t>(d)]);
      }
      std::sort(keys.begin(), keys.end());
      for (std::size_t i = 0; i < keys.size(); ++i)
        rows[static_cast<std::size_t>(d)] += (i == 0 || keys[i] != keys[i - 1] + 1) ? 1u : 0u;
      extent[static_cast<std::size_t>(d)] = high - low;
    }
    int fastest = D - 1;
    for (int d = D - 1; d >= 0; --d)
      if (rows[static_cast<std::size_t>(d)] < rows[static_cast<std::size_t>(fastest)]) fastest = d;
    std::iota(axis.begin(), axis.end(), 0);
    std::swap(axis[static_cast<std::size_t>(fastest)], axis[D - 1]);
    if constexpr (D == 3) {
      const auto first = extent[static_cast<std::size_t>(axis[0])], second = extent[static_cast<std::size_t>(axis[1])];
      if (first != second ? first < second : axis[0] > axis[1]) std::swap(axis[0], axis[1]);
    }
  }
};

}  // namespace hmps::inline HMPS_ABI::detail
