// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/spacing.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI {

/// Bonds every pair: the default predicate, which cuts no bonds.
struct EveryBond {
  constexpr bool operator()(std::size_t, std::size_t) const { return true; }
};

/// Settings of the bonds of a cloud.
struct BondSettings {
  double spacing = 0;                        ///< Particle spacing l0 in m, positive.
  double radius_ratio = paper_radius_ratio;  ///< Effective radius over spacing, r_e / l0.
  /// Whether particles may have no bonds, such as those that a part of a body borrows from other parts, which compute
  /// their forces. F of such a particle is 1. If false, a particle without bonds is an error.
  bool unbonded = false;
  /// For `LatticeBonds`: the axes in sweep order, slowest first, as `lattice_axes` returns them for the whole body.
  /// Sums over bonds follow this order, so that parts of a body with the same axes reproduce the bits of the whole. All
  /// zero: chosen to suit the particles.
  std::array<int, 3> axes{};
};

namespace detail {
inline void validate(const BondSettings& settings) {
  require_spacing(settings.spacing, "the particles");
  require(detail::is_finite(settings.radius_ratio) && settings.radius_ratio > 0 && settings.radius_ratio < 16,
          "hmps: the effective radius is ", settings.radius_ratio,
          " spacings; it must be positive and below 16 (the paper has 1.75)");
}

/// Whether `bonded(i, j)` holds. Throws `InputError` if `bonded(j, i)` disagrees: the forces of such a bond would not
/// sum to zero. Only particles that a part borrows (`BondSettings::unbonded`) may be bonded from one end.
template <class Bonded>
[[nodiscard]] bool are_bonded(Bonded& bonded, std::size_t i, std::size_t j, bool from_one_end = false) {
  const bool there = bonded(i, j);
  if constexpr (!std::is_same_v<std::remove_cv_t<Bonded>, EveryBond>)
    require(from_one_end || there == static_cast<bool>(bonded(j, i)), "hmps: particles ", i, " and ", j, " are ",
            there ? "" : "not ", "bonded by bonded(", i, ", ", j, ") but ", there ? "not " : "", "by bonded(", j, ", ",
            i, "); give the same answer for both orders");
  return there;
}

/// Throws `InputError` for the weight `w` of a bond of the length `distance` (m) if it is negative, not finite or so
/// large that sums of weights overflow.
inline void require_weight(double w, double distance) {
  require(is_finite(w) && w >= 0 && w <= 1e30, "hmps: the weight at the distance ", distance, " m is ", w,
          "; a weight function must be finite and not negative within the effective radius, and at most 1e30 (a common "
          "factor of all weights changes nothing)");
}

/// Throws `InputError` for the sum `density` of the weights of the fullest neighbourhood if it is so small that
/// products of weights vanish.
inline void require_standard_weight(double density) {
  require(density == 0 || density >= 1e-30, "hmps: the weights of the fullest neighbourhood sum to ", density,
          "; give larger ones (a common factor of all weights changes nothing)");
}
}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
