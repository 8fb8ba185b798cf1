// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "hmps/contact/detail/active_rows.hpp"
#include "hmps/contact/detail/broad_phase.hpp"
#include "hmps/contact/detail/check_schedule.hpp"
#include "hmps/contact/detail/organ_pairs.hpp"
#include "hmps/contact/detail/particle_bounds.hpp"
#include "hmps/contact/detail/sleep_criterion.hpp"
#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Which rows of the broad-phase list sleep, and what wakes them. A check puts a row to sleep if its slave cannot touch
/// as long as the row's particles deviate little from their drift. `watch` measures the deviation of every particle in
/// each call, and wakes the rows for which this deviation is too large.
template <class S, int D, Metaball Kernel>
class SleepingRows {
 public:
  /// The rows and what is known of their particles.
  struct Source {
    const OrganPairs& organs;
    const BroadPhase<S, D>& list;
    const ParticleBounds<S, D>& particles;
    const NormalDensity<S, D, Kernel>& normal_density;
  };

  /// Forgets what is known of all slaves, which have `slots` slots.
  void resize(std::size_t slots) { criterion_.resize(slots); }

  /// In a check: puts rows to sleep and wakes all others. `interval` holds the calls since the previous check and until
  /// the next. Returns whether a row slept because of a bound that its wall has exceeded.
  template <class E>
  [[nodiscard]] bool put_to_sleep(const Source& source, const CheckInterval& interval, const E& execute);

  /// Wakes rows, `calls` calls after the check. Returns false if a particle has deviated by more than its bound, or is
  /// not finite, so that a new check is due.
  template <class X, class E>
  [[nodiscard]] bool watch(const Source& source, const X& x, std::size_t calls, const E& execute);

  /// The number of candidates in rows that woke since the check.
  [[nodiscard]] std::size_t woken() const { return woken_; }
  /// Adds the rows that are awake to `active`.
  void list_awake(const BroadPhase<S, D>& list, ActiveRows<S>& active) const;

 private:
  static constexpr std::size_t chunk = 512;
  struct Row {
    Index kept_end;  // end of its candidates that could be within reach before the next check
    S compression;   // bound of |F_j^-1| of these
    S rest;          // share of its bound by which each of its particles may deviate before it must wake; zero: awake
  };
  struct Chunk {  // of particles
    std::size_t exceeding;
    bool too_far;
  };
  [[nodiscard]] Row judge(const Source& source, const CheckInterval& interval, std::size_t r);
  void limit_allowances(const Source& source);
  void wake(const Source& source, Index particle, S deviation_squared);

  SleepCriterion<S, D, Kernel> criterion_;
  std::vector<Row> rows_;
  std::vector<Index> kept_;       // the masters of each row, those kept first
  std::vector<S> allowance_;      // per particle, square of the deviation that wakes a row or makes a check due
  std::vector<Index> exceeding_;  // particles beyond their allowance, by chunks
  std::vector<Chunk> chunks_;
  std::size_t woken_ = 0;
};

template <class S, int D, Metaball Kernel>
template <class E>
bool SleepingRows<S, D, Kernel>::put_to_sleep(const Source& source, const CheckInterval& interval, const E& execute) {
  const std::size_t count = source.list.rows().size() - 1;
  constexpr std::size_t batch = 64;
  rows_.resize(count);
  kept_.resize(source.list.masters().size());
  guarded(execute)((count + batch - 1) / batch, [&](std::size_t q) {
    for (std::size_t r = q * batch; r < std::min(count, (q + 1) * batch); ++r) rows_[r] = judge(source, interval, r);
  });
  limit_allowances(source);
  woken_ = 0;
  bool is_late = false;
  for (std::size_t r = 0; r < count; ++r) is_late = is_late || criterion_.is_late(source.list.rows()[r].slot);
  return is_late;
}

template <class S, int D, Metaball Kernel>
typename SleepingRows<S, D, Kernel>::Row SleepingRows<S, D, Kernel>::judge(const Source& source,
                                                                           const CheckInterval& interval,
                                                                           std::size_t r) {
  const typename BroadPhase<S, D>::Row& row = source.list.rows()[r];
  const S radius = static_cast<S>(source.organs.slave_radius(row.side, row.slot));
  const auto masters = std::span(source.list.masters()).subspan(row.begin, source.list.rows()[r + 1].begin - row.begin);
  const auto verdict = criterion_.judge({source.particles, source.normal_density, interval},
                                        {row.slave, row.slot, radius}, masters, kept_.data() + row.begin);
  return {static_cast<Index>(row.begin + verdict.kept), verdict.compression, verdict.rest};
}

