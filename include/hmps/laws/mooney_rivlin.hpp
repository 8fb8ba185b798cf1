// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/laws/invariants.hpp"
#include "hmps/laws/law.hpp"

namespace hmps::inline HMPS_ABI {

/// The Mooney-Rivlin law of nearly incompressible soft tissue, \paper{15, 16, 17}:
///
///     W = C1 (J^(-2/3) I1 - 3) + C2 (J^(-4/3) I2 - 3) + D1 (J - 1)^2
///
/// with the invariants I1, I2 of C. In two dimensions it is plane strain: F33 = 1, so I1 = tr C + 1
/// and I2 = det C + tr C.
///
/// The bulk modulus at zero strain is 2 D1, though section 3.7 of the paper calls D1 itself the bulk
/// modulus; `d1` is the D1 of \paper{15}, so the paper's tissue has `d1 = 1e6` and K = 2 MPa.
///
/// `J` must be positive (`Continued` extends the law to J <= 0). Rounding: with the relative precision eps of T the
/// stress has an error of about eps * 2 D1, which comes from the rounding of F itself, so no formula in F can avoid it;
/// the shear part adds eps * 2 (C1 + C2). The energy is evaluated without cancellation, to a few eps of its shear part.
///
/// `P` is the type of the parameters: a scalar, or a pack of lanes with one material per particle.
template <class P = double>
struct MooneyRivlin {
  static_assert(detail::RequireReal<P>::value);
  P c1;  ///< C1 in Pa
  P c2;  ///< C2 in Pa
  P d1;  ///< D1 in Pa, half the bulk modulus

  /// The law with Young's modulus `young` in Pa at zero strain by \paper{18}, E = 6 (C1 + C2), the volumetric constant
  /// `d1` in Pa and the `ratio` C1 / C2 (the paper: 1). Only this law has it; `from_young_poisson`, with Poisson's
  /// ratio, means the same in all laws.
  [[nodiscard]] static MooneyRivlin from_young(P young, P d1, P ratio = P(1)) {
    const P c2 = young / (P(6) * (P(1) + ratio));
    return {ratio * c2, c2, d1};
  }
  /// The law with Young's modulus `young` in Pa and Poisson's ratio `poisson` at zero strain, both exact (E = 9 K G /
  /// (3 K + G), not \paper{18}), and the `ratio` C1 / C2.
  [[nodiscard]] static MooneyRivlin from_young_poisson(P young, P poisson, P ratio = P(1)) {
    return from_moduli(young / (P(3) * (P(1) - P(2) * poisson)), young / (P(2) * (P(1) + poisson)), ratio);
  }
  /// The law with the bulk modulus `bulk` and the shear modulus `shear` in Pa at zero strain, and the `ratio` C1 / C2.
  [[nodiscard]] static MooneyRivlin from_moduli(P bulk, P shear, P ratio = P(1)) {
    const P c2 = shear / (P(2) * (P(1) + ratio));
    return {ratio * c2, c2, bulk / P(2)};
  }

  /// Young's modulus in Pa at zero strain by \paper{18}; exact for an incompressible material. The exact value at a
  /// finite bulk modulus, 9 K G / (3 K + G), is smaller by the fraction G / (3 K), 0.1 % for the paper's tissue.
  [[nodiscard]] P young() const { return P(6) * (c1 + c2); }
  /// The bulk modulus in Pa at zero strain, 2 D1.
  [[nodiscard]] P bulk_modulus() const { return P(2) * d1; }
  /// The shear modulus in Pa at zero strain, 2 (C1 + C2).
  [[nodiscard]] P shear_modulus() const { return P(2) * (c1 + c2); }

