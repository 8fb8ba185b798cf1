// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "hmps/bonds/bonds.hpp"
#include "hmps/bonds/detail/followed_bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/cell_volume.hpp"
#include "hmps/core/detail/step.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/detail/force_stress.hpp"
#include "hmps/force/detail/force_sweeps.hpp"
#include "hmps/force/detail/restricted_blocks.hpp"
#include "hmps/force/force_energy.hpp"
#include "hmps/lanes/detail/staging.hpp"
#include "hmps/laws/law.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// The internal forces of one body, evaluated together in two sweeps over its bonds: one for the deformation gradient
/// and what depends on it, one for the sum in `Coupling`. Omitted terms cost nothing: without a coupling term there is
/// no first sweep, and without a damping term velocities are not read. A term of the mean dilatation adds two sweeps
/// with one number per bond, `mean_dilatation<2>` four; pair terms and body forces join the last sweep.
///
/// `internal_force` makes one. Its type can be written out, for example for a member of a class:
///
///     hmps::InternalForce<hmps::LatticeBonds<double, 3>, hmps::Elastic<hmps::MooneyRivlin<>>, hmps::Viscous> force;
///
/// To choose a force at run time, use `ForceFunction`, which holds any of them.
///
/// Refers to the bonds, which must outlive the force and may be moved (for example in a `std::vector` of bodies). Holds
/// scratch memory, but no state: one object serves any number of states, one at a time. `restrict_to` omits what only
/// particles with a forced displacement would need.
template <Bonds B, class... Terms>
class InternalForce {
 public:
  using Scalar = typename B::Scalar;
  static constexpr int dimension = B::dimension;

 private:
  using K = Scalar;
  static constexpr int D = dimension;
  using Sweeps = detail::ForceSweeps<B, Terms...>;
  static constexpr bool dilates = Sweeps::dilates, couples = Sweeps::couples, damps = Sweeps::damps;

 public:
  /// Throws `InputError` for bonds without particles, or if a term rejects the bonds, for example because it holds a
  /// view of the wrong size.
  explicit InternalForce(const B& bonds, Terms... terms) : followed_(bonds), sweeps_(bonds, std::move(terms)...) {
    // Not earlier: the class of a law may be complete only when a force is made.
    static_assert((detail::RequireTerm<Terms, K, D>::value && ...));
  }

  /// From now on, evaluates only what the particles with `moves(i)` need, i.e. those that follow the force. The forces
  /// of the others are unspecified. Terms such as `record` see the particles that move, those bonded to them, and the
  /// rest of their blocks. Particles deep inside a region with prescribed motion then cost only the copy of their
  /// state.
  template <class Moves>
  requires std::predicate<Moves&, std::size_t>
  void restrict_to(Moves&& moves) {
    const B& now = bonds();
    detail::require_scene(moves, now.size(), "that move in `restrict_to`");
    restricted_.restrict_to(now, moves, Sweeps::means);
    sweeps_.forget(now);
  }

  /// WRITES the force density (N/m3) of every particle at positions `x` (m) and velocities `v` (m/s) to `f`. Throws
  /// `InputError` for views of the wrong size. Does not check values: a NaN spreads to neighbours and to other
  /// particles of their blocks.
  template <class X, class V, class F, Executor E = Serial>
  void operator()(const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f,
                  const E& execute = {}) {
    const B& now = bonds();
    require_forces(now, x, v, f);
    evaluate(now, x, v, execute,
             [&](std::size_t block, const auto& force) HMPS_INLINE_LAMBDA { detail::deliver(now, block, f, force); });
  }

  /// The same for terms that do not read velocities.
  template <class X, class F, Executor E = Serial>
  requires(!damps) void operator()(const VectorView<X, D>& x, const VectorView<F, D>& f, const E& execute = {}) {
    (*this)(x, x, f, execute);
  }

  /// ADDS the force density (N/m3) of every particle to `f`, for example as a second force on the same particles.
  /// Throws as the call operator does.
  template <class X, class V, class F, Executor E = Serial>
  void add(const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f, const E& execute = {}) {
    const B& now = bonds();
    require_forces(now, x, v, f);
    evaluate(now, x, v, execute, [&](std::size_t block, const auto& force) HMPS_INLINE_LAMBDA {
      detail::deliver(now, block, f, force,
                      [](F& entry, K number, std::size_t) HMPS_INLINE_LAMBDA { entry += static_cast<F>(number); });
    });
  }

