// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/types.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/shear_wave_modulus.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `thin_wall_stabiliser`, in Pa.
template <class P>
struct ThinWallStabiliser {
  std::vector<P> moduli;     ///< E_hat of \paper{20} of each particle, for `artificial`
  SplitBulkModulus<P> bulk;  ///< for the law and for `mean_dilatation<2>`
};

namespace detail {

/// E_hat / mu for which a wall of `layers` twists correctly; `c` is the distance of the layers in spacings.
[[nodiscard]] inline double thin_wall_modulus(int layers, double c) {
  const double side = std::sqrt(2 / (std::sqrt(3.0) * c)), rise = side * std::sqrt(0.75), radius = paper_radius_ratio;
  double strain = 0, misfit = 0;
  for (int k = 0; k < layers; ++k) {
    Matrix<double, 3> A = Matrix<double, 3>::Zero(), B[2] = {A, A};  // of two twists, the second turned by 45 degrees
    double squares[2] = {0, 0};
    for (int other = 0; other < layers; ++other) {
      const double z = (other + 0.5 - 0.5 * layers) * c, hollow = other % 2 - k % 2;
      for (int p = -5; p <= 5; ++p)
        for (int q = -3; q <= 3; ++q) {
          const Vector<double, 3> r((p + 0.5 * q + 0.5 * hollow) * side, (q + hollow / 3) * rise, (other - k) * c);
          const double w = PaperWeight{}(r.norm(), radius);
          if (!(w > 0)) continue;
          const Vector<double, 3> u[2] = {{-r[1] * z, -r[0] * z, r[0] * r[1]},
                                          {-r[0] * z, r[1] * z, (r[0] * r[0] - r[1] * r[1]) / 2}};
          A += w * r * r.transpose();
          for (int m = 0; m < 2; ++m) {
            B[m] += w * u[m] * r.transpose();
            squares[m] += w * u[m].squaredNorm();
          }
        }
    }
    for (int m = 0; m < 2; ++m) {
      const Matrix<double, 3> G = B[m] * A.inverse();
      strain += (G + G.transpose()).squaredNorm() / 4;
      misfit += 1.5 / A.trace() * (squares[m] - G.cwiseProduct(B[m]).sum());
    }
  }
  return (std::pow(layers, 3) * c * c / 3 - strain) / misfit;
}

}  // namespace detail

/// Chooses E_hat of each particle, and the mean dilatation, so that walls of a few layers bend and twist correctly. For
/// particles of `fit_particles` that are bonded with the paper's weight and radius:
///
///     const auto fitted = fit_particles(shape, box, l0);
///     const auto [E_hat, bulk] = thin_wall_stabiliser(fitted.layers, fitted.layer_spacings, l0, K, mu);
///     internal_force(bonds, elastic(MooneyRivlin<>::from_young(E, bulk.law / 2)), mean_dilatation<2>(bulk.mean),
///                    artificial([&](const auto& at) { return at(scalars(E_hat)); }))
///
/// The choice is derived, not calibrated. A wall of thickness t with the twist kappa has the energy mu kappa^2 t^3 / 6
/// per area, whatever its bulk modulus. E_hat makes the discrete energy, strain plus artificial, equal to it for
/// hexagonal layers in which each particle lies over a hollow of the next layer. The law keeps
///
///     K_law = E / (1 - nu^2) - 4 mu / 3,       8 mu / 3 where the volume does not change
///
/// because the two particles across a wall of two layers have the same J, so that the wall cannot become thinner on one
/// side only: with K_law, a wall that cannot do so is as stiff as one that can. See docs/theory.md.
///
/// @param layers          layers through the wall at each particle; 0 in bulk, where E_hat is `shear_wave_modulus`
/// @param layer_spacings  their distance in m
/// @param spacing         l0 in m
/// @param bulk_modulus, shear_modulus  of the material at zero strain in Pa
/// Throws `InputError` for moduli or a spacing that are not positive, a negative Poisson's ratio, lists of different
/// sizes, a single layer, and layers closer than 0.6 or further apart than 1.3 spacings.
template <class P, class S>
[[nodiscard]] ThinWallStabiliser<P> thin_wall_stabiliser(const std::vector<int>& layers,
                                                         const std::vector<S>& layer_spacings, double spacing,
                                                         P bulk_modulus, P shear_modulus) {
  (void)split_bulk_modulus(bulk_modulus, shear_modulus);  // for its errors
  detail::require(3 * bulk_modulus >= 2 * shear_modulus, "hmps: the bulk modulus ", bulk_modulus,
                  " Pa and the shear modulus ", shear_modulus,
                  " Pa give a negative Poisson's ratio; give the bulk modulus first, both in Pa");
  detail::require(detail::is_finite(spacing) && spacing > 0, "hmps: the particle spacing is ", spacing,
                  " m; it must be positive");
  detail::require(layers.size() == layer_spacings.size(), "hmps: ", layers.size(),
                  " particles have a number of layers but ", layer_spacings.size(),
                  " a spacing of layers; give both of each particle");
  const P K = bulk_modulus, mu = shear_modulus;
  const P law = std::min(K, 4 * mu * (K + mu / 3) / (K + 4 * mu / 3) - 4 * mu / 3);
  ThinWallStabiliser<P> chosen{{}, {law, K - law}};
  chosen.moduli.reserve(layers.size());
  int count = 0;
  double apart = 0, modulus = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const double c = static_cast<double>(layer_spacings[i]) / spacing;
    if (layers[i] == 0) {
      chosen.moduli.push_back(shear_wave_modulus(mu));
      continue;
    }
    detail::require(layers[i] >= 2 && layers[i] <= 8, "hmps: the wall at particle ", i, " has ", layers[i],
                    " layers; it takes two to bend, and more than eight are bulk (0)");
    detail::require(c >= 0.6 - 1e-6 && c <= 1.3, "hmps: the layers at particle ", i, " are ", c,
                    " spacings apart; give a spacing of which they are 0.6 to 1.3");
    if (layers[i] != count || c != apart)  // usually equal to that of the previous particle
      modulus = detail::thin_wall_modulus(count = layers[i], apart = c);
    chosen.moduli.push_back(static_cast<P>(modulus) * mu);
  }
  return chosen;
}

}  // namespace hmps::inline HMPS_ABI
