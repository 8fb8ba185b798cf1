// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/laws/law.hpp"

namespace hmps::inline HMPS_ABI {

/// Settings of `check_law`.
struct LawCheckSettings {
  double strain = 0.2;       ///< Largest component of F - 1 that is tried, above 0 and at most 0.25.
  double tolerance = 1e-6;   ///< Largest error of the stress, as a fraction of it, above 0 and at most 0.1.
  bool prestressed = false;  ///< Whether the law may have a stress at F = 1, as active or growing tissue has.
};

/// Checks a law of your own, in a test or once before a run: its stress must be the derivative of its energy, P = dW/dF
/// (\paper{7, 14}), at twelve deformations, and zero at F = 1. If the first fails, the force is not conservative; if
/// the second fails, the law deforms the body before any load.
///
///     hmps::check_law(law);     // in three dimensions
///     hmps::check_law<2>(law);  // in plane strain
///
/// Throws `InputError`, with F, the stress and the derivative, if either fails or a value is not finite, and for
/// settings out of range.
template <int D = 3, class Law>
void check_law(const Law& law, const LawCheckSettings& settings = {}) {
  using Tensor = Matrix<double, D>;
  static_assert(
      LawWithEnergy<Law, double, D>,
      "hmps: check_law compares the stress of a law with its energy; give it energy(C, J), or energy(F) if it "
      "is a law of the deformation gradient");
  const double strain = settings.strain, tolerance = settings.tolerance;
  detail::require(detail::is_finite(strain) && strain > 0 && strain <= 0.25 && detail::is_finite(tolerance) &&
                      tolerance > 0 && tolerance <= 0.1,
                  "hmps: check_law was given a strain of ", strain, " and a tolerance of ", tolerance,
                  "; give fractions: the first must be above 0 and at most 0.25, the second above 0 and at most 0.1");
  const auto stress = [&](const Tensor& F) { return first_piola_kirchhoff<Law, double, D>(law, F); };
  const auto energy = [&](const Tensor& F) { return energy_density<Law, double, D>(law, F); };

  double largest = 0;  // stress in Pa
  for (int sample = 1; sample <= 12; ++sample) {
    Tensor F = Tensor::Identity(), slope;
    for (int k = 0; k < D * D; ++k)  // scattered evenly: multiples of the golden section
      F(k % D, k / D) += settings.strain * std::remainder((sample * D * D + k) * 1.2360679774997898, 2.0);
    for (int k = 0; k < D * D; ++k) {
      constexpr double h = 1e-4;  // fourth order: exact to about 1e-11, rounding included
      const auto at = [&](double by) {
        Tensor moved = F;
        moved(k % D, k / D) += by;
        return energy(moved);
      };
      slope(k % D, k / D) = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    }
    const Tensor P = stress(F);
    largest = std::max(largest, P.norm());
    detail::require(detail::all_finite(P) && detail::all_finite(slope) &&
                        (P - slope).norm() <= settings.tolerance * std::max(P.norm(), slope.norm()),
                    "hmps: the stress of the law is not the derivative of its energy: at F = (by columns) ", F,
                    " P is ", P, " Pa, but dW/dF is ", slope,
                    " Pa; check the formulas for a wrong factor (S is 2 dW/dC), or a term that only one of them has");
  }
  const Tensor rest = stress(Tensor::Identity());
  detail::require(detail::all_finite(rest) && (settings.prestressed || rest.norm() <= settings.tolerance * largest),
                  "hmps: the law has the stress P = (by columns) ", rest,
                  " Pa at F = 1, so that a body deforms before any load; in two dimensions I1 is first_invariant(C), "
                  "which counts C33 = 1, not trace(C). If the stress is intended, set LawCheckSettings::prestressed");
}

}  // namespace hmps::inline HMPS_ABI
