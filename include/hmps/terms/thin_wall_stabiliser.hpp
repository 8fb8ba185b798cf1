// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
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

/// Energies of a bent or twisted wall over its shear modulus and the square of the curvature, of one particle in each
/// layer. Lengths are in spacings.
template <class Real>
struct WallEnergies {
  Real twist_strain = 0, twist_misfit = 0;  // of two twists, the second turned by 45 degrees; misfit: for E_hat = mu
  Real bending_shear = 0, bending_volume = 0, bending_misfit = 0;  // in plane strain; volume: for K = mu
};

/// Adds those of the particle at `place`, of which `visit` calls a function with every bond r.
template <class Real, class Visit>
void add_energies(WallEnergies<Real>& sum, const Visit& visit) {
  using Matrix3 = Matrix<Real, 3>;
  Matrix3 A = Matrix3::Zero(), B[3] = {A, A, A};
  Real squares[3] = {0, 0, 0};
  visit([&](const Vector<Real, 3>& r, Real height) {
    const Real w = PaperWeight{}(r.norm(), Real(paper_radius_ratio));
    if (!(w > 0)) return;
    const Vector<Real, 3> u[3] = {{-r[1] * height, -r[0] * height, r[0] * r[1]},
                                  {-r[0] * height, r[1] * height, (r[0] * r[0] - r[1] * r[1]) / 2},
                                  {-r[0] * height, 0, r[0] * r[0] / 2}};
    A += w * r * r.transpose();
    for (int m = 0; m < 3; ++m) {
      B[m] += w * u[m] * r.transpose();
      squares[m] += w * u[m].squaredNorm();
    }
  });
  const Matrix3 inverse = A.inverse();
  for (int m = 0; m < 3; ++m) {
    const Matrix3 G = B[m] * inverse;
    const Real strain = (G + G.transpose()).squaredNorm() / 4, volume = G.trace() * G.trace();
    const Real misfit = Real(1.5) / A.trace() * (squares[m] - G.cwiseProduct(B[m]).sum());
    (m < 2 ? sum.twist_misfit : sum.bending_misfit) += misfit;
    (m < 2 ? sum.twist_strain : sum.bending_shear) += m < 2 ? strain : strain - volume / 3;
    if (m == 2) sum.bending_volume += volume / 2;
  }
}

/// The energies of `layers` hexagonal layers, `apart` spacings apart, each over the hollows of the next, whose
/// particles stand `disorder` of the distance of the sites from them: the standard deviation along both axes.
template <class Real>
[[nodiscard]] WallEnergies<Real> wall_energies(int layers, Real apart, Real disorder) {
  constexpr int samples = 400;
  const Real side = std::sqrt(2 / (std::sqrt(Real(3)) * apart)), rise = side * std::sqrt(Real(0.75));
  Real drawn = 0;
  // From -1/2 to 1/2; the parts of quadratic sequences behind the point are spread evenly, and independently in pairs.
  const auto off = [&](Real root) { return drawn * drawn * root - std::floor(drawn * drawn * root) - Real(0.5); };
  const auto moved = [&](Real x, Real y, Real z) {
    ++drawn;
    const Real by = disorder * std::sqrt(Real(12)) * side;
    return Vector<Real, 3>(x * side + by * off(std::sqrt(Real(2))), y * rise + by * off(std::sqrt(Real(3))), z);
  };
  WallEnergies<Real> sum;
  for (int layer = 0; layer < layers; ++layer)
    for (int sample = 0; sample < samples; ++sample) {
      const Vector<Real, 3> own = moved(0, 0, 0);
      add_energies(sum, [&](const auto& bond) {
        for (int other = 0; other < layers; ++other) {
          const Real height = (other + Real(0.5) - Real(0.5) * layers) * apart, hollow = Real(other % 2 - layer % 2);
          for (int p = -4; p <= 4; ++p)
            for (int q = -3; q <= 3; ++q)
              if (other != layer || p != 0 || q != 0)
                bond(moved(p + (q + hollow) / 2, q + hollow / 3, (other - layer) * apart) - own, height);
        }
      });
    }
  for (Real* energy :
       {&sum.twist_strain, &sum.twist_misfit, &sum.bending_shear, &sum.bending_volume, &sum.bending_misfit})
    *energy /= samples;
  return sum;
}

/// What makes a wall twist and bend correctly, over its shear modulus.
template <class Real>
struct WallModuli {
  Real artificial = 0, law = 0;  // E_hat, and the bulk modulus of the law
};

/// Those of fitted walls of a material with the bulk modulus `bulk` over its shear modulus.
template <class Real>
class FittedWallModuli {
 public:
  explicit FittedWallModuli(Real bulk) : plate_(4 * (bulk + Real(1) / 3) / (bulk + Real(4) / 3)) {}

