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
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace hmps::inline HMPS_ABI {

/// How `relax` came to rest.
struct Relaxation {
  /// The unbalanced forces over the load: the sum of |f| l0^D over the particles that move, over
  /// `RelaxationSettings::load`.
  double residual = 0;
  double load = 0;      ///< in N, as given or as carried by the particles that do not move
  int iterations = 0;   ///< steps made
  int peaks = 0;        ///< how often the body was stopped at a peak of its kinetic energy
  double step = 0;      ///< the last step in s
  int evaluations = 0;  ///< of the force, with those of `stable_step`
};

/// How `relax` looks for the state of rest.
struct RelaxationSettings {
  double spacing = 0;       ///< particle spacing l0 in m, positive
  double tolerance = 1e-3;  ///< the residual at which the search ends; see `Relaxation::residual`
  /// What the unbalanced forces are compared with in N (in two dimensions N/m): the weight of the body, the force that
  /// presses it. 0: what the particles carry that do not move, of which there must be some then.
  double load = 0;
  int max_iterations = 100000;  ///< of one evaluation of the force each
  double step = 0;              ///< in s; 0: that of `stable_step`, kept up to date on the way
  /// Whether particle i follows the forces. The others stay where they are. Empty: all follow.
  std::function<bool(std::size_t)> moves = {};
  /// Called after each evaluation of the force with what is known by then, to show that something happens, or to throw
  /// where it takes too long. Empty: nothing is called.
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

/// Forces and motion of all particles at one moment.
struct Unbalanced {
  double moving = 0;   ///< sum of force densities of the particles that move
  double held = 0;     ///< of the others
  double power = 0;    ///< of all forces on the velocities
  double gain = 0;     ///< what a kick adds to it per second
  double fastest = 0;  ///< largest speed

  [[nodiscard]] static Unbalanced join(const Unbalanced& a, const Unbalanced& b) {
    return {a.moving + b.moving, a.held + b.held, a.power + b.power, a.gain + b.gain, std::max(a.fastest, b.fastest)};
  }
};

/// The step of a relaxation: a share of the largest stable one, estimated anew after a path of a tenth of a spacing, or
/// of more if it does not change.
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

  /// Brings it up to date for particles that move at up to `speed` (m/s).
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

/// The state that `relax` brings to rest, and what it does to all of its particles.
template <class X, class V, class F, int D, class Rho, class E>
class RelaxingBody {
 public:
  /// Throws `InputError` where no particle moves, or all do and no load is given.
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

  /// Of a particle, in m^D.
  [[nodiscard]] double volume() const { return volume_; }
  /// For each particle whether it follows the forces.
  [[nodiscard]] const std::vector<char>& follows() const { return follows_; }

  void clear_forces() const {
    execute_(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) f_(i, c) = F(0);
    });
  }
  /// Takes all velocities.
  void stop() const {
    execute_(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) v_(i, c) = V(0);
    });
  }
  /// Takes the velocities of the particles that do not move.
  void hold() const {
    execute_(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D && !follows_[i]; ++c) v_(i, c) = V(0);
    });
  }
  /// Moves all particles back by what they travel in `time` (s).
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

/// Brings a body to rest under the composed `force`, by dynamic relaxation with kinetic damping: the static answer.
///
/// The particles start at rest and follow symplectic Euler (\paper{2, 4}). Whenever their kinetic energy has passed a
/// peak, that is when the forces begin to take power, f . v < 0, they go back to where in the last step it was, by
/// linear interpolation of the power, and stop. For a linear body that is the least potential energy along the step, so
/// that no stop lets it grow; without going back a mode of four steps per period would swing for ever. The first kick
/// after a stop is of half a step, so that the velocities are those of the middle of the steps. It ends when the
/// unbalanced forces are `tolerance` times the load, at rest.
///
///     const auto found = relax(force, x, v, f, rho, {.spacing = l0, .load = weight, .moves = moves});
///
/// What is found rests on no time and no mass: `rho` may be the material's or any other density. One that differs from
/// particle to particle as the stiffness does needs fewer iterations where a body is stiff here and soft there. Leave
/// viscosity out: it slows the way and does not change the end. With friction the end depends on the way. Where a load
/// would overshoot too far, apply it in parts and call `relax` for each; a start near the answer is what saves most.
///
/// @param force  `force(x, v, f)` writes or adds force densities (N/m3), as for `stable_step`: what `internal_force`
///               returns, or a lambda that adds several forces and the load
/// @param x      positions in m, changed; those of particles that do not move are kept
/// @param v      velocities in m/s, zero at the end
/// @param f      force densities, at the end those at rest: on particles that do not move the reactions
/// @param rho    density in kg/m3, a number or a `ScalarView`
/// The result does not depend on the executor if the force does not. Positions in float may be too coarse for a small
/// tolerance: keep them in double.
/// Throws `InputError` for bad settings, views of different sizes or values that are not finite. Throws `StateError`
/// where a force is not finite, and after `max_iterations`; the state then is as it was at that moment.
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
  require(n > 0, "hmps: relax was given no particle");
  require_size(v, n, "velocities");
  require_size(f, n, "force densities");
  require_apart(x, "positions", v, "velocities");
  require_apart(x, "positions", f, "force densities");
  require_apart(v, "velocities", f, "force densities");
  require_positive(rho, n, "density", "kg/m3");
  require_finite(x, "the position");
  detail::RelaxingBody body(x, v, f, rho, settings, execute);

  Relaxation result;
  detail::RelaxationStep step(settings);
  body.stop();
  double before = 0;  // the power of the forces at the start of the last drift
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
      // Balanced in motion counts only if it lasts at rest: the force may depend on the velocities.
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
