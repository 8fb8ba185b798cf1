// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "hmps/analysis/stable_step.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `relax`.
struct Relaxation {
  /// Unbalanced forces divided by the load: the sum of |f| l0^D over the particles that move, divided by
  /// `RelaxationSettings::load`.
  double residual = 0;
  double load = 0;      ///< in N: as given, or the force on the particles that do not move
  int iterations = 0;   ///< number of steps
  int peaks = 0;        ///< number of kinetic energy peaks at which the body was stopped
  double step = 0;      ///< the last step in s
  int evaluations = 0;  ///< number of force evaluations, including those of `stable_step`
};

/// Settings of `relax`.
struct RelaxationSettings {
  double spacing = 0;       ///< particle spacing l0 in m, positive
  double tolerance = 1e-3;  ///< residual at which the search ends; see `Relaxation::residual`
  /// The load in N (in two dimensions N/m) that the unbalanced forces are compared with, such as the weight of the body
  /// or the force that presses it. 0: the force on the particles that do not move; there must be some.
  double load = 0;
  int max_iterations = 100000;  ///< one force evaluation each
  double step = 0;              ///< in s; 0: that of `stable_step`, updated as the body deforms
  /// Whether particle i follows the forces; the others keep their positions. Empty: all particles follow.
  std::function<bool(std::size_t)> moves = {};
  /// Called after each force evaluation with the current result, for progress reports; may throw to stop the search.
  /// Empty: not called.
  std::function<void(const Relaxation&)> progress = {};
};

namespace detail {

inline void validate(const RelaxationSettings& s) {
  require(detail::is_finite(s.spacing) && s.spacing > 0, "hmps: the spacing of relax is ", s.spacing,
          " m; give the particle spacing l0, by which force densities become forces");
  require(detail::is_finite(s.tolerance) && s.tolerance > 0 && s.tolerance < 1, "hmps: the tolerance of relax is ",
          s.tolerance, "; it must lie between 0 and 1, for example 1e-3");
  require(detail::is_finite(s.load) && s.load >= 0, "hmps: the load of relax is ", s.load,
          " N; give the force that acts, or 0 for what the particles carry that do not move");
  require(s.max_iterations > 0, "hmps: relax may make ", s.max_iterations, " iterations; allow at least one");
  require(detail::is_finite(s.step) && s.step >= 0, "hmps: the step of relax is ", s.step,
          " s; it must be positive, or 0 for that of stable_step");
}

/// Sums over all particles at one time.
struct Unbalanced {
  double moving = 0;   ///< sum of |f| over the particles that move
  double held = 0;     ///< of the others
  double power = 0;    ///< of all forces on the velocities
  double gain = 0;     ///< rate at which a kick increases the power
  double fastest = 0;  ///< largest speed

  [[nodiscard]] static Unbalanced join(const Unbalanced& a, const Unbalanced& b) {
    return {a.moving + b.moving, a.held + b.held, a.power + b.power, a.gain + b.gain, std::max(a.fastest, b.fastest)};
  }
};

/// The step of a relaxation: a fraction of the largest stable step. The estimate is refreshed after the particles have
/// travelled a tenth of a spacing, or more if it does not change.
class RelaxationStep {
 public:
  explicit RelaxationStep(const RelaxationSettings& settings)
      : step_(settings.step), fixed_(settings.step > 0), shortest_(0.1 * settings.spacing) {
    search_.spacing = settings.spacing;
    search_.margin = 0.1;
    search_.moves = settings.moves;
  }
  [[nodiscard]] double value() const { return step_; }
  [[nodiscard]] int evaluations() const { return evaluations_; }

  /// Updates the step for particles that move at up to `speed` (m/s).
  template <class Force, class X, class V, int D, class Rho, class E>
  void update(Force& force, const VectorView<X, D>& x, const VectorView<V, D>& v, const Rho& density, double speed,
              const E& execute) {
    left_ -= speed * step_;
    if (fixed_ || left_ > 0) return;
    search_.start = mode_;
    StableStep found = stable_step(force, x, v, density, search_, execute);
    evaluations_ += found.evaluations;
    ++search_.seed;
    require(detail::is_finite(found.step), "hmps: relax finds no stiffness in the force; give it a `step`");
    const bool steady = std::abs(found.step - step_) < 0.02 * step_;
    path_ = steady ? std::min(2 * path_, 10 * shortest_) : shortest_;
    left_ = path_;
    step_ = found.step;
    mode_ = std::move(found.mode);
  }

