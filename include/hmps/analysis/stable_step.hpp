// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "hmps/analysis/detail/step_search.hpp"
#include "hmps/analysis/probed_scene.hpp"
#include "hmps/analysis/stable_step_settings.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI {

/// Estimates the largest stable step of symplectic Euler (\paper{2, 3, 4}) for the composed `force` in the state `x`,
/// `v`. Only evaluates the force; assembles no matrix.
///
/// Let the force respond to a displacement u with the acceleration -K u and to a velocity w with -C w. The scheme, with
/// the force at the old velocity, is stable while the largest eigenvalue of dt^2 K + 2 dt C is below 4: dt < 2 / omega
/// without damping, dt < 2 / c without stiffness, dt < 4 / (c + sqrt(c^2 + 4 omega^2)) for a mode with both. (For one
/// mode the step has the trace 2 - c dt - omega^2 dt^2 and the determinant 1 - c dt; with many modes, each eigenvector
/// obeys the same relation with its own quotients for omega^2 and c.) The eigenvector is found by conjugate gradients
/// on the mass-weighted Rayleigh quotient, from seeded noise, while dt is updated. An iteration takes one pair of force
/// evaluations, or two if the force depends on v.
///
/// The quotient approaches the eigenvalue from below, so `limit` approaches the true limit from above. `step` is
/// therefore smaller than `limit`: by the residual, within which an eigenvalue is certain to lie, and by `margin`. A
/// small residual may still belong to a smaller eigenvalue while the mode of a single weakly supported particle has not
/// yet emerged from the noise. The search therefore makes at least about 25 iterations, after which all but one in a
/// thousand starts have found every eigenvalue that matters for the margin. A margin of 0 omits this minimum.
///
/// To refresh the result during a run, pass its `mode` as `start`, and a different `seed`. The search then starts from
/// that mode with a tenth of noise and may stop after `refresh_iterations`. It follows a limiting mode that changes,
/// but may take several refreshes to notice a mode that appears elsewhere. To be safe, search without `start` now and
/// then.
///
/// The result holds for the given state; stretch and new contacts change it. A contact without penetration does not
/// count, except where nothing else in the force is stiff: the trial displacements then grow to a hundredth of a
/// spacing, and close gaps that are smaller. One whose penetration is smaller than the trial displacement counts about
/// half: set `perturbation` well below the penetrations, in spacings, and compare it with the one used if contact
/// computes in float. The derivatives of contact are not symmetric; in the scenes of docs/measured/stability.md the
/// limit nevertheless agreed with that of the true, unsymmetric motion within half a per cent.
///
/// @param density  in kg/m3, a number or a `ScalarView`
/// The views are not changed. The result does not depend on the executor if the force does not. Throws `InputError` for
/// bad settings or views, for an empty function as force, for a spacing that is not in the unit of the positions, for
/// trial displacements that vanish in the rounding of the positions, and if `start` or a set of particles in `moves` is
/// for a different number of particles; `StateError` if the force of a particle is not finite.
template <class Force, class X, class V, int D, PerParticle Rho, Executor E = Serial>
[[nodiscard]] StableStep stable_step(Force&& force, const VectorView<X, D>& x, const VectorView<V, D>& v,
                                     const Rho& density, const StableStepSettings& settings, const E& execute = {}) {
  using T = typename VectorView<X, D>::Scalar;
  static_assert(ProbedForce<Force, T, D>,
                "hmps: stable_step calls force(x, v, f) with VectorView<const T, D>, VectorView<const T, D> and "
                "VectorView<T, D> of the scalar of the positions; a composed force must not be const");
  detail::validate(settings);
  detail::require_force(force, "stable_step");
  detail::require(x.size() > 0, "hmps: stable_step was given no particles");
  require_size(v, x.size(), "velocities");
  require_positive(density, x.size(), "density", "kg/m3");
  detail::require_scene(settings.moves, x.size(), "that move in stable_step");
  require_finite(x, "the position");
  require_finite(v, "the velocity");
  detail::require_spacing_of(x, settings.spacing, "stable_step", detail::most_compressed);
  const detail::AnyExecutor loops = std::cref(execute);
  detail::ProbedScene<T, D> scene("stable_step", force, x, v, density, detail::trial_displacement<T>(settings), loops);
  return detail::StepSearch<T, D>(scene, settings, loops).run();
}

/// Explains calls with arrays in place of views.
template <class Force, class X, class V, class Rho, class... E>
requires(!detail::AreWrapped<X, V, Rho>::value) detail::RequireViews<X, V, Rho> stable_step(Force&&, const X&, const V&,
                                                                                            const Rho&,
                                                                                            const StableStepSettings&,
                                                                                            const E&...);

}  // namespace hmps::inline HMPS_ABI
