// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/analysis/relaxation_settings.hpp"
#include "hmps/analysis/stable_step.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/cell_volume.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Sums over all particles at one time, of each by its share V / l0^D of a volume.
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

/// All forces on a body together, along the axes along which every particle moves, and where the body is.
template <int D>
struct Resultant {
  Vector<double, D> force = Vector<double, D>::Zero();   ///< N
  Axial<D> moment = Axial<D>::Zero();                    ///< N m about the centre
  Vector<double, D> centre = Vector<double, D>::Zero();  ///< m, of the volume
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
  /// Whether velocities have limited the step more than stiffness at any time.
  [[nodiscard]] bool damped() const { return damped_; }

  /// Updates the step for particles that move at up to `speed` (m/s).
  template <class Force, class X, class V, int D, class Rho, class E>
  void update(Force& force, const VectorView<X, D>& x, const VectorView<V, D>& v, const Rho& density, double speed,
              const E& execute) {
    left_ -= speed * step_;
    if (fixed_ || left_ > 0) return;
    search_.start = mode_;
    StableStep found;
    // The answer of friction depends on the trials before, which may lead a search astray. One from noise recovers.
    for (int attempt = 0; attempt < 2 && !(found.step > 0); ++attempt) {
      found = stable_step(force, x, v, density, search_, execute);
      evaluations_ += found.evaluations;
      ++search_.seed;
      if (detail::is_finite(found.step)) break;
      found.step = 0;
      search_.start.clear();
    }
    if (!(found.step > 0)) {
      require(step_ > 0,
              "hmps: relax finds no stiffness in the force: displacements change it too little, or push it on; give "
              "a `step`. With friction in the force, take that of `stable_step` for the force without friction");
      left_ = path_ = shortest_;
      return;
    }
    const bool steady = std::abs(found.step - step_) < 0.02 * step_;
    path_ = steady ? std::min(2 * path_, 10 * shortest_) : shortest_;
    left_ = path_;
    step_ = found.step;
    damped_ = damped_ || found.damping > found.omega;
    mode_ = std::move(found.mode);
  }

 private:
  StableStepSettings search_;
  std::vector<double> mode_;
  double step_;
  bool fixed_;
  double shortest_, path_ = 0, left_ = 0;  // m
  bool damped_ = false;
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
  throw StateError(message(
      "hmps: iteration ", iteration, " of relax finds a force on particle ", i, " that is not finite, ", f[i],
      iteration == 0
          ? " N/m3; do two particles coincide, has det F reached zero (then use the law as Continued{law}), are "
            "the positions those of the body, and do they come before the velocities?"
          : " N/m3; apply the load in parts, each relaxed before the next, or give a smaller "
            "step; if det F reached zero, use the law as Continued{law}"));
}

/// The state that `relax` brings to rest, with the operations on all of its particles.
template <class X, class V, class F, int D, class Rho, class E>
class RelaxingBody {
 public:
  static constexpr int dimension = D;
  /// Throws `InputError` if no particle moves, or if all move and no load is given.
  RelaxingBody(const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f, const Rho& rho,
               const RelaxationSettings& settings, const E& execute)
      : x_(x), v_(v), f_(f), rho_(rho), execute_(execute), volume_(std::pow(settings.spacing, D)), follows_(x.size()) {
    free_.fill(true);
    std::size_t count = 0;  // of components that move
    for (std::size_t i = 0; i < follows_.size(); ++i)
      for (int c = 0; c < D; ++c) {
        const bool moves =
            (!settings.moves || settings.moves(i)) && (!settings.moves_along || settings.moves_along(i, c));
        follows_[i] = static_cast<char>(follows_[i] | int(moves) << c);
        free_[static_cast<std::size_t>(c)] &= moves;
        count += moves;
      }
    if (settings.volume) take_volumes(settings);
    require(count > 0, "hmps: no particle of relax moves; `moves` and `moves_along` must be true for some");
    require(
        settings.load > 0 || count < D * follows_.size(),
        "hmps: every particle moves and `load` is not set; give relax the load in N with which unbalanced forces are "
        "compared");
  }

