// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/laws/law.hpp"

namespace hmps::inline HMPS_ABI {

/// Linear elasticity in the small strain e = (F + F^T) / 2 - I,
///
///     W = lambda / 2 (tr e)^2 + mu e : e,    dW/dF = lambda tr(e) I + 2 mu e
///
/// for small strains and rotations, and for comparison with linear theory: a finite rotation causes strain. It is a law
/// of the deformation gradient, because C does not contain the rotation. Two dimensions are plane strain.
template <class P = double>
struct LinearElastic {
  static_assert(detail::RequireReal<P>::value);
  P lambda;  ///< first Lame constant in Pa
  P mu;      ///< shear modulus in Pa

  /// The law with Young's modulus `young` in Pa and Poisson's ratio `poisson`.
  [[nodiscard]] static LinearElastic from_young_poisson(P young, P poisson) {
    return {detail::lame_lambda(young, poisson), detail::shear_modulus_of(young, poisson)};
  }
  /// The law with the bulk modulus `bulk` and the shear modulus `shear` in Pa.
  [[nodiscard]] static LinearElastic from_moduli(P bulk, P shear) { return {bulk - shear * P(2) / P(3), shear}; }

  [[nodiscard]] P bulk_modulus() const { return lambda + mu * P(2) / P(3); }
  [[nodiscard]] P shear_modulus() const { return mu; }

  /// Throws `InputError` if the bulk or shear modulus is not positive and finite, or if Poisson's ratio is below -1/2.
  void validate() const requires std::is_arithmetic_v<P> { detail::require_lame(*this, "LinearElastic"); }

  /// dW/dF in Pa at the deformation gradient `F`; symmetric.
  template <class T, int D>
  [[nodiscard]] HMPS_INLINE Matrix<T, D> first_piola_kirchhoff(const Matrix<T, D>& F) const {
    T strain_trace = F(0, 0) - T(1);
    for (int c = 1; c < D; ++c) strain_trace = strain_trace + (F(c, c) - T(1));
    const T spherical = T(lambda) * strain_trace;
    Matrix<T, D> stress;
    for (int c = 0; c < D; ++c) {
      stress(c, c) = spherical + T(P(2) * mu) * (F(c, c) - T(1));
      for (int r = 0; r < c; ++r) stress(r, c) = stress(c, r) = T(mu) * (F(r, c) + F(c, r));
    }
    return stress;
  }

  /// The strain energy W in J/m3.
  template <class T, int D>
  [[nodiscard]] T energy(const Matrix<T, D>& F) const {
    Matrix<T, D> twice;
    for (int c = 0; c < D; ++c) {
      twice(c, c) = (F(c, c) - T(1)) + (F(c, c) - T(1));
      for (int r = 0; r < c; ++r) twice(r, c) = twice(c, r) = F(r, c) + F(c, r);
    }
    const T strain_trace = trace(twice);
    return T(P(0.125) * lambda) * (strain_trace * strain_trace) + T(P(0.25) * mu) * contract(twice, twice);
  }
};

template <class P>
LinearElastic(P, P) -> LinearElastic<P>;

}  // namespace hmps::inline HMPS_ABI
