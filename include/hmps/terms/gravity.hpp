// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// The weight of the particles, the force density rho g. As a term of `internal_force` it joins the last sweep, so that
/// `InternalForce::kick`, `relax` and `stable_step` include it. `add` applies it alone.
///
/// `Rho` is the density in kg/m3: a number, a `ScalarView` or a callable.
template <PerParticle Rho, int D>
struct Gravity {
  Rho density;
  Vector<double, D> acceleration;  ///< g in m/s2.

  template <class K>
  [[nodiscard]] HMPS_INLINE Vector<Lanes<K>, D> body_force(const BlockParameters<K, D>& particles) const {
    const Lanes<K> rho = detail::value_at(density, particles);
    Vector<Lanes<K>, D> force;
    for (int c = 0; c < D; ++c) force[c] = rho * static_cast<K>(acceleration[c]);
    return force;
  }

  /// - rho g.x in J/m3: zero at the origin.
  template <class Particle>
  [[nodiscard]] double energy(const Particle& particle) const {
    return -static_cast<double>(detail::value_at(density, particle)) * acceleration.dot(particle.position);
  }

  /// Throws `InputError` if the density is a view of the wrong size, or not positive at one of `size` particles.
  void check(std::size_t size) const { require_positive(density, size, "density of gravity", "kg/m3"); }

  /// Adds the weight to the force densities `f` (N/m3), for scenes whose forces are not all in one `internal_force`.
  /// Throws `InputError` for a density that is not positive or has the wrong size.
  template <class F, Executor E = Serial>
  void add(const VectorView<F, D>& f, const E& execute = {}) const {
    require_view(f, "force densities");
    require_positive(density, f.size(), "density", "kg/m3");
    detail::guarded(execute)(f.size(), [&](std::size_t i) {
      f.add(i, Vector<double, D>(static_cast<double>(at_particle(density, i)) * acceleration));
    });
  }
};

/// The weight of particles of `density` (kg/m3; a number, a view or a callable) under `acceleration` (m/s2):
/// `gravity(1000, Eigen::Vector3d(0, 0, -9.81))`. Throws `InputError` for a number that is not positive and an
/// acceleration that is not finite.
template <PerParticle Rho, class Derived>
[[nodiscard]] auto gravity(Rho density, const Eigen::MatrixBase<Derived>& acceleration) {
  constexpr int D = Derived::SizeAtCompileTime;
  static_assert(D == 2 || D == 3, "hmps: the acceleration of gravity has 2 or 3 components");
  if constexpr (std::is_arithmetic_v<Rho>) require_positive(density, 1, "density of gravity", "kg/m3");
  detail::require(detail::all_finite(acceleration), "hmps: the acceleration of gravity is (", acceleration.eval(),
                  ") m/s2; give finite numbers");
  return Gravity<Rho, D>{std::move(density), acceleration.template cast<double>()};
}

}  // namespace hmps::inline HMPS_ABI
