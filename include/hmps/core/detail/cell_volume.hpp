// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Throws `InputError` unless the volume of a particle, `volume` (m^D), is that of a cube with edges of `length` (m) to
/// within a factor of `most`. `what` says in the message what it is the volume of, and `edge` what has that length.
template <int D>
void require_cell_volume(double volume, double length, double most, const char* what, const char* edge) {
  const double share = volume / std::pow(length, D);
  require(is_finite(share) && share < most && share * most > 1, "hmps: ", what, " is ", volume, " m", D,
          ", but the cube of ", edge, " of ", length, " m has ", std::pow(length, D), " m", D,
          "; give the volume of one particle, l0^", D, " on a lattice, and all lengths in metres");
}
/// How far the length of bonds may be from the spacing, as a factor of the volume.
inline constexpr double volume_factor_of_bonds = 100;
/// How far the mean volume of irregular particles may be from the cube of the spacing, as a factor.
inline constexpr double volume_factor_of_spacing = 8;

}  // namespace hmps::inline HMPS_ABI::detail
