// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/spacing.hpp"
#include "hmps/core/detail/wall_layers.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/terms/detail/wall_column.hpp"
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

/// The walls of a fitted body, and the moduli with which they twist and bend correctly, over its shear modulus.
template <class Real>
class FittedWalls {
 public:
  /// `bulk`: the bulk modulus over the shear modulus.
  explicit FittedWalls(Real bulk)
      : bulk_(bulk), bulk_law_(4 * (bulk + Real(1) / 3) / (bulk + Real(4) / 3) - Real(4) / 3) {}

  /// Counts a particle of a wall with layers `apart` spacings apart. Returns its E_hat, interpolated between columns
  /// whose distances of layers differ by 0.05.
  Real add(int layers, Real apart) {
    const Real at = std::max((apart - closest) / step, Real(0)), share = at - std::floor(at);
    const auto lower = static_cast<std::size_t>(at);
    const Real modulus = count(layers, lower, 1 - share);
    return share > 0 ? (1 - share) * modulus + share * count(layers, lower + 1, share) : modulus;
  }

  /// The bulk modulus of the law with which the energies of bending are right, by least squares over the particles.
  /// Where the energies hardly depend on it, it stays near its value in bulk, E / (1 - nu^2) - 4/3.
  [[nodiscard]] Real law() const {
    if (known_.empty()) return bulk_law_;
    const Real lowest = std::log(bulk_law_ / 4), highest = std::log(bulk_);
    constexpr int steps = 100;
    const auto at = [&](Real k) { return lowest + std::clamp(k / steps, Real(0), Real(1)) * (highest - lowest); };
    int best = 0;
    for (int k = 1; k <= steps; ++k)
      if (cost(at(Real(k))) < cost(at(Real(best)))) best = k;
    Real from = Real(best - 1), to = Real(best + 1);
    for (int k = 0; k < 40; ++k) {  // ternary search
      const Real third = (to - from) / 3;
      if (cost(at(from + third)) < cost(at(to - third)))
        to -= third;
      else
        from += third;
    }
    return std::exp(at((from + to) / 2));
  }

 private:
  static constexpr Real closest = Real(closest_layers), step = Real(0.05);
  /// The standard deviation with which E_hat is that of layers of `fit_particles`; see docs/theory.md.
  static constexpr Real disorder = Real(0.14);
  /// The error of the energy that counts as much as a change of the law by a factor of e. With more than it needs, the
  /// law resists changes of J from particle to particle in all motions but bending.
  static constexpr Real reluctance = Real(0.05);

  struct Node {
    WallColumn<Real> column;
    Real artificial;
    Real particles = 0;
  };

  /// Counts a share of a particle in column `k` and returns its E_hat.
  Real count(int layers, std::size_t k, Real share) {
    auto found = known_.find({layers, k});
    if (found == known_.end()) {
      WallColumn<Real> column = hexagonal_column<Real>(layers, closest + step * static_cast<Real>(k), disorder);
      const Real artificial = column.artificial();
      found = known_.insert({{layers, k}, Node{std::move(column), artificial}}).first;
    }
    found->second.particles += share;
    return found->second.artificial;
  }

  [[nodiscard]] Real cost(Real logarithm) const {
    const Real law = std::exp(logarithm), change = reluctance * (logarithm - std::log(bulk_law_));
    Real sum = 0, particles = 0;
    for (const auto& [key, node] : known_) {
      const Real plate = node.column.plate(node.artificial, law, bulk_ - law) - 1;
      const Real strip = node.column.strip(node.artificial, law, bulk_ - law) - 1;
      sum += node.particles * (plate * plate + strip * strip) / 2;
      particles += node.particles;
    }
    return sum / particles + change * change;
  }

  Real bulk_, bulk_law_;
  std::map<std::pair<int, std::size_t>, Node> known_;
};

}  // namespace detail

/// Chooses E_hat of each particle, and the mean dilatation, so that walls of a few layers bend and twist correctly. For
/// particles of `fit_particles` that are bonded with the paper's weight and radius:
///
///     const auto fitted = fit_particles(shape, box, l0);
///     const auto [E_hat, bulk] = thin_wall_stabiliser(fitted.layers, fitted.layer_spacings, l0, K, mu);
///     internal_force(bonds, elastic(MooneyRivlin<>::from_moduli(bulk.law, mu)), mean_dilatation<2>(bulk.mean),
///                    artificial(scalars(E_hat)))
///
/// The choice is derived, for three dimensions, not calibrated on bodies. A wall of thickness t with the twist kappa
/// has the energy mu kappa^2 t^3 / 6 per area, whatever its bulk modulus. E_hat makes the discrete energy, strain plus
/// artificial, equal to it for hexagonal layers in which each particle lies over a hollow of the next layer, with as
/// much disorder as `fit_particles` leaves. The law keeps the part of the bulk modulus that makes the energies of the
/// same layers right when they are bent in plane strain and as a strip, by least squares over the particles of walls;
/// the mean dilatation has the rest. In bulk, and approximately where bending does not depend on it, the law keeps
///
///     K_law = E / (1 - nu^2) - 4 mu / 3,       8 mu / 3 if incompressible
///
/// See docs/theory.md.
///
/// @param layers          layers through the wall at each particle; 0 in bulk, where E_hat is `shear_wave_modulus`
/// @param layer_spacings  distance of these layers in m
/// @param spacing         l0 in m
/// @param bulk_modulus, shear_modulus  of the material at zero strain in Pa
/// Throws `InputError` for moduli or a spacing that are not positive, a negative Poisson's ratio, lists of different
/// sizes, a single layer or more than eight, and layers closer than 0.6 or further apart than 1.3 spacings.
template <class P, class S>
[[nodiscard]] ThinWallStabiliser<P> thin_wall_stabiliser(const std::vector<int>& layers,
                                                         const std::vector<S>& layer_spacings, double spacing,
                                                         P bulk_modulus, P shear_modulus) {
  (void)split_bulk_modulus(bulk_modulus, shear_modulus);  // for its errors
  detail::require_spacing(spacing, "the particles");
  detail::require(layers.size() == layer_spacings.size(), "hmps: the number of layers is given for ", layers.size(),
                  " particles, but their spacing for ", layer_spacings.size(), "; give both for each particle");
  const P K = bulk_modulus, mu = shear_modulus;
  ThinWallStabiliser<P> chosen;
  chosen.moduli.reserve(layers.size());
  detail::FittedWalls<double> walls(static_cast<double>(K) / static_cast<double>(mu));
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const double apart = static_cast<double>(layer_spacings[i]) / spacing;
    if (layers[i] == 0) {
      chosen.moduli.push_back(shear_wave_modulus(mu));
      continue;
    }
    detail::require(layers[i] >= 2 && layers[i] <= detail::most_layers, "hmps: the wall at particle ", i, " has ",
                    layers[i], " layers; it takes two to bend, and more than ", detail::most_layers, " are bulk (0)");
    detail::require(apart >= detail::closest_layers - 1e-6 && apart <= detail::farthest_layers + 1e-6,
                    "hmps: the layers at particle ", i, " are ", apart,
                    " spacings apart; give a spacing with which this is ", detail::closest_layers, " to ",
                    detail::farthest_layers);
    chosen.moduli.push_back(static_cast<P>(walls.add(layers[i], apart)) * mu);
  }
  chosen.bulk.law = std::min(K, static_cast<P>(walls.law()) * mu);
  chosen.bulk.mean = K - chosen.bulk.law;
  return chosen;
}

}  // namespace hmps::inline HMPS_ABI
