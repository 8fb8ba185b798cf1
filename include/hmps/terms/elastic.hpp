// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <type_traits>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/laws/law.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

template <class Law>
concept ValidatesItself = requires(const Law& law) {
  law.validate();
};

/// Throws `InputError` if the stress `P` (Pa) at the small deformation `F` is not finite, if the Kirchhoff stress P F^T
/// is not symmetric, or if the stress falls from `at_rest`, the stress at F = 1, where the strain grows.
template <class K, int D>
HMPS_COLD void require_stress(const BlockOfParticles<K, D>& particles, const Matrix<Lanes<K>, D>& P,
                              const Matrix<Lanes<K>, D>& F, const Matrix<Lanes<K>, D>& at_rest) {
  constexpr double most = 0.05;  // far above rounding, and above the few thousandths of a law for small strain
  for (int l = 0; l < Lanes<K>::width; ++l) {
    const Index i = particles.particle(l);
    if (i == Blocks<K, D>::none) continue;
    Matrix<double, D> stress, gradient, rise;
    for (int k = 0; k < D * D; ++k) {
      stress(k % D, k / D) = static_cast<double>(P(k % D, k / D).lane[l]);
      gradient(k % D, k / D) = static_cast<double>(F(k % D, k / D).lane[l]);
      rise(k % D, k / D) = stress(k % D, k / D) - static_cast<double>(at_rest(k % D, k / D).lane[l]);
    }
    require(all_finite(stress), "hmps: the law of particle ", i,
            " gives a stress that is not finite at a strain of a thousandth: P is (by columns) ", stress,
            " Pa; check its parameters and formula");
    Matrix<double, D> kirchhoff, turning, strain;
    for (int c = 0; c < D; ++c)
      for (int r = 0; r < D; ++r) {
        kirchhoff(r, c) = 0;
        for (int k = 0; k < D; ++k) kirchhoff(r, c) += stress(r, k) * gradient(c, k);
        strain(r, c) = gradient(r, c) - (r == c ? 1 : 0);
      }
    for (int k = 0; k < D * D; ++k) turning(k % D, k / D) = kirchhoff(k % D, k / D) - kirchhoff(k / D, k % D);
    const auto norm = [](const Matrix<double, D>& M) { return std::sqrt(contract<double, D>(M, M)); };
    require(norm(turning) <= most * norm(kirchhoff), "hmps: the law of particle ", i,
            " gives a stress that exerts a torque: P F^T is (by columns) ", kirchhoff,
            " Pa, and must be symmetric; is S symmetric, or is P returned instead of S, or transposed?");
    require(contract<double, D>(rise, strain) >= -most * norm(rise) * norm(strain), "hmps: the law of particle ", i,
            " gives a stress that falls where the strain grows: at F - 1 = (by columns) ", strain, " P rises by ", rise,
            " Pa, so the undeformed state is unstable; is the sign of the stress right?");
  }
}

}  // namespace detail

/// The elastic force of the Hamiltonian MPS method, \paper{13}: the gradient of the strain energy
/// (\paper{5, 6}) with respect to the particles, M += F S A^-1 (see `Coupling`).
///
/// `Law` is a constitutive law, the same for all particles, or a callable that gives the law of the
/// particles of a block: `[&](const auto& at) { return MooneyRivlin{at(c1), at(c2), at(d1)}; }` with
/// views of parameters per particle, or `at(table, body)` per body.
template <class Law>
struct Elastic {
  Law law;

  template <class K, int D>
  HMPS_INLINE void couple(const BlockOfParticles<K, D>& particles, Coupling<K, D>& coupling) const {
    using T = Lanes<K>;
    const auto& own = detail::value_at(law, particles);
    const Matrix<T, D> stress = first_piola_kirchhoff(own, particles.deformation_gradient);
    const Matrix<T, D> pull = product(stress, particles.shape_inverse);
    for (int k = 0; k < D * D; ++k) coupling.M(k % D, k / D) += pull(k % D, k / D);
  }

  /// Throws `InputError` for a law of each particle with a bulk or shear modulus that is not positive, and for a law of
  /// your own whose stress at a small strain is not finite, exerts a torque (the Kirchhoff stress P F^T is not
  /// symmetric), or falls where the strain grows. Laws that validate themselves were checked when the term was made.
  template <class K, int D>
  requires(!detail::ValidatesItself<Law>) void check_parameters(const BlockOfParticles<K, D>& particles) const {
    const auto& own = detail::value_at(law, particles);
    if constexpr (requires { Lanes<K>(own.bulk_modulus() + own.shear_modulus()); }) {
      detail::require_values<K, D>(particles, Lanes<K>(own.shear_modulus()), "shear modulus of the law", "Pa", true);
      detail::require_values<K, D>(particles, Lanes<K>(own.bulk_modulus()), "bulk modulus of the law", "Pa", true);
    } else {
      const Matrix<Lanes<K>, D>& F = particles.deformation_gradient;
      Matrix<Lanes<K>, D> rest;
      for (int k = 0; k < D * D; ++k) rest(k % D, k / D) = Lanes<K>(static_cast<K>(k % D == k / D));
      detail::require_stress<K, D>(particles, first_piola_kirchhoff(own, F), F, first_piola_kirchhoff(own, rest));
    }
  }

  /// Fails to compile, with the name of the law, if the law does not serve the scalar and the dimension of the bonds.
  template <class K, int D>
  static constexpr bool serves() {
    using Own = std::remove_cvref_t<decltype(detail::value_at(std::declval<const Law&>(),
                                                              std::declval<const BlockOfParticles<K, D>&>()))>;
    return detail::RequireLaw<Own, Lanes<K>, D>::value;
  }

  /// W(F) in J/m3, \paper{6}.
  template <class Particle>
  [[nodiscard]] double energy(const Particle& particle) const {
    return static_cast<double>(energy_density(detail::value_at(law, particle), particle.deformation_gradient));
  }
  /// P = dW/dF in Pa, \paper{7}.
  template <class Particle>
  [[nodiscard]] Matrix<double, Particle::dimension> stress(const Particle& particle) const {
    return first_piola_kirchhoff(detail::value_at(law, particle), particle.deformation_gradient);
  }
};

/// The elastic force of a body made of `law`, \paper{13}, as a term of `internal_force`. Throws `InputError` for a law
/// with moduli that are not positive, if the law validates itself; `internal_force` checks others when it is made.
template <class Law>
[[nodiscard]] Elastic<Law> elastic(Law law) {
  if constexpr (requires { law.validate(); }) law.validate();
  return {std::move(law)};
}

}  // namespace hmps::inline HMPS_ABI
