// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// C_i^art of \paper{20} in Pa/m2, E_hat d / sum |r0|^2 w, from E_hat in Pa, the number of dimensions
/// d, and 1 / sum |r0|^2 w in 1/m2.
template <class T>
[[nodiscard]] HMPS_INLINE T artificial_coefficient(const T& modulus, int dimension, const T& inverse_shape_trace) {
  return modulus * T(dimension) * inverse_shape_trace;
}

/// Kondo's artificial potential force, \paper{19}: pulls each neighbour towards the position that the deformation
/// gradient predicts, so that motions that F does not resolve cost energy. In terms of `Coupling`: M -= C F and c += C.
///
/// `Modulus` is E_hat in Pa: a number, a `ScalarView`, or a callable, `[&](const auto& at) { return 2 * at(mu); }`.
template <class Modulus>
struct Artificial {
  Modulus modulus;

  template <class K, int D>
  HMPS_INLINE void couple(const BlockOfParticles<K, D>& particles, Coupling<K, D>& coupling) const {
    const Lanes<K> own = detail::value_at(modulus, particles);
    const Lanes<K> C = artificial_coefficient(own, D, particles.inverse_shape_trace());
    const auto& F = particles.deformation_gradient;
    for (int k = 0; k < D * D; ++k) coupling.M(k % D, k / D) -= C * F(k % D, k / D);
    coupling.c += C;
  }

  /// C_i / 2 sum_j |r_ij - F_i r0_ij|^2 w_ij in J/m3, whose gradient is \paper{19}.
  template <class Particle>
  [[nodiscard]] double energy(const Particle& particle) const {
    const auto own = static_cast<double>(detail::value_at(modulus, particle));
    return artificial_coefficient(own, Particle::dimension, particle.inverse_shape_trace()) * 0.5 * particle.misfit();
  }

  /// Zero: it resists what F does not resolve.
  template <class Particle>
  [[nodiscard]] Matrix<double, Particle::dimension> stress(const Particle&) const {
    return Matrix<double, Particle::dimension>::Zero();
  }

  /// Throws `InputError` if the modulus is a view of the wrong size.
  void check(std::size_t size) const { detail::require_quantity(modulus, size, "moduli of the artificial force"); }
  /// Throws `InputError` for a modulus that is negative or not finite.
  template <class K, int D>
  requires(!std::is_arithmetic_v<Modulus>) void check_parameters(const BlockOfParticles<K, D>& particles) const {
    detail::require_values<K, D>(particles, Lanes<K>(detail::value_at(modulus, particles)),
                                 "modulus of the artificial force", "Pa");
  }
};

/// Kondo's stabiliser with E_hat = `modulus` in Pa (in the paper Young's modulus by \paper{18}): a number, a view or a
/// callable. Throws `InputError` for a number that is negative or not finite. `internal_force` does the same for
/// views and callables, with the values that they have when it is made.
template <class Modulus>
[[nodiscard]] Artificial<Modulus> artificial(Modulus modulus) {
  if constexpr (std::is_arithmetic_v<Modulus>)
    detail::require(detail::is_finite(modulus) && modulus >= 0, "hmps: the modulus of the artificial force is ",
                    modulus, " Pa; it must not be negative (the paper takes Young's modulus)");
  return {std::move(modulus)};
}

}  // namespace hmps::inline HMPS_ABI
