// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/laws/invariants.hpp"
#include "hmps/laws/law.hpp"

namespace hmps::inline HMPS_ABI {

/// A law that `Continued` can continue: of the form W = g1(J) I1 + g2(J) I2 + h(J), with
/// `law.invariant_factors(J)` beside `second_piola_kirchhoff` and `energy`. Satisfied by
/// `MooneyRivlin` and `NeoHookean`.
template <class Law>
concept ContinuableLaw = requires(const Law& law, double J) {
  { law.invariant_factors(J) } -> std::same_as<detail::InvariantFactors<double>>;
};

/// `law` with a continuation below J = `j_min`. Optional, and a departure from the paper, whose J^(-2/3) is undefined
/// for the crushed and inverted particles of a hard squeeze.
///
/// For J >= `j_min` stress and energy are those of `law` to the last bit. Below `j_min`, the factors g1 and g2 of W =
/// g1(J) I1 + g2(J) I2 + h(J) continue along their tangents at `j_min`, and h along its osculating parabola, which for
/// the laws of the library is h itself. Thus W is finite for every F, even for J <= 0, and grows as J falls: the force
/// pushes the particle back towards J > 0. Energy and stress are continuous at `j_min`, and the stress is the
/// derivative of the energy everywhere, so energy is conserved. Below `j_min` the material is never stiffer in J than
/// at `j_min`.
///
/// A small `j_min` leaves more of the law unchanged, but the isochoric stiffness grows like J^(-8/3) down to `j_min`,
/// and the stable time step shrinks accordingly.
template <class Law, class P = double>
struct Continued {
  static_assert(ContinuableLaw<Law>,
                "hmps: Continued needs a law with invariant_factors(J), such as MooneyRivlin or NeoHookean; "
                "SaintVenantKirchhoff and LinearElastic are finite for every F as they are");
  Law law;
  P j_min = P(0.2);  ///< the smallest J at which the law itself is used, in (0, 1)

  [[nodiscard]] auto bulk_modulus() const { return law.bulk_modulus(); }
  [[nodiscard]] auto shear_modulus() const { return law.shear_modulus(); }

  /// Throws `InputError` unless the law is valid and 0 < `j_min` < 1.
  void validate() const requires std::is_arithmetic_v<P> {
    law.validate();
    detail::require(detail::is_finite(j_min) && j_min > P(0) && j_min < P(1), "hmps: j_min of Continued is ", j_min,
                    "; it must lie between 0 and 1, for example 0.2");
  }

  /// dW/dF in Pa at any deformation gradient `F`.
  template <class T, int D>
  [[nodiscard]] HMPS_INLINE Matrix<T, D> first_piola_kirchhoff(const Matrix<T, D>& F) const {
    const Matrix<T, D> C = right_cauchy_green(F);
    const T J = determinant(F), bound = T(j_min);
    const auto inside = J >= bound;
    const Matrix<T, D> own = product(F, law.second_piola_kirchhoff(C, T(select(inside, J, bound))));
    // d(I1)/dF = 2 F, d(I2)/dF = 2 F (I1 I - C), dJ/dF = cof F.
    const detail::InvariantFactors<T> at = law.invariant_factors(bound);
    const T below = J - bound;
    const T g1 = at.first + at.first_slope * below, g2 = at.second + at.second_slope * below;
    const T I1 = first_invariant(C), I2 = second_invariant(C, symmetric_cofactor(C));
    const T slope = at.first_slope * I1 + at.second_slope * I2 + at.volumetric_slope + at.volumetric_curvature * below;
    const T unit = (g1 + g1) + (g2 + g2) * I1, linear = g2 + g2;
    const Matrix<T, D> K = cofactor(F), FC = product(F, C);
    Matrix<T, D> stress;
    for (int c = 0; c < D; ++c) {
      for (int r = 0; r < D; ++r) {
        const T continued = unit * F(r, c) - linear * FC(r, c) + slope * K(r, c);
        stress(r, c) = select(inside, own(r, c), continued);
      }
    }
    return stress;
  }

  /// The strain energy W in J/m3 at any deformation gradient `F`.
  template <class T, int D>
  [[nodiscard]] T energy(const Matrix<T, D>& F) const {
    const Matrix<T, D> C = right_cauchy_green(F);
    const T J = determinant(F), bound = T(j_min);
    const auto inside = J >= bound;
    const T own = law.energy(C, T(select(inside, J, bound)));
    const detail::InvariantFactors<T> at = law.invariant_factors(bound);
    const T below = J - bound;
    const T I1 = first_invariant(C), I2 = second_invariant(C, symmetric_cofactor(C));
    const T continued = (at.first + at.first_slope * below) * I1 + (at.second + at.second_slope * below) * I2 +
                        (at.volumetric + below * (at.volumetric_slope + T(0.5) * at.volumetric_curvature * below));
    return select(inside, own, continued);
  }
};

template <class Law>
Continued(Law) -> Continued<Law>;
template <class Law, class P>
Continued(Law, P) -> Continued<Law, P>;

}  // namespace hmps::inline HMPS_ABI
