// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "hmps/contact/detail/check_schedule.hpp"
#include "hmps/contact/detail/gradients.hpp"
#include "hmps/contact/detail/organ_pairs.hpp"
#include "hmps/contact/detail/state_checks.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/lane_math.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The particles of all organs as the latest check measured them, and bounds on their motion and strain until the next.
///
/// A particle is expected to drift on as it moved between the two latest checks. The bounds say how far it may deviate
/// from this drift and how much it may deform. They are a multiple of its deviation and deformation since the previous
/// check, because motion seldom changes faster, but never less than a minimum. Code that relies on the bounds must
/// check them: `deviation_squared` tells how far a particle has deviated by now, and `measure` whether one has deformed
/// further.
template <class S, int D>
class ParticleBounds {
 public:
  using Point = Vector<S, D>;
  /// Motion in spacings; strain as a relative change of lengths measured by A.
  static constexpr S least_motion = S(0.01), least_strain = S(0.01), first_strain = S(0.05);

  /// The spacing and the `radius` r_e of a metaball in m.
  ParticleBounds(S spacing, S radius) : spacing_(spacing), radius_(radius) {}

  /// Starts anew with `count` numbered particles.
  void resize(std::size_t count);

  /// Measures the particles; `particle` holds their indices in `x` and `F`. `interval` holds the calls since the
  /// previous measurement and until the next. If `is_first`, earlier measurements are ignored. Returns whether a
  /// particle i with `is_listed(i)` has deformed by more than was allowed for. Throws as `require_gradient` does.
  template <class X, class Gradients, class Listed, class E>
  [[nodiscard]] bool measure(const X& x, const Gradients& F, const std::vector<Index>& particle, bool is_first,
                             const CheckInterval& interval, const Listed& is_listed, const E& execute);
  /// Moves the origin to the centre of the particles if they are so far from it that `S` resolves their distances only
  /// to 1e-4 spacings or worse, which for float is beyond about a thousand spacings; never if `S` is as wide as the
  /// scalar type of `x`. Call it only before lists are built, because all places change.
  template <class X>
  void centre_origin(const X& x, const std::vector<Index>& particle);
  [[nodiscard]] const Vector<double, D>& origin() const { return origin_; }
  void restore_origin(const Vector<double, D>& origin) { origin_ = origin; }
  /// Limits the travel of each particle within `calls` calls to `most` (m): its drift to half of that, and its
  /// deviation to what the drift leaves.
  void limit_travel(S most, std::size_t calls);

  /// The position of particle `i` of the view `x`, in m from the origin of the lists. If `S` is narrower than the
  /// scalar type of `x`, it is rounded after the subtraction, so that the precision does not depend on the distance
  /// from zero.
  template <class X>
  [[nodiscard]] HMPS_INLINE Point place_of(const X& x, std::size_t i) const {
    using Wide = typename X::Scalar;
    if constexpr (sizeof(Wide) > sizeof(S))
      return (x[i] - origin_.template cast<Wide>()).template cast<S>();
    else
      return x[i].template cast<S>();
  }
  /// The square (m2) of how far the particle with number `i` has deviated within `calls` calls; in the view `x` it is
  /// particle `index`.
  template <class X>
  [[nodiscard]] HMPS_INLINE S deviation_squared(const X& x, Index index, std::size_t i, S calls) const {
    return (place_of(x, index) - expected(i, calls)).squaredNorm();
  }
  /// The largest drift in m per call.
  [[nodiscard]] S fastest() const {
    S fastest = 0;
    for (const Point& drift : drift_) fastest = std::max(fastest, drift.norm());
    return fastest;
  }

  /// r_e of a metaball in m.
  [[nodiscard]] S radius() const { return radius_; }
  // Of each numbered particle, at the latest measurement:
  /// Its place in m from the origin of the lists.
  [[nodiscard]] const std::vector<Point>& place() const { return place_; }
  /// A = F^-T F^-1.
  [[nodiscard]] const std::vector<Matrix<S, D>>& metric() const { return metric_; }
  /// Its reach in m: r_e times a bound of the largest stretch.
  [[nodiscard]] const std::vector<S>& reach() const { return reach_; }
  /// A bound of |F^-1|; negative if the particle is flattened and forms no wall.
  [[nodiscard]] const std::vector<S>& compression() const { return compression_; }
  // And until the next measurement:
  /// The expected motion, in m per call.
  [[nodiscard]] const std::vector<Point>& drift() const { return drift_; }
  /// The largest deviation from it in m.
  [[nodiscard]] const std::vector<S>& deviation() const { return deviation_; }
  /// Drift and deviation together, in m.
  [[nodiscard]] const std::vector<S>& travel() const { return travel_; }
  /// The largest strain.
  [[nodiscard]] const std::vector<S>& strain() const { return strain_; }

