// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hmps/contact/lists/active_rows.hpp"
#include "hmps/contact/lists/broad_phase.hpp"
#include "hmps/contact/lists/organ_pairs.hpp"
#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/contact/organ.hpp"
#include "hmps/contact/state_checks.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/lane_math.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Deformation gradients of undeformed or rigid particles.
template <class S, int D>
struct Undeformed {
  [[nodiscard]] Matrix<S, D> operator[](std::size_t) const { return Matrix<S, D>::Identity(); }
};

/// The deformation gradients of the particles `particle(l)`, one in each lane.
template <class S, int D, class Gradients, class Particle>
[[nodiscard]] HMPS_INLINE Matrix<Lanes<S>, D> gather_gradients(const Gradients& F, Particle&& particle) {
  Matrix<Lanes<S>, D> lanes;
  for (int l = 0; l < Lanes<S>::width; ++l) {
    const Matrix<S, D> own = F[particle(static_cast<std::size_t>(l))].template cast<S>();
    for (int c = 0; c < D * D; ++c) lanes(c % D, c / D).lane[l] = own(c % D, c / D);
  }
  return lanes;
}

/// An upper bound of the largest singular value of F, exact in 2D and for equal stretches: mean plus
/// sqrt(D - 1) standard deviations of the eigenvalues of F^T F (Wolkowicz and Styan 1980).
template <class T, int D>
[[nodiscard]] HMPS_INLINE T stretch_bound(const Matrix<T, D>& F) {
  using std::sqrt;
  Matrix<T, D> C = right_cauchy_green<T, D>(F);
  const T mean = trace<T, D>(C) * T(1. / D);
  for (int c = 0; c < D; ++c) C(c, c) = C(c, c) - mean;
  return sqrt(mean + sqrt(contract<T, D>(C, C) * T((D - 1.) / D)));
}

/// The lists of slaves and masters that may touch. The broad-phase list holds the pairs within reach plus `margin`, in
/// rows of one slave each. A grid search builds it whenever organs have moved, or a reach has grown, by that much. Most
/// of its rows sleep: a check extrapolates the motion of the particles and bounds how far those of a row may deviate
/// from it before the slave could touch. Every later call measures the deviation of each particle and wakes the rows
/// for which it is too large; the active rows make up the Verlet list that is evaluated. The next check is due when the
/// rows woken since the last one have cost as much as a check, and after `longest_interval` calls (fewer if much is
/// active or moves fast), because deformation gradients change too.
///
/// All orders follow the particles' indices, so sums over contacts do not depend on when lists were built.
///
/// The particles of all organs are numbered once each, in the order of their indices; a member is such a particle in
/// one organ. A row is a slave of one side (an ordered pair of organs).
template <class S, int D, Metaball Kernel>
class Candidates {
 public:
  using Point = Vector<S, D>;
  static constexpr Index none = no_particle;

  /// `spacing` and `margin` in m.
  Candidates(S spacing, S margin)
      : normal_density_(spacing), radius_(static_cast<S>(Kernel::radius) * spacing), margin_(margin) {}

  std::size_t add_organ(const Organ& organ) {
    const std::size_t added = organs_.add_organ(organ, static_cast<double>(normal_density_.spacing()));
    parts_.clear();
    built_ = false;
    return added;
  }
  std::size_t add_pair(std::size_t a, std::size_t b, const PairSettings& settings) {
    const std::size_t added = organs_.add_pair(a, b, settings);
    built_ = false;
    return added;
  }
  [[nodiscard]] const OrganPairs& organs() const { return organs_; }
  /// The Verlet list to evaluate: the active rows.
  [[nodiscard]] const ActiveRows<S>& active() const { return active_; }
  [[nodiscard]] const NormalDensity<S, D, Kernel>& normal_density() const { return normal_density_; }
  /// Counters: grid searches, checks, and checks that found a change larger than was allowed for.
  [[nodiscard]] std::size_t rebuilds() const { return rebuilds_; }
  [[nodiscard]] std::size_t checks() const { return checks_; }
  [[nodiscard]] std::size_t late() const { return late_; }
  void refresh() { built_ = false; }

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

  /// Updates the lists for this call. Returns whether the active rows have changed.
  template <class X, class Gradients, class E>
  bool update(const X& x, const Gradients& F, const E& execute);