/// Limits the deviation of each particle to what the least tolerant of its rows allows, among those that tolerate only
/// a share of the bound. Rows that tolerate the whole bound wake in the check that is due when it is exceeded.
template <class S, int D, Metaball Kernel>
void SleepingRows<S, D, Kernel>::limit_allowances(const Source& source) {
  const std::vector<S>& bound = source.particles.deviation();
  allowance_.resize(bound.size());
  exceeding_.resize(bound.size());
  chunks_.resize((bound.size() + chunk - 1) / chunk);
  for (std::size_t i = 0; i < bound.size(); ++i) allowance_[i] = bound[i] * bound[i];
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    if (!(row.rest > S(0) && row.rest < S(1))) continue;
    const auto limit = [&](Index i) {
      const S deviation = row.rest * bound[i];
      allowance_[i] = std::min(allowance_[i], deviation * deviation);
    };
    limit(source.list.rows()[r].slave);
    for (Index k = source.list.rows()[r].begin; k < row.kept_end; ++k) limit(kept_[k]);
  }
}

template <class S, int D, Metaball Kernel>
template <class X, class E>
bool SleepingRows<S, D, Kernel>::watch(const Source& source, const X& x, std::size_t calls, const E& execute) {
  const std::vector<Index>& particle = source.organs.particle();
  const std::vector<S>& bound = source.particles.deviation();
  const S since = static_cast<S>(calls);
  const auto deviation_squared = [&, &particles = source.particles](std::size_t i) {
    return particles.deviation_squared(x, particle[i], i, since);
  };
  guarded(execute)(chunks_.size(), [&](std::size_t q) {
    Chunk found{0, false};
    const std::size_t begin = q * chunk, end = std::min(particle.size(), begin + chunk);
    for (std::size_t i = begin; i < end; ++i)
      if (const S squared = deviation_squared(i); !(squared <= allowance_[i])) {
        exceeding_[begin + found.exceeding++] = static_cast<Index>(i);
        found.too_far = found.too_far || !(squared <= bound[i] * bound[i]);
      }
    chunks_[q] = found;
  });
  for (const Chunk& found : chunks_)
    if (found.too_far) return false;
  for (std::size_t q = 0; q < chunks_.size(); ++q)
    for (std::size_t k = q * chunk; k < q * chunk + chunks_[q].exceeding; ++k)
      wake(source, exceeding_[k], deviation_squared(exceeding_[k]));
  return true;
}

/// Wakes the rows that must no longer sleep, given the deviation of one of their particles, and limits its allowance to
/// what the other rows tolerate.
template <class S, int D, Metaball Kernel>
void SleepingRows<S, D, Kernel>::wake(const Source& source, Index particle, S deviation_squared) {
  const BroadPhase<S, D>& list = source.list;
  const S bound = source.particles.deviation()[particle];
  S& allowance = allowance_[particle] = bound * bound;
  for (Index q = list.rows_of_begin(particle); q < list.rows_of_begin(particle + 1); ++q) {
    const Index r = list.rows_of()[q];
    Row& row = rows_[r];
    const S deviation = row.rest * bound, rest_squared = deviation * deviation;
    if (row.rest == S(0)) continue;
    if (rest_squared < deviation_squared) {
      row.rest = 0;
      woken_ += row.kept_end - list.rows()[r].begin;
    } else {
      allowance = std::min(allowance, rest_squared);
    }
  }
}

template <class S, int D, Metaball Kernel>
void SleepingRows<S, D, Kernel>::list_awake(const BroadPhase<S, D>& list, ActiveRows<S>& active) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const typename BroadPhase<S, D>::Row& row = list.rows()[r];
    if (rows_[r].rest > S(0) || rows_[r].kept_end <= row.begin) continue;
    active.add(row.slave, row.side, row.slot, rows_[r].compression, kept_.data() + row.begin,
               kept_.data() + rows_[r].kept_end);
  }
}

}  // namespace hmps::inline HMPS_ABI::detail