  /// Throws `InputError` if C1 + C2 or D1 is not positive and finite, or if the bulk modulus 2 D1 is so small compared
  /// with the shear modulus that Poisson's ratio is negative. No tissue is like that; the cause is a D1 that is
  /// Poisson's ratio, is in kPa or MPa, or is 2 / K as in other programs. The bound is stricter than that of the other
  /// laws, -1/2, because the D1 of soft tissue in kPa gives a ratio above that, such as -0.29. One of C1, C2 may be
  /// negative, as some fits give it.
  void validate() const requires std::is_arithmetic_v<P> {
    detail::require_modulus(shear_modulus(), "MooneyRivlin", "shear modulus 2 (C1 + C2)",
                            "give C1 + C2 > 0, or from_young with a positive Young's modulus");
    detail::require_modulus(d1, "MooneyRivlin", "volumetric constant D1",
                            "give half of the bulk modulus, for soft tissue about 1e6 Pa");
    const P K = bulk_modulus(), G = shear_modulus();
    // Rounding must not reject a ratio of exactly zero, K = 2 G / 3.
    detail::require(
        P(3) * K >= P(2) * G * (P(1) - P(16) * std::numeric_limits<P>::epsilon()),
        "hmps: the volumetric constant D1 of MooneyRivlin is ", d1, " Pa, so that the bulk modulus 2 D1 is ", K,
        " Pa with a shear modulus of ", G, " Pa, and Poisson's ratio ", (P(3) * K - P(2) * G) / (P(6) * K + P(2) * G),
        "; give D1 in Pa, half of the bulk modulus (for soft tissue about 1e6 Pa), or use from_young_poisson");
  }

  /// S = 2 dW/dC in Pa, \paper{14}, at C = F^T F and J = det F > 0.
  template <class T, int D>
  [[nodiscard]] HMPS_INLINE Matrix<T, D> second_piola_kirchhoff(const Matrix<T, D>& C, const T& J) const {
    const Matrix<T, D> K = symmetric_cofactor(C);
    const T I1 = first_invariant(C);
    const T I2 = second_invariant(C, K);
    // Every power of J from one root, without a division.
    const T root = inverse_cube_root(J);
    const T a = root * root;
    const T inverse_J = a * root;
    const T w1 = T(P(2) * c1) * a;
    const T w2 = T(P(2) * c2) * (a * a);
    // dJ/dC = J C^-1 / 2 and C^-1 = K / J^2.
    const T pressure = T(P(2) * d1) * (J - T(1)) - (w1 * I1 + (w2 + w2) * I2) * (inverse_J * T(1.0 / 3.0));
    return detail::combine(C, K, w1 + w2 * I1, w2, pressure * inverse_J);
  }

  /// The strain energy W in J/m3 of \paper{15}. Never negative for non-negative constants.
  template <class T, int D>
  [[nodiscard]] T energy(const Matrix<T, D>& C, const T& J) const {
    const T volumetric = J - T(1);
    return T(c1) * detail::first_isochoric_excess(C, J) + T(c2) * detail::second_isochoric_excess(C, J) +
           T(d1) * (volumetric * volumetric);
  }

  /// The factors of I1 and I2 and the volumetric part, as `Continued` needs them.
  template <class T>
  [[nodiscard]] HMPS_INLINE detail::InvariantFactors<T> invariant_factors(const T& J) const {
    const T root = inverse_cube_root(J);
    const T a = root * root, inverse_J = a * root, volumetric = J - T(1);
    const T g1 = T(c1) * a, g2 = T(c2) * (a * a);
    return {.first = g1,
            .second = g2,
            .volumetric = T(d1) * (volumetric * volumetric) - T(P(3) * (c1 + c2)),
            .first_slope = T(-2.0 / 3.0) * g1 * inverse_J,
            .second_slope = T(-4.0 / 3.0) * g2 * inverse_J,
            .volumetric_slope = T(P(2) * d1) * volumetric,
            .volumetric_curvature = T(P(2) * d1)};
  }
};

template <class P>
MooneyRivlin(P, P, P) -> MooneyRivlin<P>;

}  // namespace hmps::inline HMPS_ABI
