// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// The origins (m) of a lattice as it is, at zero, and shifted by half a spacing along each of the `D` axes in turn.
/// For `fill_lattice(..., origin)`.
template <int D = 3>
[[nodiscard]] std::vector<Vector<double, D>> lattice_shifts(double spacing) {
  static_assert(D == 2 || D == 3, "hmps: lattices have 2 or 3 dimensions");
  detail::require(detail::is_finite(spacing) && spacing > 0, "hmps: the spacing of a lattice to be shifted is ",
                  spacing, " m; give a positive number of metres");
  std::vector<Vector<double, D>> origins(1, Vector<double, D>::Zero());
  for (int c = 0; c < D; ++c) origins.push_back(spacing / 2 * Vector<double, D>::Unit(c));
  return origins;
}

/// A result as computed with lattices that are shifted against the body.
struct LatticeSpread {
  std::vector<double> values;  ///< for the lattice as it is, then for the shifted ones
  double mean = 0;
  double error = 0;  ///< the largest distance of a value from the mean: mean +- error covers all values
};

/// An error bar for the position of the lattice in the body, which should not matter but does: computes a result with
/// the lattice as it is and shifted by half a spacing along each axis.
///
///     const auto sag = lattice_spread(
///         l0, [&](const auto& origin) { return run(fill_lattice(shape, box, l0, origin)); });
///     std::printf("%g +- %g mm\n", 1e3 * sag.mean, 1e3 * sag.error);
///
/// It shows how the result depends on how the surface is cut out of the lattice, which affects the volume, thickness
/// and stiffness of parts that are a few spacings thick, and the places of contact. It does not show the errors that
/// all positions of the lattice have in common, such as the stabiliser's stiffness in bending: for these, halve the
/// spacing too.
///
/// @param run  `run(origin)` returns the result for the lattice with that origin (m)
/// Throws `InputError` for a spacing that is not positive, or a result that is not finite.
template <int D = 3, class Run>
[[nodiscard]] LatticeSpread lattice_spread(double spacing, Run&& run) {
  LatticeSpread spread;
  for (const auto& origin : lattice_shifts<D>(spacing)) {
    const double value = static_cast<double>(run(origin));
    detail::require(detail::is_finite(value), "hmps: the result for the lattice with the origin (", origin, ") is ",
                    value, "; an error bar needs finite results");
    spread.values.push_back(value);
    spread.mean += value / (D + 1);
  }
  const auto [least, largest] = std::minmax_element(spread.values.begin(), spread.values.end());
  spread.mean = std::clamp(spread.mean, *least, *largest);
  spread.error = std::max(*largest - spread.mean, spread.mean - *least);
  return spread;
}

}  // namespace hmps::inline HMPS_ABI
