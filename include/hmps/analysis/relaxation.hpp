// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "hmps/analysis/detail/relaxation_progress.hpp"
#include "hmps/analysis/detail/relaxing_body.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace hmps::inline HMPS_ABI {

/// Finds the static equilibrium of a body under the composed `force`, by dynamic relaxation with kinetic damping.
///
/// The particles start at rest and follow symplectic Euler (\paper{2, 4}). When their kinetic energy passes a peak,
/// that is, when the power of the forces f . v turns negative, the particles return to the peak, found by linear
/// interpolation of the power within the last step, and stop. For a linear body this is the minimum of the potential
/// energy along the step, so stopping never increases the energy. Without the return, a mode with four steps per period
/// would oscillate forever. The first kick after a stop takes half a step, which centres the velocities between the
/// positions. The search ends when the body is at rest and the unbalanced forces are below `tolerance` times the load.
///
///     const auto found = relax(force, x, v, f, rho, {.spacing = l0, .load = weight, .moves = moves});
///
/// The equilibrium depends on neither time nor mass: `rho` may be the density of the material or any other density. A
/// density per particle that is proportional to the local stiffness needs fewer iterations if stiff and soft parts are
/// combined. Leave viscosity out: it slows the search and does not change the result. If a load overshoots too far,
/// apply it in increments and call `relax` for each. Starting close to the result saves most.
///
/// The search lasts for a few quarter periods of the slowest mode that the load moves. On a lattice along a body, an
/// even pull does not bend the body, by symmetry. On fitted particles and turned lattices it does, a little, so that
/// the search takes several times as many iterations under such a load: see docs/fitted.md.
///
/// Contact of a fixed penalty coefficient, without friction and damping, may be given any step dt that its penalty
/// allows. With friction, give it about the step that `relax` takes without (`Relaxation::step`), or half of that:
/// friction damps slip within dt, so that the search takes the longer the shorter dt is. With `SpringFriction` the
/// result depends on the path, because friction carries a load at rest: between calls, move walls by less than the
/// elastic slip at its limit, mu times the penetration, as they otherwise slide at once. With `CorrectedFriction` and
/// `PaperFriction`, which resist only while something slips, the result is that without friction.
///
/// @param force  `force(x, v, f)` writes force densities (N/m3), as for `stable_step`: the result of
///               `internal_force`, or a lambda that adds several forces and the load
/// @param x      positions in m, changed; those of particles that do not move are kept
/// @param v      velocities in m/s, zero at the end
/// @param f      force densities; at the end those at rest, which for particles that do not move are minus
///               the reactions of their supports
/// @param rho    density in kg/m3, a number or a `ScalarView`
/// The result does not depend on the executor if the force does not. Positions in float may be too coarse for a small
/// tolerance, and forces of bonds in float as well: a bar of `LatticeBonds<float, 3>` that sags by 23 mm stays at a
/// residual of 0.005. Keep both in double. Throws `InputError` for bad settings, an empty function as force, a spacing
/// far from that of the particles, views of different sizes, values that are not finite, and a force that never writes
/// anything. Throws `StateError` if a force is not finite, if the unbalanced forces no longer decrease, after
/// `max_iterations`, and if nothing holds the body: once a net force has moved it by three times its size, or a net
/// moment has turned it by a whole turn, without having changed in size. The message then names both: hold some
/// particles, or subtract the mean force, and the moment, as for a free body under `Pressure`. After `max_iterations`
/// it also says if the body has moved as a whole, which a net force below the tolerance does to a body that is free to
/// slide or roll. The state is the last one reached.
template <class Force, class X, class V, class F, int D, PerParticle Rho, Executor E = Serial>
Relaxation relax(Force&& force, const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f,
                 const Rho& rho, const RelaxationSettings& settings, const E& execute = {}) {
  static_assert(!std::is_const_v<X> && !std::is_const_v<V> && !std::is_const_v<F>,
                "hmps: relax changes positions, velocities and forces; give it writable views of them");
  using Read = VectorView<const X, D>;
  static_assert(std::invocable<Force&, const Read&, const VectorView<const V, D>&, const VectorView<F, D>&>,
                "hmps: relax calls force(x, v, f) with read-only views of positions and velocities and a view of the "
                "force densities; a composed force must not be const");
  detail::require_force(force, "relax");
  detail::require_relaxable(x, v, f, rho, settings);
  detail::RelaxingBody body(x, v, f, rho, settings, execute);

  Relaxation result;
  detail::RelaxationStep step(settings);
  detail::RelaxationProgress progress(body, settings);
  body.stop();
  double before = 0, flown = 0;  // power at the start of the last drift; path of the fastest since the last stop, in m
  for (bool at_rest = true;; ++result.iterations) {
    body.clear_forces();
    force(Read(x), VectorView<const V, D>(v), f);
    ++result.evaluations;
    const detail::Unbalanced sums = body.unbalanced();
    if (result.iterations == 0 && sums.moving + sums.held == 0) {
      detail::require_response(force, Read(x), VectorView<const V, D>(v), f, settings.spacing);
      body.clear_forces();
    }
    const double carried = settings.load > 0 ? settings.load : sums.held * body.volume();
    if (!detail::is_finite(sums.moving + sums.power + carried))
      detail::throw_not_finite(f, settings.load > 0 ? body.follows() : std::vector<char>(x.size(), 1),
                               result.iterations);
    result.load = carried;
    result.residual = sums.moving > 0 ? sums.moving * body.volume() / carried : 0.0;
    result.step = step.value();
    if (settings.progress) settings.progress(result);

    const bool balanced = result.residual <= settings.tolerance;
    if (balanced && at_rest) break;
    if (balanced || sums.power < 0) {
      // A balance in motion counts only if it persists at rest: the force may depend on the velocities.
      if (!balanced) body.go_back(step.value() * sums.power / (sums.power - before));
      body.stop();
      at_rest = true;
      flown = 0;
      ++result.peaks;
      continue;
    }
    progress.require(result, step.damped(), flown += sums.fastest * step.value());
    step.update(force, Read(x), VectorView<const V, D>(v), rho, sums.fastest, execute);
    const double kicked = at_rest ? step.value() / 2 : step.value();
    kick(v, f, rho, kicked, execute);
    before = sums.power + kicked * sums.gain;
    at_rest = false;
    body.hold();
    drift(x, v, step.value(), execute);
  }
  result.step = step.value();
  result.evaluations += step.evaluations();
  return result;
}

/// Explains calls with arrays in place of views.
template <class Force, class X, class V, class F, class Rho, class... E>
requires(!detail::AreWrapped<X, V, F, Rho>::value) detail::RequireViews<X, V, F, Rho> relax(Force&&, const X&, const V&,
                                                                                            const F&, const Rho&,
                                                                                            const RelaxationSettings&,
                                                                                            const E&...);

}  // namespace hmps::inline HMPS_ABI
