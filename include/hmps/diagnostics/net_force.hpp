// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

/// The force and the moment on some particles together, and their mean displacement, summed in double in an order that
/// does not depend on the executor.
namespace hmps::inline HMPS_ABI {

namespace detail {
/// Adds up `term(i)` over the particles of `set`, in order.
template <class Sum, class Term, class E>
[[nodiscard]] Sum sum_over(const ParticleSet& set, const Term& term, const E& execute) {
  return reduce(
      set.size(), Sum(Sum::Zero()), [&](std::size_t k) -> Sum { return term(set.indices()[k]); },
      [](const Sum& a, const Sum& b) -> Sum { return a + b; }, execute);
}
}  // namespace detail

/// The net force in N (in two dimensions N/m) on the particles of `set`, the sum of f V. With the forces at rest, such
/// as those that `relax` leaves, that on held particles is minus the reaction of their support:
///
///     const auto pull = net_force(f, clamped, l0 * l0 * l0);  // what the body exerts on its clamp
///
/// Under a stress that is uniform up to a face, rather than at rest, the outermost layer alone carries about 1.5 times
/// the force on the face, and the next one the opposite of the excess: sum both.
///
/// @param f       force densities in N/m3
/// @param volume  of a particle in m^D, a number or a `ScalarView`
/// Throws `InputError` for a set made for another number of particles, views of different sizes and a volume that is
/// not positive and finite.
template <class F, int D, PerParticle Vol, Executor E = Serial>
[[nodiscard]] Vector<double, D> net_force(const VectorView<F, D>& f, const ParticleSet& set, const Vol& volume,
                                          const E& execute = {}) {
  require_size(f, set.scene_size(), "force densities");
  require_positive(volume, f.size(), "volume", detail::unit_of_volume<D>());
  using Sum = Vector<double, D>;
  return detail::sum_over<Sum>(
      set, [&](Index i) -> Sum { return static_cast<double>(at_particle(volume, i)) * f[i].template cast<double>(); },
      execute);
}

/// The net moment in N m (in two dimensions N) about the point `about` (m) on the particles of `set`, the sum of
/// (x - about) x f V. Throws as `net_force` does, and for a point that is not finite.
///
/// @param x  positions in m
template <class X, class F, int D, PerParticle Vol, Executor E = Serial>
[[nodiscard]] Axial<D> net_moment(const VectorView<X, D>& x, const VectorView<F, D>& f, const ParticleSet& set,
                                  const Vol& volume, const Vector<double, D>& about = Vector<double, D>::Zero(),
                                  const E& execute = {}) {
  require_size(x, set.scene_size(), "positions");
  require_size(f, set.scene_size(), "force densities");
  require_positive(volume, f.size(), "volume", detail::unit_of_volume<D>());
  detail::require(detail::all_finite(about), "hmps: the net moment was requested about the point (", about,
                  ") m; give finite numbers");
  return detail::sum_over<Axial<D>>(
      set,
      [&](Index i) -> Axial<D> {
        const Vector<double, D> arm = x[i].template cast<double>() - about;
        const Vector<double, D> own = static_cast<double>(at_particle(volume, i)) * f[i].template cast<double>();
        return cross<D>(arm, own);
      },
      execute);
}

/// The mean displacement in m of the particles of `set`, each of which counts once: the mean of x minus that of the
/// `reference` positions. It is accurate far from the origin too, because each difference is taken first. Throws
/// `InputError` for a set without particles or made for another number of them, and for views of different sizes.
///
/// @param x  positions in m
template <class X, class R, int D, Executor E = Serial>
[[nodiscard]] Vector<double, D> mean_displacement(const VectorView<X, D>& x, const VectorView<R, D>& reference,
                                                  const ParticleSet& set, const E& execute = {}) {
  require_size(x, set.scene_size(), "positions");
  require_size(reference, set.scene_size(), "reference positions");
  detail::require(!set.empty(), "hmps: the mean displacement of no particle was requested; name some");
  using Sum = Vector<double, D>;
  const Sum sum = detail::sum_over<Sum>(
      set, [&](Index i) -> Sum { return x[i].template cast<double>() - reference[i].template cast<double>(); },
      execute);
  return sum / static_cast<double>(set.size());
}

}  // namespace hmps::inline HMPS_ABI
