// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"

/// Which walls `fit_particles` makes of layers, and for which `thin_wall_stabiliser` has moduli.
namespace hmps::inline HMPS_ABI::detail {

inline constexpr int most_layers = 8;           ///< across a wall; what is thicker is bulk
inline constexpr double closest_layers = 0.6;   ///< distance of layers in spacings
inline constexpr double farthest_layers = 1.3;  ///< the same

}  // namespace hmps::inline HMPS_ABI::detail
