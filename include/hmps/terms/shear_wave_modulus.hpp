// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI {

/// The E_hat of \paper{20} at which the lattice carries long shear waves best: 4/3 of the shear modulus.
///
/// Expanded for small k, a transverse plane wave in the lattice has
///
///     rho omega^2 = mu g^2 + E_hat (q - g^2),   g = k (1 - m k^2 / 6),   q = k^2 (1 - m k^2 / 12)
///
/// with m the fourth moment of the bonds along the wave over their second. The error is
/// k^4 m (E_hat / 4 - mu / 3), and vanishes at E_hat = 4 mu / 3 whatever the weight, the effective radius, the
/// direction and the number of dimensions. The paper takes E, which for Poisson's ratios from 1/3 to 1/2 is 2 to 9/4
/// times as much; thin walls are then too stiff. See docs/theory.md for what is measured, and where it fails.
///
///     artificial(shear_wave_modulus(law.shear_modulus()))
///     artificial([&](const auto& at) { return shear_wave_modulus(at(mu)); })    // of each particle
///
/// @param shear_modulus  mu of the material at zero strain in Pa, a number or the lanes of a block
/// @return E_hat in Pa
template <class T>
[[nodiscard]] constexpr T shear_wave_modulus(const T& shear_modulus) {
  return shear_modulus * T(4.0 / 3.0);
}

}  // namespace hmps::inline HMPS_ABI