  /// Adds the effect of the forces over the time `dt` (s) to the velocities `v` (m/s), \paper{2}: equivalent to
  /// evaluation and `kick`, but within the last sweep, without an array of forces. Density `rho` in kg/m3: a number, a
  /// view or a callable. After `restrict_to`, the velocities of particles that do not follow the force are unspecified
  /// until they are prescribed. Throws `InputError` as those two do.
  template <class X, class V, PerParticle Rho, Executor E = Serial>
  void kick(const VectorView<X, D>& x, const VectorView<V, D>& v, const Rho& rho, double dt, const E& execute = {}) {
    static_assert(!std::is_const_v<V>, "hmps: kick changes the velocities; give it a writable view of them");
    const B& now = bonds();
    require_positive(rho, v.size(), "density", "kg/m3");
    require_sizes(now, x, v);
    require_apart(v, "velocities", x, "positions");
    detail::require_step(dt);
    // Other blocks read the staged copy of the velocities, so the originals may change meanwhile.
    evaluate(now, x, v, execute, [&](std::size_t block, const auto& force) HMPS_INLINE_LAMBDA {
      detail::deliver(now, block, v, force, [&](V& velocity, K density, std::size_t i) HMPS_INLINE_LAMBDA {
        detail::kick(velocity, density, at_particle(rho, i), dt);
      });
    });
  }

  /// Explains calls with arrays in place of views.
  template <class... Arguments>
  requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...>
  operator()(const Arguments&...);
  template <class... Arguments>
  requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> add(const Arguments&...);
  template <class... Arguments>
  requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> kick(const Arguments&...);
  template <class... Arguments>
  requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> energy(const Arguments&...)
  const;

  /// The energies of the terms at positions `x` (m), in J; the force is minus the gradient of their sum. With a law and
  /// `mean_dilatation` together, each has the energy of its own bulk modulus. Summed in double, in an order that does
  /// not depend on the executor. For diagnostics, not for every step. Ignores `restrict_to`: it is always the energy of
  /// all particles.
  ///
  /// @param volume  of a particle in the reference configuration in m^D, l0^D on a lattice: a number, a view or a
  ///                callable
  /// Throws `InputError` for views of the wrong size, for a volume that is not positive or cannot be that of a particle
  /// with these bonds, and for volumes other than those that the bonds were made with, if they were given any. A term
  /// of your own needs its own energy: see `ParticleState`.
  template <class X, PerParticle Vol, Executor E = Serial>
  [[nodiscard]] ForceEnergy<sizeof...(Terms)> energy(const VectorView<X, D>& x, const Vol& volume,
                                                     const E& execute = {}) const {
    const B& now = bonds();
    require_size(x, now.size(), "positions");
    require_positive(volume, now.size(), "volume", detail::unit_of_volume<D>());
    if (now.size() > 0) require_volume(now, detail::mean_of(volume, now.size()));
    detail::require_volumes_of(now, volume);
    return detail::energies(now, sweeps_.terms(), scales(), x, volume, execute);
  }

  /// WRITES the Cauchy stress in Pa of every particle at positions `x` (m) to `stress`, column-major: what the law and
  /// the mean dilatation of this force resist with together. `cauchy_stresses` of a law alone lacks the pressure of the
  /// mean dilatation, which may be most of it. `artificial`, `viscous` and pair terms have no stress of a single
  /// particle; a `CouplingTerm` of your own needs `stress(particle)`: see `ParticleState`. Computed in double, but F
  /// and the means have the rounding of the scalar type of the bonds. In two dimensions it is the part in the plane.
  /// Ignores `restrict_to`. Throws `InputError` for views of the wrong size and for positions that are not finite, and
  /// `StateError`, naming the particle, if a stress is not finite.
  template <class X, class R, Executor E = Serial>
  void cauchy_stresses(const VectorView<X, D>& x, const MatrixView<R, D>& stress, const E& execute = {}) const {
    write_stresses(x, stress, "Cauchy stress", execute, detail::cauchy_of<double, D>);
  }

  /// WRITES the first Piola-Kirchhoff stress of every particle, dW/dF in Pa, in the same way. The sum over particles of
  /// V P : dF is the change of the energies of those terms, without `artificial`, for any displacement.
  template <class X, class R, Executor E = Serial>
  void first_piola_kirchhoff_stresses(const VectorView<X, D>& x, const MatrixView<R, D>& stress,
                                      const E& execute = {}) const {
    write_stresses(x, stress, "first Piola-Kirchhoff stress", execute,
                   [](const Matrix<double, D>& P, const Matrix<double, D>&) { return P; });
  }