 private:
  static constexpr std::size_t chunk = 512;
  struct Chunk {  // of particles
    bool is_late;
    Index flat;  // the first particle without an inverse of F
  };
  template <class T>
  HMPS_COLD static void fill(std::vector<T>& numbers, std::size_t count, const T& number) {
    numbers.assign(count, number);
  }
  [[nodiscard]] HMPS_INLINE Point expected(std::size_t i, S calls) const { return place_[i] + calls * drift_[i]; }
  void move_to(std::size_t i, const Point& place, bool is_first, const CheckInterval& interval);
  [[nodiscard]] S update_metric(std::size_t i, const Matrix<Lanes<S>, D>& A, std::size_t lane);
  void require_resolved_extent(const Vector<double, D>& middle, const std::vector<Index>& particle) const;
  template <class Gradients>
  void check_flat(const Gradients& F, const std::vector<Index>& particle) const;

  S spacing_, radius_;
  Vector<double, D> origin_ = Vector<double, D>::Zero();  // in m: from where places are measured
  std::vector<Point> place_, drift_;
  std::vector<Matrix<S, D>> metric_;
  std::vector<S> reach_, compression_, deviation_, travel_, strain_;
  std::vector<Chunk> chunks_;
};

template <class S, int D>
void ParticleBounds<S, D>::resize(std::size_t count) {
  fill<Point>(place_, count, Point::Zero());
  fill<Point>(drift_, count, Point::Zero());
  fill<Matrix<S, D>>(metric_, count, Matrix<S, D>::Identity());
  fill(reach_, count, S(0));
  fill(compression_, count, S(-1));
  fill(deviation_, count, S(0));
  fill(travel_, count, S(0));
  fill(strain_, count, S(0));
  chunks_.resize((count + chunk - 1) / chunk);
}

/// Takes the new place, and derives drift and deviation from the previous one.
template <class S, int D>
HMPS_INLINE void ParticleBounds<S, D>::move_to(std::size_t i, const Point& place, bool is_first,
                                               const CheckInterval& interval) {
  if (is_first) {
    deviation_[i] = std::numeric_limits<S>::max();
    drift_[i].setZero();
  } else {
    deviation_[i] = least_motion * spacing_ +
                    S(2) * interval.template ratio<S>() * (place - expected(i, static_cast<S>(interval.since))).norm();
    drift_[i] = (place - place_[i]) / static_cast<S>(std::max<std::size_t>(interval.since, 1));
  }
  place_[i] = place;
}

/// Takes the new A, and returns the norm of its change.
template <class S, int D>
HMPS_INLINE S ParticleBounds<S, D>::update_metric(std::size_t i, const Matrix<Lanes<S>, D>& A, std::size_t lane) {
  S change = 0;
  for (int c = 0; c < D * D; ++c) {
    S& old = metric_[i](c % D, c / D);
    const S now = A(c % D, c / D).lane[lane];
    change += (now - old) * (now - old);
    old = now;
  }
  return std::sqrt(change);
}

