// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/step.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/motion/rigid_motion.hpp"

namespace hmps::inline HMPS_ABI {

/// A control region (section 3.1 of the paper): particles with forced displacement. Their velocity is prescribed so
/// that the following drift, \paper{4}, ends on the motion, whatever forces they received before. Bonds transmit their
/// motion to elastic neighbours; contact treats them like any other particle.
///
/// `reference` is a view of the reference positions of all particles; it must outlive the region. `M` is a `Motion`.
/// The default holds any motion that returns a `Pose`, so that regions with different motions fit into one vector.
template <class S, int D, class M = std::function<Pose<double, D>(double)>>
requires Motion<M, D>
class ControlRegion {
 public:
  /// The particles are a list of indices in any order, or a `ParticleSet`. Throws `InputError` if the region has no
  /// particle or an empty function as motion, and for an index out of range, a repeated index, a reference position
  /// that is not finite, or a set made for another number of particles.
  ControlRegion(std::vector<Index> particles, const VectorView<const S, D>& reference, M motion)
      : particles_(std::move(particles)), reference_(reference), motion_(std::move(motion)) {
    detail::require(!particles_.empty(), "hmps: a control region has no particles; give it some, or leave it out");
    require_view(reference, "reference positions");
    if constexpr (std::is_same_v<M, std::function<Pose<double, D>(double)>>)
      detail::require(static_cast<bool>(motion_),
                      "hmps: the motion of a control region is an empty function; give it a motion");
    std::vector<Index> sorted = particles_;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      detail::require(sorted[k] < reference.size(), "hmps: a control region names particle ", sorted[k],
                      " but there are only ", reference.size(), "; give indices into the view of reference positions");
      detail::require(k == 0 || sorted[k - 1] != sorted[k], "hmps: a control region names particle ", sorted[k],
                      " twice; name each once");
      detail::require(detail::all_finite(reference[sorted[k]]), "hmps: the reference position of particle ", sorted[k],
                      " is (", reference[sorted[k]], "); coordinates must be finite");
    }
  }

  ControlRegion(const ParticleSet& particles, const VectorView<const S, D>& reference, M motion)
      : ControlRegion(particles.indices(), reference, std::move(motion)) {
    detail::require_scene(particles, reference.size(), "of a control region");
  }

  [[nodiscard]] const std::vector<Index>& particles() const { return particles_; }
  [[nodiscard]] const M& motion() const { return motion_; }

  /// The prescribed position of the `k`-th particle of the region at time `t` (s). Throws `InputError` if `k` is out of
  /// range.
  [[nodiscard]] Vector<double, D> position(std::size_t k, double t) const {
    detail::require_index(k, particles_.size(), "particle", "the control region has");
    return motion_(t)(reference_[particles_[k]].template cast<double>());
  }

  /// Sets the velocities `v` (m/s) of the region's particles so that x + v `dt` is their prescribed position at `t`
  /// (s), the time at the end of the step. Call it after the last kick and before the drift; in a scene with contact,
  /// also before the contact. Internal forces kick a prescribed particle like any other, and a wall with the resulting
  /// velocity would cause friction although it does not move. Rounding errors in `x` do not accumulate over steps.
  ///
  /// Throws `InputError` for a `Pose` whose matrix is not a rotation, and `StateError`, with particle and speed, if the
  /// motion is not finite or exceeds `speed_limit` (m/s), as it may when a run starts in the middle of a motion without
  /// `place`.
  template <class X, class V, Executor E = Serial>
  void prescribe(const VectorView<X, D>& x, const VectorView<V, D>& v, double t, double dt, double speed_limit,
                 const E& execute = {}) const {
    detail::require_step(dt);
    detail::require(detail::is_finite(t), "hmps: a control region is moved to the time ", t, " s; give finite seconds");
    detail::require(!detail::is_nan(speed_limit) && speed_limit >= 0, "hmps: the speed limit of a control region is ",
                    speed_limit, " m/s; give a positive number, or leave it out");
    require_size(x, reference_.size(), "positions");
    require_size(v, reference_.size(), "velocities");
    require_apart(x, "positions", reference_, "reference positions of a control region");
    const auto pose = motion_(t);
    detail::require_rigid(pose, t);
    const double per_step = 1 / dt, largest = std::min(speed_limit * speed_limit, std::numeric_limits<double>::max());
    detail::guarded(execute)(particles_.size(), [&](std::size_t k) {
      const std::size_t i = particles_[k];
      const Vector<double, D> target = pose(Vector<double, D>(reference_[i].template cast<double>()));
      const Vector<double, D> rate = (target - x[i].template cast<double>()) * per_step;
      const double squared = rate.squaredNorm();
      if (!detail::is_finite(squared) || squared > largest)
        throw StateError(detail::message("hmps: a control region requires particle ", i, " to move at ", rate.norm(),
                                         " m/s to reach (", target, ") at ", t,
                                         " s; check its keyframes, or place the region where the run starts"));
      v.set(i, rate);
    });
  }

