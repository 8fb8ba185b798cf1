// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// An artificial force along the bonds, beside Kondo's: pulls the ends of each bond to the distance that the
/// deformation gradients of both predict. Its energy per volume,
///
///     C_i / 2 sum_j (|r_ij| - |F_i r0_ij|)^2 w_ij,      C_i by \paper{20} with `modulus` for E_hat,
///
/// is the part of Kondo's that lies along the bonds (to first order in r - F r0), so that `artificial(a)` and
/// `artificial_tension(b)` together resist what F does not resolve by a across the bonds and by a + b along them. Real
/// deformation that varies from particle to particle has more of it across the bonds if it twists, and more along them
/// if it bends; one modulus cannot be right for both. docs/theory.md derives the force.
///
/// Not in the paper. It costs a second sum over the bonds in the first sweep, and seven more numbers per bond (in two
/// dimensions four) in the last.
template <class Modulus>
struct ArtificialTension {
  Modulus modulus;

  /// C_i in Pa/m2.
  template <class K, int D>
  [[nodiscard]] HMPS_INLINE Lanes<K> length_stiffness(const BlockParameters<K, D>& particles) const {
    return artificial_coefficient(Lanes<K>(detail::value_at(modulus, particles)), D, particles.inverse_shape_trace());
  }

  /// C_i / 2 sum_j (|r_ij| - |F_i r0_ij|)^2 w_ij in J/m3.
  template <class Particle>
  [[nodiscard]] double energy(const Particle& particle) const {
    const auto own = static_cast<double>(detail::value_at(modulus, particle));
    return artificial_coefficient(own, Particle::dimension, particle.inverse_shape_trace()) * 0.5 *
           particle.length_misfit();
  }

  /// Throws `InputError` if the modulus is a view of the wrong size.
  void check(std::size_t size) const { detail::require_quantity(modulus, size, "moduli of the artificial tension"); }
  /// Throws `InputError` for a modulus that is negative or not finite.
  template <class K, int D>
  requires(!std::is_arithmetic_v<Modulus>) void check_parameters(const BlockOfParticles<K, D>& particles) const {
    detail::require_values<K, D>(particles, Lanes<K>(detail::value_at(modulus, particles)),
                                 "modulus of the artificial tension", "Pa");
  }
};

/// The artificial tension with `modulus` in Pa: a number, a view or a callable. Throws `InputError` for a number that
/// is negative or not finite. `internal_force` does the same for views and callables, with the values that they have
/// when it is made.
template <class Modulus>
[[nodiscard]] ArtificialTension<Modulus> artificial_tension(Modulus modulus) {
  if constexpr (std::is_arithmetic_v<Modulus>)
    detail::require(detail::is_finite(modulus) && modulus >= 0, "hmps: the modulus of the artificial tension is ",
                    modulus, " Pa; it must not be negative");
  return {std::move(modulus)};
}

}  // namespace hmps::inline HMPS_ABI
