// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/laws/law.hpp"

namespace hmps::inline HMPS_ABI {

/// The Saint Venant-Kirchhoff law: linear elasticity in the Green-Lagrange strain E = (C - I) / 2,
///
///     W = lambda / 2 (tr E)^2 + mu E : E,    S = lambda tr(E) I + 2 mu E
///
/// for large rotations at small strain. It is finite for every F but softens without bound under
/// compression (below a stretch of 0.58 the force falls again) and does not resist inversion.
/// Two dimensions are plane strain.
template <class P = double>
struct SaintVenantKirchhoff {
  static_assert(detail::RequireReal<P>::value);
  P lambda;  ///< first Lame constant in Pa
  P mu;      ///< shear modulus in Pa

  /// The law with Young's modulus `young` in Pa and Poisson's ratio `poisson` at zero strain.
  [[nodiscard]] static SaintVenantKirchhoff from_young_poisson(P young, P poisson) {
    return {detail::lame_lambda(young, poisson), detail::shear_modulus_of(young, poisson)};
  }
  /// The law with the bulk modulus `bulk` and the shear modulus `shear` in Pa at zero strain.
  [[nodiscard]] static SaintVenantKirchhoff from_moduli(P bulk, P shear) { return {bulk - shear * P(2) / P(3), shear}; }

  [[nodiscard]] P bulk_modulus() const { return lambda + mu * P(2) / P(3); }
  [[nodiscard]] P shear_modulus() const { return mu; }

  /// Throws `InputError` if the bulk or shear modulus is not positive and finite, or if Poisson's ratio is below -1/2.
  void validate() const requires std::is_arithmetic_v<P> { detail::require_lame(*this, "SaintVenantKirchhoff"); }

  /// S = 2 dW/dC in Pa, \paper{14}, at C = F^T F. Does not use J.
  template <class T, int D>
  [[nodiscard]] HMPS_INLINE Matrix<T, D> second_piola_kirchhoff(const Matrix<T, D>& C, const T&) const {
    T strain_trace = C(0, 0) - T(1);
    for (int c = 1; c < D; ++c) strain_trace = strain_trace + (C(c, c) - T(1));
    const T spherical = T(P(0.5) * lambda) * strain_trace;
    Matrix<T, D> S;
    for (int c = 0; c < D; ++c) {
      S(c, c) = spherical + T(mu) * (C(c, c) - T(1));
      for (int r = 0; r < c; ++r) S(r, c) = S(c, r) = T(mu) * C(r, c);
    }
    return S;
  }

  /// The strain energy W in J/m3.
  template <class T, int D>
  [[nodiscard]] T energy(const Matrix<T, D>& C, const T&) const {
    Matrix<T, D> twice = C;
    for (int c = 0; c < D; ++c) twice(c, c) = C(c, c) - T(1);
    const T strain_trace = trace(twice);
    return T(P(0.125) * lambda) * (strain_trace * strain_trace) + T(P(0.25) * mu) * contract(twice, twice);
  }
};

template <class P>
SaintVenantKirchhoff(P, P) -> SaintVenantKirchhoff<P>;

}  // namespace hmps::inline HMPS_ABI
