// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/finite.hpp"

namespace hmps::inline HMPS_ABI {

/// Bonds every pair: the default predicate, which cuts no bonds.
struct EveryBond {
  constexpr bool operator()(std::size_t, std::size_t) const { return true; }
};

/// Settings of the bonds of a cloud.
struct BondSettings {
  double spacing = 0;                        ///< Initial particle spacing l0 in m, positive.
  double radius_ratio = paper_radius_ratio;  ///< Effective radius over spacing, r_e / l0.
  /// Whether particles may have no bonds, such as those that a part of a body borrows from other parts, where their
  /// forces are computed. Their F is 1. Otherwise such a particle is an error.
  bool unbonded = false;
  /// For `LatticeBonds`: the axes in sweep order, slowest first, as `lattice_axes` returns them for the whole body.
  /// Sums over bonds follow this order, so that parts of a body with the same axes reproduce the bits of the whole. All
  /// zero: chosen by the particles.
  std::array<int, 3> axes{};
};

namespace detail {
inline void validate(const BondSettings& settings) {
  require(detail::is_finite(settings.spacing) && settings.spacing > 0, "hmps: the particle spacing is ",
          settings.spacing, " m; it must be positive");
  require(detail::is_finite(settings.radius_ratio) && settings.radius_ratio > 0,
          "hmps: the effective radius over the spacing is ", settings.radius_ratio,
          "; it must be positive (the paper has 1.75)");
}
}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
