// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>

#include "hmps/contact/detail/active_rows.hpp"
#include "hmps/contact/detail/broad_phase.hpp"
#include "hmps/contact/detail/check_schedule.hpp"
#include "hmps/contact/detail/organ_motion.hpp"
#include "hmps/contact/detail/organ_pairs.hpp"
#include "hmps/contact/detail/particle_bounds.hpp"
#include "hmps/contact/detail/sleeping_rows.hpp"
#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/contact/organ.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The lists of slaves and masters that may touch. The broad-phase list (`BroadPhase`) holds the pairs within reach
/// plus `margin`, in rows of one slave each. It is rebuilt when organs have moved, or a reach has grown, by that margin
/// (`OrganMotion`). Most of its rows sleep (`SleepingRows`): a check extrapolates the motion of the particles
/// (`ParticleBounds`) and judges which slaves cannot touch before the next check. Every later call wakes the rows of
/// particles that deviate from this motion; the rows that are awake make up the Verlet list that is evaluated
/// (`ActiveRows`). `CheckSchedule` decides when the next check is due.
///
/// Everything is in the order of the particles' indices, so sums over contacts do not depend on when lists were built.
///
/// The particles of all organs are numbered once each, in the order of their indices; a member is such a particle in
/// one organ. A row is a slave of one side (an ordered pair of organs).
template <class S, int D, Metaball Kernel>
class Candidates {
 public:
  using Point = Vector<S, D>;

  /// `spacing` and `margin` in m.
  Candidates(S spacing, S margin)
      : normal_density_(spacing), margin_(margin), particles_(spacing, static_cast<S>(Kernel::radius) * spacing) {}

