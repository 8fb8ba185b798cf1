// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
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
#include "hmps/search/nearest_spacing.hpp"

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
  /// The load in N (in two dimensions N/m) with which the unbalanced forces are compared, such as the weight of the
  /// body or the force that presses it. 0: the force on the particles that do not move, of which there must be some.
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
          " m; give the particle spacing l0, with which force densities become forces");
  require(detail::is_finite(s.tolerance) && s.tolerance > 0 && s.tolerance < 1, "hmps: the tolerance of relax is ",
          s.tolerance, "; it must lie between 0 and 1, for example 1e-3");
  require(detail::is_finite(s.load) && s.load >= 0, "hmps: the load of relax is ", s.load,
          " N; give the force that acts, or 0 for the force on the particles that do not move");
  require(s.max_iterations > 0, "hmps: relax may make ", s.max_iterations, " iterations; allow at least one");
  require(detail::is_finite(s.step) && s.step >= 0, "hmps: the step of relax is ", s.step,
          " s; it must be positive, or 0 for that of stable_step");
}

/// Sums over all particles at one time.
struct Unbalanced {
  double moving = 0;   ///< sum of |f| over the particles that move
  double held = 0;     ///< the same over the others
  double power = 0;    ///< of the forces, sum of f . v
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

/// Throws `InputError` if `force` writes nothing to `f` even when all particles are displaced from `x` by about a
/// thousandth of `spacing` (m): then it does not read the positions that it is given.
template <class Force, class X, class V, class F, int D>
void require_response(Force& force, const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f,
                      double spacing) {
  using Place = std::remove_const_t<X>;
  std::vector<Vector<Place, D>> off(x.size());
  for (std::size_t i = 0; i < off.size(); ++i)
    for (int c = 0; c < D; ++c)
      off[i][c] = x(i, c) + static_cast<Place>(1e-3 * spacing * std::sin(1.7 * static_cast<double>(i) + 2.3 * c));
  force(VectorView<const Place, D>(vectors(off)), v, f);
  bool written = false;
  for (std::size_t i = 0; i < f.size(); ++i)
    for (int c = 0; c < D; ++c) written = written || f(i, c) != F(0);
  require(written,
          "hmps: the force of relax writes nothing, not even when all particles are displaced: a lambda must pass on "
          "the views that relax calls it with, not views of its own");
}

/// Throws `InputError` for views of different sizes or of the same memory, and for values that are not finite.
template <class X, class V, class F, int D, class Rho>
void require_relaxable(const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f, const Rho& rho,
                       const RelaxationSettings& settings) {
  const std::size_t n = x.size();
  validate(settings);
  require(n > 0, "hmps: relax was given no particles");
  require_size(v, n, "velocities");
  require_size(f, n, "force densities");
  require_apart(x, "positions", v, "velocities");
  require_apart(x, "positions", f, "force densities");
  require_apart(v, "velocities", f, "force densities");
  require_positive(rho, n, "density", "kg/m3");
  require_scene(settings.moves, n, "that move in relax");
  require_finite(x, "the position");
  require_spacing_of(x, settings.spacing, "relax");
}

template <class F, int D>
[[noreturn]] void throw_not_finite(const VectorView<F, D>& f, const std::vector<char>& counts, int iteration) {
  std::size_t i = 0;
  while (i + 1 < f.size() && (!counts[i] || detail::is_finite(f[i].template cast<double>().sum()))) ++i;
  throw StateError(message("hmps: iteration ", iteration, " of relax finds a force on particle ", i,
                           " that is not finite, ", f[i].transpose(),
                           iteration == 0
                               ? " N/m3; are the positions those of the body, and do they come before the velocities?"
                               : " N/m3; apply the load in parts, each relaxed before the next, or give a smaller "
                                 "step; if det F reached zero, use the law as Continued{law}"));
}

[[noreturn]] inline void throw_flown(const Relaxation& result, double path) {
  throw StateError(message("hmps: after ", result.iterations, " iterations of relax, particles have flown ", path,
                           " m without stopping, ten times the size of the body: nothing holds it; does `moves` "
                           "exclude the particles that are held, and does the load press it against something?"));
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
    require(count > 0, "hmps: no particle of relax moves; `moves` must be true for some");
    require(settings.load > 0 || count < follows_.size(),
            "hmps: every particle of relax moves and no load is given; give the load in N with which unbalanced "
            "forces are compared");
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
  /// The diagonal in m of the box around all particles.
  [[nodiscard]] double extent() const {
    Vector<double, D> low = x_[0].template cast<double>(), high = low;
    for (std::size_t i = 1; i < x_.size(); ++i) {
      low = low.cwiseMin(x_[i].template cast<double>());
      high = high.cwiseMax(x_[i].template cast<double>());
    }
    return (high - low).norm();
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

}  // namespace hmps::inline HMPS_ABI