template <class S, int D>
template <class X, class Gradients, class Listed, class E>
bool ParticleBounds<S, D>::measure(const X& x, const Gradients& F, const std::vector<Index>& particle, bool is_first,
                                   const CheckInterval& interval, const Listed& is_listed, const E& execute) {
  constexpr std::size_t width = static_cast<std::size_t>(Lanes<S>::width);
  static_assert(chunk % width == 0);
  guarded(execute)(chunks_.size(), [&](std::size_t q) {
    Chunk found{false, no_index};
    const std::size_t end = std::min(particle.size(), (q + 1) * chunk);
    for (std::size_t begin = q * chunk; begin < end; begin += width) {
      const auto deformation =
          gather_gradients<S, D>(F, [&](std::size_t l) { return particle[std::min(begin + l, end - 1)]; });
      const auto B = inverse<Lanes<S>, D>(deformation);
      const auto A = right_cauchy_green<Lanes<S>, D>(B);
      const Lanes<S> stretch = stretch_bound<Lanes<S>, D>(deformation), compression = stretch_bound<Lanes<S>, D>(B);
      for (std::size_t l = 0; l < width && begin + l < end; ++l) {
        const std::size_t i = begin + l;
        move_to(i, place_of(x, particle[i]), is_first, interval);
        // The relative change of |B r| = sqrt(r . A r) is at most half of |dA| over the smallest eigenvalue of A.
        const S change = S(0.5) * update_metric(i, A, l) * stretch.lane[l] * stretch.lane[l];
        found.is_late = found.is_late || (!is_first && is_listed(i) && change > strain_[i]);
        strain_[i] = is_first
                         ? first_strain
                         : std::max({least_strain, S(4) * interval.template ratio<S>() * change, S(0.5) * strain_[i]});
        const S reach = radius_ * stretch.lane[l];
        reach_[i] = reach;
        // A flattened master forms no wall.
        const bool is_wall = is_finite(compression.lane[l]) && is_finite(reach);
        if (!is_wall) found.flat = std::min(found.flat, static_cast<Index>(i));
        compression_[i] = is_wall ? compression.lane[l] : S(-1);
      }
    }
    chunks_[q] = found;
  });
  check_flat(F, particle);
  return std::any_of(chunks_.begin(), chunks_.end(), [](const Chunk& part) { return part.is_late; });
}

/// Throws if F has no inverse although its particle is not flattened: a `StateError` or, if nothing has written F, an
/// `InputError`.
template <class S, int D>
template <class Gradients>
void ParticleBounds<S, D>::check_flat(const Gradients& F, const std::vector<Index>& particle) const {
  for (std::size_t q = 0; q < chunks_.size(); ++q) {
    if (chunks_[q].flat == no_index) continue;
    for (std::size_t i = chunks_[q].flat; i < std::min(particle.size(), (q + 1) * chunk); ++i)
      require_gradient<D>(F[particle[i]].template cast<double>(), particle[i]);
  }
}

/// Throws `InputError` if a particle is so far from the `middle` of all (m from the origin) that `S` does not resolve a
/// hundredth of the spacing there.
template <class S, int D>
HMPS_COLD void ParticleBounds<S, D>::require_resolved_extent(const Vector<double, D>& middle,
                                                             const std::vector<Index>& particle) const {
  const double furthest = 0.01 * static_cast<double>(spacing_) / static_cast<double>(std::numeric_limits<S>::epsilon());
  for (std::size_t i = 0; i < place_.size(); ++i) {
    const double apart = (place_[i].template cast<double>() - middle).cwiseAbs().maxCoeff();
    require(
        apart <= furthest, "hmps: particle ", particle[i], " of contact is ", apart,
        " m from the middle of all organs, where the scalar type of contact does not resolve 0.01 of the spacing of ",
        spacing_, " m; use MetaballContact<double, ", D, ">, or a contact of its own for distant organs");
  }
}

template <class S, int D>
template <class X>
void ParticleBounds<S, D>::centre_origin(const X& x, const std::vector<Index>& particle) {
  if constexpr (sizeof(typename X::Scalar) > sizeof(S)) {
    const double range =
        static_cast<double>(spacing_) * 1.25e-4 / static_cast<double>(std::numeric_limits<S>::epsilon());
    Point low = Point::Constant(std::numeric_limits<S>::max()), high = -low;
    for (const Point& place : place_) {
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
    const Vector<double, D> middle = 0.5 * (low.template cast<double>() + high.template cast<double>());
    require_resolved_extent(middle, particle);
    if (place_.empty() || middle.cwiseAbs().maxCoeff() <= range) return;
    origin_ += middle;
    for (std::size_t i = 0; i < place_.size(); ++i) place_[i] = place_of(x, particle[i]);
  }
}

template <class S, int D>
void ParticleBounds<S, D>::limit_travel(S most, std::size_t calls) {
  const S most_drift = S(0.5) * most;
  for (std::size_t i = 0; i < place_.size(); ++i) {
    const S drift = static_cast<S>(calls) * drift_[i].norm();
    if (drift > most_drift) drift_[i] *= most_drift / drift;
    deviation_[i] = std::min(deviation_[i], most - std::min(drift, most_drift));
    travel_[i] = deviation_[i] + std::min(drift, most_drift);
  }
}

}  // namespace hmps::inline HMPS_ABI::detail
