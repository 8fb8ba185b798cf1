// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/shear_wave_modulus.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `sheet_stabiliser`, in Pa.
template <class P>
struct SheetStabiliser {
  P modulus;                 ///< E_hat of \paper{20}, for `artificial`
  SplitBulkModulus<P> bulk;  ///< for the law and for `mean_dilatation`; leave out the latter if its share is zero
};

/// The E_hat and the mean dilatation with which a wide sheet of `layers` particles bends best: its frequency is right
/// within 2 % with three particles or more and within 5 % with two, for bulk moduli of 3 to 300 shear moduli.
/// Calibrated against bending waves in infinite sheets (Rayleigh and Lamb) with the paper's weight and radius;
/// docs/theory.md has the table, and advice for bars that are as narrow as high.
///
///     const auto [E_hat, bulk] = sheet_stabiliser(4, law.bulk_modulus(), law.shear_modulus());
///
/// @param bulk_modulus, shear_modulus  of the material at zero strain in Pa
/// Throws `InputError` for moduli that are not positive and for fewer than two layers.
template <class P, class Layers>
[[nodiscard]] SheetStabiliser<P> sheet_stabiliser(Layers layers, P bulk_modulus, P shear_modulus) {
  static_assert(std::is_integral_v<Layers>,
                "hmps: the layers of a sheet are counted; round the thickness over the spacing, for example with "
                "std::lround: a conversion to int cuts 3.9999 to 3");
  detail::require(layers >= 2, "hmps: a sheet of ", layers,
                  " particles has no stabiliser; it takes at least two layers to bend");
  const SplitBulkModulus<P> shared = split_bulk_modulus(bulk_modulus, shear_modulus);
  const SplitBulkModulus<P> alone{bulk_modulus, P(0)};
  const P ratio = bulk_modulus / shear_modulus, wave = shear_wave_modulus(shear_modulus);
  const P less = shear_modulus, more = P(1.5) * shear_modulus;
  if (layers == 2) return {ratio < P(5) ? less : ratio < P(10) ? wave : more, shared};
  if (layers % 2 == 1 || ratio < P(15)) return {wave, alone};
  return {ratio < P(100) ? more : wave, shared};
}

}  // namespace hmps::inline HMPS_ABI
