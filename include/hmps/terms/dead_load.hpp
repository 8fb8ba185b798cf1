// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// A force that is spread evenly over the volume of some particles and does not change while they move, such as a
/// weight that hangs at the end of a bar. As a term of `internal_force` it joins the last sweep, so that
/// `InternalForce::kick`, `relax` and `stable_step` include it. `add` applies it alone.
template <int D>
struct DeadLoad {
  ParticleSet loaded;
  Vector<double, D> density;  ///< The force density of each of them in N/m3.

  template <class K>
  [[nodiscard]] HMPS_INLINE Vector<Lanes<K>, D> body_force(const BlockParameters<K, D>& particles) const {
    Vector<Lanes<K>, D> force;
    for (int c = 0; c < D; ++c) force[c] = Lanes<K>(K(0));
    for (int l = 0; l < Lanes<K>::width; ++l) {
      const Index i = particles.particle(l);
      if (i == Blocks<K, D>::none || !loaded(i)) continue;
      for (int c = 0; c < D; ++c) force[c].lane[l] = static_cast<K>(density[c]);
    }
    return force;
  }

  /// - f.x in J/m3: zero at the origin.
  template <class Particle>
  [[nodiscard]] double energy(const Particle& particle) const {
    return loaded(particle.index) ? -density.dot(particle.position) : 0.0;
  }

  /// Throws `InputError` unless the particles are those of a scene of `size` particles.
  void check(std::size_t size) const { detail::require_scene(loaded, size, "under a dead load"); }

  /// Adds the load to the force densities `f` (N/m3), for scenes whose forces are not all in one `internal_force`, and
  /// for loads that grow: `dead_load(tip, share * force, volume).add(f)`. Throws `InputError` for another number of
  /// particles.
  template <class F, Executor E = Serial>
  void add(const VectorView<F, D>& f, const E& execute = {}) const {
    require_size(f, loaded.scene_size(), "force densities");
    detail::guarded(execute)(loaded.size(), [&](std::size_t k) { f.add(loaded.indices()[k], density); });
  }
};

/// The load `force` (N, in two dimensions N/m) on the particles of `loaded`: each gets the force density
/// force / sum V, so that the forces f V add up to `force`. `volume` is that of a particle in the reference
/// configuration (m^D), a number or a `ScalarView`, the same as of the bonds:
///
///     auto pulled = internal_force(bonds, elastic(law), dead_load(tip, Eigen::Vector3d(0, 0, -0.2), l0 * l0 * l0));
///
/// Throws `InputError` for a set without particles, a force that is not finite, a volume that is not positive, and a
/// view of volumes of another size.
template <class Derived, PerParticle Vol>
[[nodiscard]] auto dead_load(ParticleSet loaded, const Eigen::MatrixBase<Derived>& force, const Vol& volume) {
  constexpr int D = Derived::SizeAtCompileTime;
  static_assert(D == 2 || D == 3, "hmps: the force of a dead load has 2 or 3 components");
  detail::require(!loaded.empty(), "hmps: a dead load acts on no particle; name those that carry it");
  detail::require(detail::all_finite(force), "hmps: the force of a dead load is (", force.eval(),
                  ") N; give finite numbers");
  require_positive(volume, loaded.scene_size(), "volume", detail::unit_of_volume<D>());
  double whole = 0;
  for (const Index i : loaded) whole += static_cast<double>(at_particle(volume, i));
  return DeadLoad<D>{std::move(loaded), force.template cast<double>() / whole};
}

}  // namespace hmps::inline HMPS_ABI