  /// l0^D in m^D.
  [[nodiscard]] double volume() const { return volume_; }
  /// Whether each particle follows the forces: bit c along axis c.
  [[nodiscard]] const std::vector<char>& follows() const { return follows_; }

  void clear_forces() const {
    guarded(execute_)(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) f_(i, c) = F(0);
    });
  }
  /// Sets all velocities to zero.
  void stop() const {
    guarded(execute_)(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) v_(i, c) = V(0);
    });
  }
  /// Sets the velocities of the particles that do not move, and along the axes on which they do not, to zero.
  void hold() const {
    guarded(execute_)(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c)
        if (!moves(i, c)) v_(i, c) = V(0);
    });
  }
  /// Moves all particles back along their velocities by `time` (s).
  void go_back(double time) const {
    guarded(execute_)(x_.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) x_(i, c) = static_cast<X>(x_(i, c) - v_(i, c) * time);
    });
  }
  /// Whether every particle moves along the axis `c`.
  [[nodiscard]] bool free(int c) const { return free_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] std::size_t size() const { return x_.size(); }
  /// The position of particle `i` in m.
  [[nodiscard]] Vector<double, D> place(std::size_t i) const { return x_[i].template cast<double>(); }
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
      const Vector<double, D> speed = v_[i].template cast<double>();
      Vector<double, D> push = f_[i].template cast<double>(), held = Vector<double, D>::Zero();
      for (int c = 0; c < D; ++c)
        if (!moves(i, c)) std::swap(push[c], held[c]);
      const double size = push.norm(), part = share(i);
      return Unbalanced{.moving = part * size,
                        .held = part * held.norm(),
                        .power = part * push.dot(speed),
                        .gain = part * size * size / static_cast<double>(at_particle(rho_, i)),
                        .fastest = speed.norm()};
    };
    return reduce(x_.size(), Unbalanced{}, of, Unbalanced::join, execute_);
  }
  /// What the forces exert on the body as a whole; zero along the axes, and about those, on which a particle is held.
  [[nodiscard]] Resultant<D> resultant() const {
    Resultant<D> sum;
    double whole = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      sum.centre += share(i) * place(i);
      whole += share(i);
    }
    sum.centre /= whole;
    for (std::size_t i = 0; i < size(); ++i) {
      const Vector<double, D> own = share(i) * volume_ * f_[i].template cast<double>();
      sum.force += own;
      sum.moment += cross<D>(Vector<double, D>(place(i) - sum.centre), own);
    }
    for (int c = 0; c < D; ++c)
      if (!free(c)) {
        sum.force[c] = 0;
        for (int a = 0; a < sum.moment.size(); ++a)
          if (D == 2 || a != c) sum.moment[a] = 0;
      }
    return sum;
  }

 private:
  [[nodiscard]] double share(std::size_t i) const { return shares_.empty() ? 1.0 : shares_[i]; }
  [[nodiscard]] bool moves(std::size_t i, int c) const { return (follows_[i] >> c & 1) != 0; }
  /// Throws `InputError` for volumes that are not positive or do not fit the spacing.
  void take_volumes(const RelaxationSettings& settings) {
    double mean = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double own = settings.volume(i);
      require(is_finite(own) && own > 0, "hmps: the volume of particle ", i, " in relax is ", own,
              "; it must be positive");
      shares_.push_back(own / volume_);
      mean += own / static_cast<double>(x_.size());
    }
    require_cell_volume<D>(mean, settings.spacing, volume_factor_of_spacing, "the mean volume of the particles",
                           "the spacing");
  }

  VectorView<X, D> x_;
  VectorView<V, D> v_;
  VectorView<F, D> f_;
  const Rho& rho_;
  const E& execute_;
  double volume_;
  std::vector<char> follows_;
  std::array<bool, std::size_t{D}> free_;
  std::vector<double> shares_;  // V / l0^D; empty if that is 1
};

}  // namespace hmps::inline HMPS_ABI::detail