 private:
  StableStepSettings search_;
  std::vector<double> mode_;
  double step_;
  bool fixed_;
  double shortest_, path_ = 0, left_ = 0;  // m
  int evaluations_ = 0;
};

template <class F, int D>
[[noreturn]] void throw_not_finite(const VectorView<F, D>& f, const std::vector<char>& counts, int iteration) {
  std::size_t i = 0;
  while (i + 1 < f.size() && (!counts[i] || detail::is_finite(f[i].template cast<double>().sum()))) ++i;
  throw StateError(message("hmps: iteration ", iteration, " of relax finds a force on particle ", i,
                           " that is not finite, ", f[i].transpose(),
                           " N/m3; apply the load in parts, each relaxed before the next, or give a smaller step; "
                           "if det F reached zero, take the law as Continued{law}"));
}

[[noreturn]] inline void throw_not_at_rest(const Relaxation& result, const RelaxationSettings& settings) {
  throw StateError(message("hmps: relax made ", result.iterations, " iterations and the unbalanced forces are still ",
                           result.residual, " of the load, ", result.load, " N; allow more max_iterations than ",
                           settings.max_iterations, ", or a larger tolerance than ", settings.tolerance));
}

/// The state that `relax` brings to rest, with the operations on all of its particles.
template <class X, class V, class F, int D, class Rho, class E>
class RelaxingBody {
 public:
  /// Throws `InputError` if no particle moves, or if all move and no load is given.
  RelaxingBody(const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f, const Rho& rho,
               const RelaxationSettings& settings, const E& execute)
      : x_(x), v_(v), f_(f), rho_(rho), execute_(execute), volume_(std::pow(settings.spacing, D)), follows_(x.size()) {
    for (std::size_t i = 0; i < follows_.size(); ++i) follows_[i] = !settings.moves || settings.moves(i);
    const auto count = static_cast<std::size_t>(std::count(follows_.begin(), follows_.end(), char(1)));
    require(count > 0, "hmps: no particle of relax moves; `moves` must hold for some");
    require(settings.load > 0 || count < follows_.size(),
            "hmps: every particle of relax moves and no load is given; give the load in N that unbalanced forces are "
            "compared with");
  }

  /// Volume of a particle in m^D.
  [[nodiscard]] double volume() const { return volume_; }
  /// Whether each particle follows the forces.
  [[nodiscard]] const std::vector<char>& follows() const { return follows_; }

  void clear_forces() const {
    execute_(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) f_(i, c) = F(0);
    });
  }
  /// Sets all velocities to zero.
  void stop() const {
    execute_(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) v_(i, c) = V(0);
    });
  }
  /// Sets the velocities of the particles that do not move to zero.
  void hold() const {
    execute_(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D && !follows_[i]; ++c) v_(i, c) = V(0);
    });
  }
  /// Moves all particles back along their velocities by `time` (s).
  void go_back(double time) const {
    execute_(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) x_(i, c) = static_cast<X>(x_(i, c) - v_(i, c) * time);
    });
  }
  [[nodiscard]] Unbalanced unbalanced() const {
    const auto of = [&](std::size_t i) {
      const Vector<double, D> push = f_[i].template cast<double>();
      const double size = push.norm();
      const Vector<double, D> speed = v_[i].template cast<double>();
      if (!follows_[i]) return Unbalanced{.held = size};
      return Unbalanced{.moving = size,
                        .power = push.dot(speed),
                        .gain = size * size / static_cast<double>(at_particle(rho_, i)),
                        .fastest = speed.norm()};
    };
    return reduce(x_.size(), Unbalanced{}, of, Unbalanced::join, execute_);
  }

 private:
  VectorView<X, D> x_;
  VectorView<V, D> v_;
  VectorView<F, D> f_;
  const Rho& rho_;
  const E& execute_;
  double volume_;
  std::vector<char> follows_;
};

}  // namespace detail

