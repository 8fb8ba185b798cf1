// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `bar_stabiliser`, in Pa.
template <class P>
struct BarStabiliser {
  P modulus;  ///< E_hat of \paper{20}, for `artificial`
  P tension;  ///< for `artificial_tension`
};

/// The moduli with which bars that are about as wide as high twist and bend best, in three dimensions:
///
///     const auto [E_hat, tension] = bar_stabiliser(law.shear_modulus());
///     internal_force(bonds, elastic(law), artificial(E_hat), artificial_tension(tension))
///
/// Two conditions fix the two moduli; neither is calibrated. Long shear waves are right, as with `shear_wave_modulus`
/// alone. And in an isotropic neighbourhood, the artificial energy of a strain e(x) of an isochoric motion depends on
/// e_ij,k e_ij,k and e_ij,j e_ik,k alone: Kondo's energy is proportional to 3 e_ij,k e_ij,k - 2 e_ij,k e_ik,j + 2
/// e_ij,j e_ik,k, and its second part, which stiffens twist, vanishes with an artificial tension 7 times E_hat.
/// docs/theory.md has the derivation. Surfaces are not isotropic; on a lattice, the torsional frequency of bars of 3, 4
/// and 5 particles is 5, 2 and 0 % too high, with 4/3 mu alone 17, 9 and 5 %, and the bending frequency 2 to 3 % too
/// low (docs/measured/verification.md). The stable step of nearly incompressible tissue stays; at Poisson's ratio 0.3
/// it is 0.8 times as long.
///
/// @param shear_modulus  mu of the material at zero strain in Pa
/// Throws `InputError` for a modulus that is not positive.
template <class P>
[[nodiscard]] BarStabiliser<P> bar_stabiliser(P shear_modulus) {
  static_assert(detail::RequireReal<P>::value);
  detail::require(detail::is_finite(shear_modulus) && shear_modulus > 0, "hmps: the shear modulus of a bar is ",
                  shear_modulus, " Pa; it must be positive");
  return {P(2) / P(3) * shear_modulus, P(14) / P(3) * shear_modulus};
}

}  // namespace hmps::inline HMPS_ABI
