// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// The viscous force of the standard MPS method, \paper{21}: rho nu times the MPS Laplacian of the velocity. n^0 and
/// lambda, which the paper takes from its references, are those of a particle inside the body, n^0 = sum w and lambda =
/// sum |r0|^2 w / sum w (`Blocks::standard_density` and `standard_lambda`).
///
/// It damps relative motion. At free surfaces, where neighbourhoods are asymmetric, it also damps rigid rotation.
struct Viscous {
  double density;    ///< rho in kg/m3.
  double viscosity;  ///< nu in m2/s.

  template <class K, int D>
  [[nodiscard]] double damping(const Blocks<K, D>& blocks) const {
    return density * viscosity * 2 * D / (blocks.standard_lambda() * blocks.standard_density());
  }
};

/// `Viscous` with a density and a viscosity that are views or callables: rho nu of a bond is the mean over its ends.
template <PerParticle Rho, PerParticle Nu>
struct ViscousOfEach {
  Rho density;   ///< rho in kg/m3.
  Nu viscosity;  ///< nu in m2/s.

  template <class K, int D>
  [[nodiscard]] HMPS_INLINE Lanes<K> damping(const BlockParameters<K, D>& particles) const {
    const Lanes<K> rho = detail::value_at(density, particles), nu = detail::value_at(viscosity, particles);
    const Blocks<K, D>& blocks = particles.blocks();
    return rho * nu * static_cast<K>(2 * D / (blocks.standard_lambda() * blocks.standard_density()));
  }

  /// Throws `InputError` if density or viscosity is a view of the wrong size.
  void check(std::size_t size) const {
    detail::require_quantity(density, size, "densities of the viscous force");
    detail::require_quantity(viscosity, size, "viscosities");
  }
  /// Throws `InputError` for a density that is not positive, a viscosity that is negative, and one that is not finite.
  template <class K, int D>
  void check_parameters(const BlockOfParticles<K, D>& particles) const {
    detail::require_values<K, D>(particles, Lanes<K>(detail::value_at(density, particles)),
                                 "density of the viscous force", "kg/m3", true);
    detail::require_values<K, D>(particles, Lanes<K>(detail::value_at(viscosity, particles)), "viscosity", "m2/s");
  }
};

namespace detail {
/// Throws `InputError` for a number that is not a valid density (kg/m3) or viscosity (m2/s).
template <class Rho, class Nu>
void require_viscous(const Rho& density, const Nu& viscosity) {
  if constexpr (std::is_arithmetic_v<Rho>)
    require(is_finite(density) && density > 0, "hmps: the density is ", density, " kg/m3; it must be positive");
  if constexpr (std::is_arithmetic_v<Nu>)
    require(is_finite(viscosity) && viscosity >= 0, "hmps: the viscosity is ", viscosity,
            " m2/s; it must not be negative");
}
}  // namespace detail

/// MPS viscosity as a term of `internal_force`: density rho in kg/m3 and kinematic viscosity nu in
/// m2/s (the paper: 1000 and 2e-3). Throws `InputError` for a density that is not positive or a
/// negative viscosity.
[[nodiscard]] inline Viscous viscous(double density, double viscosity) {
  detail::require_viscous(density, viscosity);
  return {density, viscosity};
}
/// The same with views or callables for one or both. Their values are read at each evaluation. When `internal_force` is
/// made, it throws for the same values.
template <PerParticle Rho, PerParticle Nu>
requires(!std::is_arithmetic_v<Rho> || !std::is_arithmetic_v<Nu>)
    [[nodiscard]] ViscousOfEach<Rho, Nu> viscous(Rho density, Nu viscosity) {
  detail::require_viscous(density, viscosity);
  return {std::move(density), std::move(viscosity)};
}

}  // namespace hmps::inline HMPS_ABI