  /// Checks all organs, rebuilds the broad-phase list if needed, and puts rows to sleep.
  template <class X, class Gradients, class E>
  void check(const X& x, const Gradients& F, const E& execute);

 private:
  static constexpr std::size_t chunk = 512, shortest_interval = 8, longest_interval = 64;
  // What a particle may do until the next check besides its extrapolated motion: a multiple of what it did since the
  // last check, but at least this (motion in spacings; strain as a relative change of lengths measured by A; rotation
  // of a normal in rad).
  static constexpr S least_motion = S(0.01), least_strain = S(0.01), first_strain = S(0.05), least_turn = S(0.03),
                     first_turn = S(0.2);
  struct OrganMotion {  // since the broad-phase list was built
    Point moved;        // mean displacement
    S motion, growth;   // largest displacement beyond it, largest growth of a reach
  };
  struct Part {  // of an organ's members
    std::size_t organ, begin, end;
    S motion, growth;
    Point sum;
  };
  struct Watch {  // of particles
    std::size_t exceeding;
    bool too_far, late;
    Index flat = none;  // the first of those without an inverse of F
  };
  using Row = typename BroadPhase<S, D>::Row;
  struct Facing {        // of a slave to one wall, at the latest check
    Point outward;       // normal of the wall; zero where it was not asked for
    S turn;              // by which it may turn until the next check
    bool trusted, late;  // its row sleeps because of it; it has turned further
  };
  /// In evaluations of one candidate.
  [[nodiscard]] std::size_t cost_of_check() const { return broad_.masters().size() / 2 + 2 * particle().size(); }
  [[nodiscard]] const std::vector<OrganPairs::Side>& sides() const { return organs_.sides(); }
  [[nodiscard]] const std::vector<OrganPairs::Member>& members() const { return organs_.members(); }
  [[nodiscard]] const std::vector<Index>& particle() const { return organs_.particle(); }
  void number();
  template <class X, class Gradients, class E>
  [[nodiscard]] bool measure(const X& x, const Gradients& F, const E& execute);
  template <class E>
  void measure_organs(const E& execute);
  [[noreturn]] void fail(const OrganPairs::OrganRange& organ) const;
  template <class X>
  void choose_origin(const X& x);
  template <class Gradients>
  void check_flat(const Gradients& F) const;
  [[nodiscard]] S used(std::size_t side) const;
  template <class E>
  void build(const E& execute);
  [[nodiscard]] Point expected(std::size_t i) const { return place_[i] + static_cast<S>(age_) * drift_[i]; }
  [[nodiscard]] S longer() const { return static_cast<S>(interval_) / static_cast<S>(std::max<std::size_t>(age_, 1)); }
  void put_to_sleep(std::size_t row);
  [[nodiscard]] S widest(const Row& row);
  template <class X, class E>
  [[nodiscard]] bool watch(const X& x, const E& execute);
  void wake(Index particle, S moved_squared);
  void select();

  NormalDensity<S, D, Kernel> normal_density_;
  S radius_, margin_;
  Vector<double, D> origin_ = Vector<double, D>::Zero();  // in m: from where places are measured
  OrganPairs organs_;
  std::vector<OrganMotion> motion_;  // per organ
  std::vector<Part> parts_;
  // Of the numbered particles.
  std::vector<Point> place_, built_place_;  // at the latest check and build
  std::vector<Point> drift_;                // motion per call that is expected until the next check
  std::vector<Matrix<S, D>> metric_;        // A = F^-T F^-1 at the latest check
  std::vector<S> reach_, built_reach_;      // r_e times the stretch
  std::vector<S> compression_;              // bound of |F^-1|; negative: flattened, no wall
  std::vector<S> bound_, strain_;           // of motion beside the drift in m and strain, until the next check
  std::vector<S> travel_;                   // bound and drift in m
  std::vector<S> allowance_;                // square of the motion that wakes a row or makes a check due
  std::vector<Index> exceeding_;
  std::vector<Watch> watches_;
  BroadPhase<S, D> broad_;
  std::vector<Index> kept_master_;  // of each row, those within reach before the next check
  std::vector<Facing> facing_;      // per slot
  ActiveRows<S> active_;
  std::size_t rebuilds_ = 0, checks_ = 0, late_ = 0;
  std::size_t age_ = 0, interval_ = longest_interval, newly_active_ = 0, active_work_ = 0;
  bool built_ = false;
};

}  // namespace hmps::inline HMPS_ABI::detail