  std::size_t add_organ(const Organ& organ) {
    const std::size_t added = organs_.add_organ(organ, static_cast<double>(normal_density_.spacing()), D);
    numbered_ = built_ = false;
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

  /// From where positions are measured, in m.
  [[nodiscard]] const Vector<double, D>& origin() const { return particles_.origin(); }
  /// Measures positions from `origin` (m); if that is another one, the next call builds the lists anew.
  void restore_origin(const Vector<double, D>& origin) {
    built_ = built_ && origin == particles_.origin();
    particles_.restore_origin(origin);
  }

  /// The position of particle `i` of the view `x`, as `ParticleBounds::place_of`.
  template <class X>
  [[nodiscard]] HMPS_INLINE Point place_of(const X& x, std::size_t i) const {
    return particles_.place_of(x, i);
  }

  /// Updates the lists for this call. Returns whether the active rows have changed.
  template <class X, class Gradients, class E>
  bool update(const X& x, const Gradients& F, const E& execute);

  /// Checks all organs, rebuilds the broad-phase list if needed, and puts rows to sleep.
  template <class X, class Gradients, class E>
  void check(const X& x, const Gradients& F, const E& execute);

 private:
  /// Counted in evaluations of one candidate.
  [[nodiscard]] std::size_t cost_of_check() const { return list_.masters().size() / 2 + 2 * organs_.particle().size(); }
  [[nodiscard]] typename SleepingRows<S, D, Kernel>::Source source() const {
    return {organs_, list_, particles_, normal_density_};
  }
  void number();
  template <class X, class Gradients, class E>
  [[nodiscard]] bool measure(const X& x, const Gradients& F, bool is_first, const E& execute);
  [[nodiscard]] bool is_used_up() const;
  template <class X, class E>
  void build(const X& x, const E& execute);
  void limit_travel();
  void select();

  NormalDensity<S, D, Kernel> normal_density_;
  S margin_;
  OrganPairs organs_;
  ParticleBounds<S, D> particles_;
  OrganMotion<S, D> motion_;
  BroadPhase<S, D> list_;
  SleepingRows<S, D, Kernel> sleeping_;
  ActiveRows<S> active_;
  CheckSchedule schedule_;
  std::size_t rebuilds_ = 0, checks_ = 0, late_ = 0;
  bool numbered_ = false, built_ = false;
};

template <class S, int D, Metaball Kernel>
template <class X, class Gradients, class E>
bool Candidates<S, D, Kernel>::update(const X& x, const Gradients& F, const E& execute) {
  const std::size_t woken = sleeping_.woken();
  if (!built_ || schedule_.count_call(woken, cost_of_check()) ||
      !sleeping_.watch(source(), x, schedule_.interval().since, execute)) {
    check(x, F, execute);
    return true;
  }
  if (sleeping_.woken() == woken) return false;
  select();
  return true;
}

template <class S, int D, Metaball Kernel>
template <class X, class Gradients, class E>
void Candidates<S, D, Kernel>::check(const X& x, const Gradients& F, const E& execute) {
  if (!numbered_) number();
  // What follows may throw when places have been replaced but no list has been built for them. Then all starts anew.
  const bool is_first = !std::exchange(built_, false);
  if (is_first) sleeping_.resize(organs_.slots());
  schedule_.choose_interval(active_.master_of().size(), cost_of_check());
  const bool has_deformed = measure(x, F, is_first, execute);
  ++checks_;
  if (is_first || is_used_up()) build(x, execute);
  limit_travel();
  const bool has_turned = sleeping_.put_to_sleep(source(), schedule_.interval(), execute);
  late_ += has_deformed || has_turned;
  schedule_.start_interval();
  select();
  built_ = true;
}

/// Numbers the particles of all organs once each.
template <class S, int D, Metaball Kernel>
void Candidates<S, D, Kernel>::number() {
  organs_.number_particles();
  particles_.resize(organs_.particle().size());
  motion_.resize(organs_);
  numbered_ = true;
}

/// Measures particles and organs, for the first time if `is_first`. Returns whether a particle of a row has deformed by
/// more than was allowed for.
template <class S, int D, Metaball Kernel>
template <class X, class Gradients, class E>
bool Candidates<S, D, Kernel>::measure(const X& x, const Gradients& F, bool is_first, const E& execute) {
  const auto is_listed = [&](std::size_t i) { return list_.rows_of_begin(i) < list_.rows_of_begin(i + 1); };
  const bool has_deformed =
      particles_.measure(x, F, organs_.particle(), is_first, schedule_.interval(), is_listed, execute);
  motion_.measure(organs_, particles_.place(), particles_.reach(), execute);
  return has_deformed;
}

/// Whether so little of the margin is left that the next check could come too late.
template <class S, int D, Metaball Kernel>
bool Candidates<S, D, Kernel>::is_used_up() const {
  for (std::size_t s = 0; s < organs_.sides().size(); ++s)
    if (!(motion_.used(organs_.sides()[s]) + S(0.4) * margin_ < list_.limit(s))) return true;
  return false;
}

/// Builds the broad-phase list from the places and reaches of this check.
template <class S, int D, Metaball Kernel>
template <class X, class E>
void Candidates<S, D, Kernel>::build(const X& x, const E& execute) {
  particles_.centre_origin(x, organs_.particle());
  motion_.restart(particles_.place(), particles_.reach());
  list_.build({organs_, particles_.place(), particles_.reach(), particles_.compression(), particles_.radius(), margin_},
              std::cref(execute));
  ++rebuilds_;
}

/// Limits the motion until the next check to what the broad-phase list tolerates.
template <class S, int D, Metaball Kernel>
void Candidates<S, D, Kernel>::limit_travel() {
  // Two particles may approach each other by twice `most`; the rest is for the growth of reaches.
  S most = std::numeric_limits<S>::max();
  for (std::size_t s = 0; s < organs_.sides().size(); ++s)
    most = std::min(most, S(0.4) * (list_.limit(s) - motion_.used(organs_.sides()[s])));
  schedule_.limit_travel(particles_.fastest(), S(0.5) * most);
  particles_.limit_travel(most, schedule_.interval().until);
}

/// Builds the list of active rows.
template <class S, int D, Metaball Kernel>
void Candidates<S, D, Kernel>::select() {
  active_.clear();
  sleeping_.list_awake(list_, active_);
  active_.finish(organs_);
}

}  // namespace hmps::inline HMPS_ABI::detail
