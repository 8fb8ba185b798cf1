// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// The value of E_hat (\paper{20}) with the best dispersion of long shear waves in the lattice: 4/3 of the shear
/// modulus.
///
/// Expanded for small k, a transverse plane wave in the lattice obeys
///
///     rho omega^2 = mu g^2 + E_hat (q - g^2),   g = k (1 - m k^2 / 6),   q = k^2 (1 - m k^2 / 12)
///
/// where m is the fourth moment of the bonds along the wave divided by their second moment. The error is k^4 m (E_hat /
/// 4 - mu / 3). It vanishes at E_hat = 4 mu / 3 for every weight, effective radius, direction and dimension. The paper
/// uses E, which for Poisson's ratios from 1/3 to 1/2 is 2 to 9/4 times as large and makes thin walls too stiff.
/// docs/theory.md has measurements and limits.
///
///     artificial(shear_wave_modulus(law.shear_modulus()))
///     artificial([&](const auto& at) { return shear_wave_modulus(at(mu)); })    // of each particle
///
/// @param shear_modulus  mu of the material at zero strain in Pa, a number or the lanes of a block
/// @return E_hat in Pa
template <class T>
[[nodiscard]] constexpr T shear_wave_modulus(const T& shear_modulus) {
  static_assert(
      !requires { shear_modulus.shear_modulus(); },
      "hmps: shear_wave_modulus takes the shear modulus in Pa, not the law; give it law.shear_modulus()");
  static_assert(detail::RequireReal<T>::value);
  return shear_modulus * T(4.0 / 3.0);
}

}  // namespace hmps::inline HMPS_ABI
