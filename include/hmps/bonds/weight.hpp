// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI {

/// The weight of a bond by \paper{8}: w(r) = r_e / r - 1 for 0 < r <= r_e, otherwise 0. Dimensionless. Any callable
/// `T(T distance, T radius)` with a non-negative result can replace it.
struct PaperWeight {
  template <class T>
  [[nodiscard]] constexpr T operator()(T distance, T radius) const {
    return distance > T(0) && distance <= radius ? radius / distance - T(1) : T(0);
  }
};

/// Effective radius divided by the initial particle spacing, r_e / l0, in the paper, for bonds and for metaballs
/// (sections 2.2 and 2.7).
inline constexpr double paper_radius_ratio = 1.75;

}  // namespace hmps::inline HMPS_ABI
