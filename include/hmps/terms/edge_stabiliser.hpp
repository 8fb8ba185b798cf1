// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `edge_stabiliser`, in Pa for each particle.
template <class P>
struct EdgeStabiliser {
  std::vector<P> moduli;   ///< E_hat of \paper{20}, for `artificial`
  std::vector<P> tension;  ///< for `artificial_tension`
};

/// Stabilises the edges of walls as bars, in three dimensions. The rim of a wall that is twisted shears across the wall
/// as a bar does, which E_hat of the wall resists too much; this is most of the error of narrow strips. For particles
/// of `fit_particles`:
///
///     const auto walls = thin_wall_stabiliser(fitted.layers, fitted.layer_spacings, l0, K, mu);
///     const auto [E_hat, tension] = edge_stabiliser(walls.moduli, fitted.edges);
///     internal_force(bonds, elastic(MooneyRivlin<>::from_moduli(walls.bulk.law, mu)),
///                    mean_dilatation<2>(walls.bulk.mean), artificial(scalars(E_hat)),
///                    artificial_tension(scalars(tension)))
///
/// Where all of the surface nearby is an edge, half of E_hat remains, and 7/2 E_hat is added along the bonds: the split
/// of `bar_stabiliser`, with which long shear waves keep their speed. Between edges and the middle of a wall both vary
/// in proportion to `edges`. Nothing is calibrated. docs/fitted.md compares bodies with and without it; as
/// `artificial_tension` does, it doubles the time of the force.
///
/// @param moduli  E_hat of each particle in Pa, as `thin_wall_stabiliser` returns them
/// @param edges   from `fit_particles`, between 0 and 1
/// Throws `InputError` for lists of different sizes, moduli that are not positive and edges that are not between 0 and
/// 1.
template <class P, class S>
[[nodiscard]] EdgeStabiliser<P> edge_stabiliser(const std::vector<P>& moduli, const std::vector<S>& edges) {
  static_assert(detail::RequireReal<P>::value);
  detail::require(moduli.size() == edges.size(), "hmps: the moduli are those of ", moduli.size(),
                  " particles, but the edges those of ", edges.size(), "; give both for each particle");
  EdgeStabiliser<P> chosen;
  chosen.moduli.reserve(moduli.size());
  chosen.tension.reserve(moduli.size());
  for (std::size_t i = 0; i < moduli.size(); ++i) {
    detail::require(detail::is_finite(moduli[i]) && moduli[i] > 0, "hmps: E_hat of particle ", i, " is ", moduli[i],
                    " Pa; it must be positive");
    detail::require(detail::is_finite(edges[i]) && edges[i] >= 0 && edges[i] <= 1, "hmps: the edge at particle ", i,
                    " is ", edges[i], "; it must be between 0 and 1, as fit_particles returns it");
    const P moved = static_cast<P>(edges[i]) / 2 * moduli[i];
    chosen.moduli.push_back(moduli[i] - moved);
    chosen.tension.push_back(7 * moved);
  }
  return chosen;
}

}  // namespace hmps::inline HMPS_ABI
