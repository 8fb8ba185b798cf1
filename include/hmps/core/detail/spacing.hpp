// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Throws `InputError` unless `spacing` (m) is positive and finite. `what` names in the message what it is the spacing
/// of.
inline void require_spacing(double spacing, const char* what) {
  require(is_finite(spacing) && spacing > 0, "hmps: the spacing of ", what, " is ", spacing,
          " m; give the particles' positive distance in the reference configuration");
}

}  // namespace hmps::inline HMPS_ABI::detail