  /// The same without a speed limit.
  template <class X, class V, Executor E = Serial>
  void prescribe(const VectorView<X, D>& x, const VectorView<V, D>& v, double t, double dt,
                 const E& execute = {}) const {
    prescribe(x, v, t, dt, std::numeric_limits<double>::max(), execute);
  }

  /// Sets the force densities `f` of the region's particles to zero, so that a kick does not change the velocities that
  /// `prescribe` has set.
  template <class F>
  void unload(const VectorView<F, D>& f) const {
    require_size(f, reference_.size(), "force densities");
    for (const Index i : particles_) f.set(i, Vector<double, D>(Vector<double, D>::Zero()));
  }

  /// Moves the region's particles to their prescribed positions at time `t` (s), with the velocity of the motion: that
  /// of its `rate(t)`, or, for a motion without a rate, such as a `std::function`, the central difference over 2
  /// microseconds. Use it to start a run in the middle of a motion. Throws `InputError` for views of the wrong size and
  /// a time that is not finite, and `StateError` for a motion that is not finite at `t`.
  template <class X, class V>
  void place(const VectorView<X, D>& x, const VectorView<V, D>& v, double t) const {
    require_size(x, reference_.size(), "positions");
    require_size(v, reference_.size(), "velocities");
    require_apart(x, "positions", reference_, "reference positions of a control region");
    detail::require(detail::is_finite(t), "hmps: a control region is placed at the time ", t,
                    " s; give finite seconds");
    const auto now = motion_(t);
    detail::require_rigid(now, t);
    const auto velocity_of = velocities(now, t);
    for (const Index i : particles_) {
      const Vector<double, D> reference = reference_[i].template cast<double>();
      const Vector<double, D> place = now(reference);
      const Vector<double, D> rate = velocity_of(reference);
      if (!detail::all_finite(place) || !detail::all_finite(rate))
        throw StateError(detail::message("hmps: a control region puts particle ", i, " at (", place,
                                         ") with the velocity (", rate, ") m/s at ", t, " s; check its motion"));
      x.set(i, place);
      v.set(i, rate);
    }
  }

 private:
  /// The velocity in m/s of the motion at `t`, where it is `now`, as a function of the reference position.
  template <class Map>
  [[nodiscard]] auto velocities([[maybe_unused]] const Map& now, double t) const {
    if constexpr (detail::RatedMotion<M, D>) {
      return [now, rate = motion_.rate(t)](const Vector<double, D>& reference) {
        return Vector<double, D>(velocity(now, rate, reference));
      };
    } else {
      constexpr double h = 1e-6;
      return [before = motion_(t - h), after = motion_(t + h)](const Vector<double, D>& reference) {
        return Vector<double, D>((Vector<double, D>(after(reference)) - Vector<double, D>(before(reference))) /
                                 (2 * h));
      };
    }
  }

  std::vector<Index> particles_;
  VectorView<const S, D> reference_;
  M motion_;
};

template <class T, int D, class M>
ControlRegion(std::vector<Index>, const VectorView<T, D>&, M) -> ControlRegion<std::remove_const_t<T>, D, M>;
template <class T, int D, class M>
ControlRegion(const ParticleSet&, const VectorView<T, D>&, M) -> ControlRegion<std::remove_const_t<T>, D, M>;

}  // namespace hmps::inline HMPS_ABI