  /// For layers `apart` spacings apart: between values that are 0.05 spacings apart.
  [[nodiscard]] WallModuli<Real> operator()(int layers, Real apart) {
    const Real at = std::max((apart - closest) / step, Real(0)), share = at - std::floor(at);
    const auto lower = static_cast<std::size_t>(at);
    const WallModuli<Real> a = node(layers, lower), b = share > 0 ? node(layers, lower + 1) : a;
    return {a.artificial + share * (b.artificial - a.artificial), a.law + share * (b.law - a.law)};
  }

 private:
  static constexpr Real closest = Real(0.6), step = Real(0.05);

  /// The standard deviation with which E_hat comes to that of layers of `fit_particles`; see docs/theory.md.
  static constexpr Real disorder = Real(0.14);

  [[nodiscard]] WallModuli<Real> node(int layers, std::size_t k) {
    auto& known = known_[layers];
    known.resize(std::max(known.size(), k + 1));
    if (!(known[k].artificial > 0)) {
      const Real apart = closest + step * static_cast<Real>(k), cube = std::pow(Real(layers), 3) * apart * apart;
      const WallEnergies<Real> e = wall_energies<Real>(layers, apart, disorder);
      const Real artificial = (cube / 3 - e.twist_strain) / e.twist_misfit;
      const Real rest = plate_ * cube / 24 - e.bending_shear - artificial * e.bending_misfit;
      known[k] = {artificial, rest / e.bending_volume};
    }
    return known[k];
  }

  Real plate_;  // E / (1 - nu^2)
  std::map<int, std::vector<WallModuli<Real>>> known_;
};

}  // namespace detail

/// Chooses E_hat of each particle, and the mean dilatation, so that walls of a few layers bend and twist correctly. For
/// particles of `fit_particles` that are bonded with the paper's weight and radius:
///
///     const auto fitted = fit_particles(shape, box, l0);
///     const auto [E_hat, bulk] = thin_wall_stabiliser(fitted.layers, fitted.layer_spacings, l0, K, mu);
///     internal_force(bonds, elastic(MooneyRivlin<>::from_young(E, bulk.law / 2)), mean_dilatation<2>(bulk.mean),
///                    artificial([&](const auto& at) { return at(scalars(E_hat)); }))
///
/// The choice is derived, not calibrated on bodies. A wall of thickness t with the twist kappa has the energy
/// mu kappa^2 t^3 / 6 per area, whatever its bulk modulus. E_hat makes the discrete energy, strain plus artificial,
/// equal to it for hexagonal layers in which each particle lies over a hollow of the next layer, with as much disorder
/// as `fit_particles` leaves. The law keeps, of the bulk modulus, what makes the energy of the same layers right when
/// they are bent in plane strain: in bulk
///
///     K_law = E / (1 - nu^2) - 4 mu / 3,       8 mu / 3 where the volume does not change
///
/// and up to 3.1 mu in walls of two layers, the mean over all particles of walls. The particles across a wall of two
/// layers have the same J in the mean, so that the wall cannot become thinner on one side only: with K_law, a wall that
/// cannot do so is as stiff as one that can. See docs/theory.md.
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
  const P bulk_law = 4 * mu * (K + mu / 3) / (K + 4 * mu / 3) - 4 * mu / 3;
  ThinWallStabiliser<P> chosen;
  chosen.moduli.reserve(layers.size());
  detail::FittedWallModuli<double> wall(static_cast<double>(K / mu));
  double law = 0, walls = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const double apart = static_cast<double>(layer_spacings[i]) / spacing;
    if (layers[i] == 0) {
      chosen.moduli.push_back(shear_wave_modulus(mu));
      continue;
    }
    detail::require(layers[i] >= 2 && layers[i] <= 8, "hmps: the wall at particle ", i, " has ", layers[i],
                    " layers; it takes two to bend, and more than eight are bulk (0)");
    detail::require(apart >= 0.6 - 1e-6 && apart <= 1.3, "hmps: the layers at particle ", i, " are ", apart,
                    " spacings apart; give a spacing of which they are 0.6 to 1.3");
    const detail::WallModuli<double> own = wall(layers[i], apart);
    chosen.moduli.push_back(static_cast<P>(own.artificial) * mu);
    law += own.law;
    ++walls;
  }
  // Of layers much closer than a spacing the sums would ask for less than none.
  const P asked = walls > 0 ? static_cast<P>(law / walls) * mu : bulk_law;
  chosen.bulk.law = std::min(K, std::max(asked, bulk_law / 2));
  chosen.bulk.mean = K - chosen.bulk.law;
  return chosen;
}

}  // namespace hmps::inline HMPS_ABI
