// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/laws/invariants.hpp"
#include "hmps/laws/law.hpp"

namespace hmps::inline HMPS_ABI {

/// The compressible neo-Hookean law with the isochoric first invariant,
///
///     W = mu / 2 (J^(-2/3) I1 - 3) + kappa / 2 (J - 1)^2
///
/// which is `MooneyRivlin` with C1 = mu / 2, C2 = 0, D1 = kappa / 2, without the cost of the second invariant. Other
/// neo-Hookean laws in use differ in the volumetric part (for example -mu ln J + lambda / 2 ln^2 J) and agree with this
/// one at small strain only. Two dimensions are plane strain. `J` must be positive.
template <class P = double>
struct NeoHookean {
  static_assert(detail::RequireReal<P>::value);
  P mu;     ///< shear modulus in Pa at zero strain
  P kappa;  ///< bulk modulus in Pa at zero strain

  /// The law with Young's modulus `young` in Pa and Poisson's ratio `poisson` at zero strain.
  [[nodiscard]] static NeoHookean from_young_poisson(P young, P poisson) {
    return {detail::shear_modulus_of(young, poisson), young / (P(3) * (P(1) - P(2) * poisson))};
  }
  /// The law with the bulk modulus `bulk` and the shear modulus `shear` in Pa at zero strain.
  [[nodiscard]] static NeoHookean from_moduli(P bulk, P shear) { return {shear, bulk}; }

  [[nodiscard]] P bulk_modulus() const { return kappa; }
  [[nodiscard]] P shear_modulus() const { return mu; }

  /// Throws `InputError` if a modulus is not positive and finite, or if Poisson's ratio is below -1/2.
  void validate() const requires std::is_arithmetic_v<P> {
    detail::require_modulus(mu, "NeoHookean", "shear modulus mu",
                            "from_young_poisson needs E > 0 and Poisson's ratio > -1");
    detail::require_modulus(
        kappa, "NeoHookean", "bulk modulus kappa",
        "from_young_poisson needs Poisson's ratio < 0.5; a ratio of 0.5 has no finite bulk modulus");
    detail::require_order(bulk_modulus(), shear_modulus(), "NeoHookean");
  }

  /// S = 2 dW/dC in Pa, \paper{14}, at C = F^T F and J = det F > 0.
  template <class T, int D>
  [[nodiscard]] HMPS_INLINE Matrix<T, D> second_piola_kirchhoff(const Matrix<T, D>& C, const T& J) const {
    const Matrix<T, D> K = symmetric_cofactor(C);
    const T root = inverse_cube_root(J);
    const T a = root * root, inverse_J = a * root;
    const T w1 = T(mu) * a;
    const T pressure = T(kappa) * (J - T(1)) - w1 * first_invariant(C) * (inverse_J * T(1.0 / 3.0));
    const T scale = pressure * inverse_J;
    Matrix<T, D> S;
    for (int c = 0; c < D; ++c) {
      S(c, c) = w1 + scale * K(c, c);
      for (int r = 0; r < c; ++r) S(r, c) = S(c, r) = scale * K(r, c);
    }
    return S;
  }

  /// The strain energy W in J/m3, without cancellation near zero strain.
  template <class T, int D>
  [[nodiscard]] T energy(const Matrix<T, D>& C, const T& J) const {
    const T volumetric = J - T(1);
    return T(P(0.5) * mu) * detail::first_isochoric_excess(C, J) + T(P(0.5) * kappa) * (volumetric * volumetric);
  }

  /// The factors of I1 and I2 and the volumetric part, as `Continued` needs them.
  template <class T>
  [[nodiscard]] HMPS_INLINE detail::InvariantFactors<T> invariant_factors(const T& J) const {
    const T root = inverse_cube_root(J);
    const T a = root * root, inverse_J = a * root, volumetric = J - T(1);
    const T g1 = T(P(0.5) * mu) * a;
    return {.first = g1,
            .second = T(0),
            .volumetric = T(P(0.5) * kappa) * (volumetric * volumetric) - T(P(1.5) * mu),
            .first_slope = T(-2.0 / 3.0) * g1 * inverse_J,
            .second_slope = T(0),
            .volumetric_slope = T(kappa) * volumetric,
            .volumetric_curvature = T(kappa)};
  }
};

template <class P>
NeoHookean(P, P) -> NeoHookean<P>;

}  // namespace hmps::inline HMPS_ABI