  /// The bonds at their current address. Throws `InputError` if they no longer exist.
  [[nodiscard]] const B& bonds() const { return followed_.now(); }
  /// Bytes of scratch memory.
  [[nodiscard]] std::size_t bytes() const { return sweeps_.bytes() + restricted_.bytes(); }

 private:
  /// Throws `InputError` for a volume that cannot be that of a particle with these bonds, such as a length in its
  /// place.
  static void require_volume(const B& bonds, double volume) {
    detail::require_cell_volume<D>(volume, std::sqrt(bonds.standard_lambda()), detail::volume_factor_of_bonds,
                                   "the volume of a particle", "a bond");
  }
  /// The scales of the mean dilatation; null if no term has one.
  [[nodiscard]] const typename B::template Slots<1>* scales() const {
    if constexpr (dilates)
      return &sweeps_.scales();
    else
      return nullptr;
  }
  template <class X, class R, class E, class Measure>
  void write_stresses(const VectorView<X, D>& x, const MatrixView<R, D>& stress, const char* name, const E& execute,
                      const Measure& measure) const {
    static_assert(!std::is_const_v<R>, "hmps: the stresses are written; give a writable view of them");
    const B& now = bonds();
    require_size(x, now.size(), "positions");
    require_size(stress, now.size(), "stresses");
    require_apart(stress, "stresses", x, "positions");
    require_finite(x, "the position");
    const detail::BodyState<B> body(now, sweeps_.terms(), x, scales(), execute);
    const auto P = detail::stresses(body, sweeps_.terms(), scales(), execute);
    detail::guarded(execute)(now.size(), [&](std::size_t i) { stress.set(i, measure(P[i], body.F[i])); });
    detail::require_finite_result<D>(stress, body.F, name);
  }
  template <class X, class V>
  static void require_sizes(const B& now, const VectorView<X, D>& x, const VectorView<V, D>& v) {
    require_size(x, now.size(), "positions");
    require_size(v, now.size(), "velocities");
    if constexpr (Sweeps::damps) require_apart(x, "positions", v, "velocities");
  }
  template <class X, class V, class F>
  static void require_forces(const B& now, const VectorView<X, D>& x, const VectorView<V, D>& v,
                             const VectorView<F, D>& f) {
    require_size(f, now.size(), "forces");
    require_sizes(now, x, v);
    require_apart(f, "forces", x, "positions");
    require_apart(f, "forces", v, "velocities");
  }

  /// Runs all sweeps over the bonds `now` at positions `x` and velocities `v`. The last one calls `take(block, force)`;
  /// `force(d)` returns the lanes of component d of the force density.
  template <class X, class V, class E, class Take>
  void evaluate(const B& now, const VectorView<X, D>& x, const VectorView<V, D>& v, const E& execute, Take&& take) {
    const auto common = detail::common_displacement(now, x);
    detail::guarded(execute)(now.block_count(),
                             [&](std::size_t block) { sweeps_.stage_state(now, block, x, v, common); });
    if constexpr (dilates) {
      restricted_.dilated(now, execute, [&](std::size_t block) { sweeps_.dilate(now, block); });
      if constexpr (Sweeps::means == 2)
        restricted_.dilated(now, execute, [&](std::size_t block) { sweeps_.average(now, block); });
      restricted_.dilated(now, execute, [&](std::size_t block) { sweeps_.press(now, block); });
      if constexpr (Sweeps::means == 2)
        restricted_.dilated(now, execute, [&](std::size_t block) { sweeps_.average(now, block); });
    }
    if constexpr (couples) restricted_.coupled(now, execute, [&](std::size_t block) { sweeps_.couple(now, block); });
    restricted_.summed(now, execute, [&](std::size_t block) { sweeps_.sum(now, block, take); });
  }

  detail::FollowedBonds<B> followed_;
  Sweeps sweeps_;
  detail::RestrictedBlocks<B> restricted_;
};

/// The internal force of the body with the bonds `bonds`, composed of `terms`: `internal_force(bonds, elastic(law),
/// artificial(E_hat), viscous(rho, nu))`.
template <Bonds B, class... Terms>
[[nodiscard]] InternalForce<B, Terms...> internal_force(const B& bonds, Terms... terms) {
  return InternalForce<B, Terms...>(bonds, std::move(terms)...);
}
/// Reports by name a type that does not model `Bonds`.
template <class B, class... Terms>
requires(!Bonds<B>) detail::RequireBonds<B> internal_force(const B& bonds, Terms... terms);
/// Deleted for temporary bonds: the force refers to the bonds, which must outlive it.
template <Bonds B, class... Terms>
void internal_force(const B&& bonds, Terms... terms) = delete;

}  // namespace hmps::inline HMPS_ABI
