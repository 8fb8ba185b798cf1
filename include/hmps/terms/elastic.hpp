// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/laws/law.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

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

  /// Fails, with the name of the law, where it does not serve the scalar and the dimension of the bonds.
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
};

/// The elastic force of a body made of `law`, \paper{13}, as a term of `internal_force`. Throws `InputError` for a law
/// with moduli that are not positive, if the law validates itself.
template <class Law>
[[nodiscard]] Elastic<Law> elastic(Law law) {
  if constexpr (requires { law.validate(); }) law.validate();
  return {std::move(law)};
}

}  // namespace hmps::inline HMPS_ABI