/// Finds the static equilibrium of a body under the composed `force`, by dynamic relaxation with kinetic damping.
///
/// The particles start at rest and follow symplectic Euler (\paper{2, 4}). When their kinetic energy passes a peak,
/// that is when the power of the forces f . v turns negative, the particles return to the peak, found by linear
/// interpolation of the power within the last step, and stop. For a linear body this is the minimum of the potential
/// energy along the step, so that stopping never increases the energy. Without the return, a mode with four steps per
/// period would oscillate forever. The first kick after a stop takes half a step, which centres the velocities between
/// the positions. The search ends when the body is at rest and the unbalanced forces are below `tolerance` times the
/// load.
///
///     const auto found = relax(force, x, v, f, rho, {.spacing = l0, .load = weight, .moves = moves});
///
/// The equilibrium depends on neither time nor mass: `rho` may be the density of the material or any other. A density
/// per particle that is proportional to the local stiffness needs fewer iterations if stiff and soft parts are
/// combined. Leave viscosity out: it slows the search and does not change the result. With friction the result depends
/// on the path. If a load overshoots too far, apply it in increments and call `relax` for each. A start close to the
/// result saves most.
///
/// @param force  `force(x, v, f)` writes force densities (N/m3), as for `stable_step`: the result of
///               `internal_force`, or a lambda that adds several forces and the load
/// @param x      positions in m, changed; those of particles that do not move are kept
/// @param v      velocities in m/s, zero at the end
/// @param f      force densities; at the end those at rest, which are the reactions of particles that do not move
/// @param rho    density in kg/m3, a number or a `ScalarView`
/// The result does not depend on the executor if the force does not. Positions in float may be too coarse for a small
/// tolerance; keep them in double. Throws `InputError` for bad settings, views of different sizes and values that are
/// not finite. Throws `StateError` if a force is not finite and after `max_iterations`; the state is then the last one
/// reached.
template <class Force, class X, class V, class F, int D, PerParticle Rho, Executor E = Serial>
Relaxation relax(Force&& force, const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f,
                 const Rho& rho, const RelaxationSettings& settings, const E& execute = {}) {
  static_assert(!std::is_const_v<X> && !std::is_const_v<V> && !std::is_const_v<F>,
                "hmps: relax changes positions, velocities and forces; give it writable views of them");
  using Read = VectorView<const X, D>;
  static_assert(std::invocable<Force&, const Read&, const VectorView<const V, D>&, const VectorView<F, D>&>,
                "hmps: relax calls force(x, v, f) with read-only views of positions and velocities and a view of the "
                "force densities");
  const std::size_t n = x.size();
  detail::validate(settings);
  detail::require(n > 0, "hmps: relax was given no particle");
  require_size(v, n, "velocities");
  require_size(f, n, "force densities");
  require_apart(x, "positions", v, "velocities");
  require_apart(x, "positions", f, "force densities");
  require_apart(v, "velocities", f, "force densities");
  require_positive(rho, n, "density", "kg/m3");
  detail::require_scene(settings.moves, n, "that move in relax");
  require_finite(x, "the position");
  detail::RelaxingBody body(x, v, f, rho, settings, execute);

  Relaxation result;
  detail::RelaxationStep step(settings);
  body.stop();
  double before = 0;  // power of the forces at the start of the last drift
  for (bool at_rest = true;; ++result.iterations) {
    body.clear_forces();
    force(Read(x), VectorView<const V, D>(v), f);
    ++result.evaluations;
    const detail::Unbalanced sums = body.unbalanced();
    const double carried = settings.load > 0 ? settings.load : sums.held * body.volume();
    if (!detail::is_finite(sums.moving + sums.power + carried))
      detail::throw_not_finite(f, settings.load > 0 ? body.follows() : std::vector<char>(n, 1), result.iterations);
    result.load = carried;
    result.residual = sums.moving > 0 ? sums.moving * body.volume() / carried : 0.0;
    result.step = step.value();
    if (settings.progress) settings.progress(result);

    const bool balanced = result.residual <= settings.tolerance;
    if (balanced && at_rest) break;
    if (balanced || sums.power < 0) {
      // A balance in motion does not count unless it lasts at rest: the force may depend on the velocities.
      if (!balanced) body.go_back(step.value() * sums.power / (sums.power - before));
      body.stop();
      at_rest = true;
      ++result.peaks;
      continue;
    }
    if (result.iterations >= settings.max_iterations) detail::throw_not_at_rest(result, settings);
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

}  // namespace hmps::inline HMPS_ABI
