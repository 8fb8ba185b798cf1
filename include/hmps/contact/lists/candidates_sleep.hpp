// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/lists/candidates.hpp"
#include "hmps/contact/master_surface.hpp"
#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// An upper bound until the next check of |F_i^T n| max |F_j^-1 n| over the masters kept for `row`: the distance R_im,
/// less half a spacing and over as much, at which its slave touches. |F^T n| and |F^-1 n| follow from A = F^-T F^-1; a
/// normal that turns by t changes them by t times the largest stretch.
template <class S, int D, Metaball Kernel>
S Candidates<S, D, Kernel>::widest(const Row& row) {
  MasterSurface<S, D, Kernel> surface;
  for (Index k = row.begin; k < row.kept; ++k) {
    const Index j = kept_master_[k];
    surface.reach(metric_[j], place_[j] - place_[row.slave], S(1) / (radius_ * radius_));
  }
  Facing& facing = facing_[row.slot];
  Point outward;
  if (!surface.normal(radius_, outward)) {
    facing.outward.setZero();
    return std::numeric_limits<S>::max();
  }
  if (facing.outward.isZero()) {
    facing.turn = first_turn;
  } else {
    const S turn = (outward - facing.outward).norm();
    facing.late = facing.trusted && turn > facing.turn;
    facing.turn = std::max({least_turn, S(4) * longer() * turn, S(0.5) * facing.turn});
  }
  facing.outward = outward;
  S compression = 0;
  for (Index k = row.begin; k < row.kept; ++k) {
    const Index j = kept_master_[k];
    const S length = std::sqrt(outward.dot(metric_[j] * outward)) + facing.turn * compression_[j];
    compression = std::max(compression, (S(1) + strain_[j]) * std::min(compression_[j], length));
  }
  const S stretch = reach_[row.slave] / radius_,
          length = std::sqrt(outward.dot(inverse<S, D>(metric_[row.slave]) * outward)) + facing.turn * stretch;
  return (S(1) + strain_[row.slave]) * std::min(stretch, length) * compression;
}

/// Selects the masters of row `r` that could be within reach before the next check, and computes how long the row may
/// sleep: C is bounded from above with every master as near as it comes if both continue their motion, and nearer by
/// the deviation allowed for both. With B for F_j^-1 and a motion m, |B (r + m)| >= |B r| - |B| |m|.
template <class S, int D, Metaball Kernel>
void Candidates<S, D, Kernel>::put_to_sleep(std::size_t r) {
  Row& row = broad_.rows()[r];
  const Point place = place_[row.slave];
  constexpr std::size_t levels = 3;
  S density[levels] = {};
  row.kept = row.begin;
  row.compression = 0;
  for (Index k = row.begin; k < broad_.rows()[r + 1].begin; ++k) {
    const Index j = broad_.masters()[k];
    Point apart = place_[j] - place;
    const S strain = S(1) + strain_[j], motion = bound_[row.slave] + bound_[j];
    const S furthest = strain * reach_[j] + travel_[row.slave] + travel_[j];
    if (compression_[j] < S(0) || !(apart.squaredNorm() <= furthest * furthest)) continue;
    const Point drift = static_cast<S>(interval_) * (drift_[j] - drift_[row.slave]);
    const Point along = metric_[j] * drift;
    if (const S ahead = -apart.dot(along); ahead > S(0)) apart += std::min(S(1), ahead / drift.dot(along)) * drift;
    const S distance = std::sqrt(apart.dot(metric_[j] * apart)) / (strain * radius_);
    S nearer = strain * compression_[j] / radius_ * motion;
    if (distance - nearer >= S(1)) continue;
    kept_master_[row.kept++] = j;
    row.compression = std::max(row.compression, strain * compression_[j]);
    for (std::size_t q = 0; q < levels; ++q, nearer *= S(0.5)) {
      const S nearest = std::max(S(0), distance - nearer);
      density[q] += Kernel::value(std::min(S(1), nearest * nearest));
    }
  }
  const S l0 = normal_density_.spacing(), radius = static_cast<S>(organs_.slave_radius(row.side, row.slot));
  const auto rests = [&](S touching) {
    row.rest = 1;
    for (std::size_t q = 0; q < levels; ++q, row.rest *= S(0.5))
      if (!(surface_distance(S(1), normal_density_.inverse(density[q]).value, l0) < radius * touching)) return true;
    row.rest = 0;
    return false;
  };
  // First the bound for stretches and rotations in any direction; only if it is too large, the bound along the normal.
  const S stretch = (S(1) + strain_[row.slave]) * reach_[row.slave] / radius_;
  Facing& facing = facing_[row.slot];
  facing.late = false;
  if (rests(stretch * row.compression)) {
    facing.outward.setZero();
    facing.trusted = false;
  } else {
    facing.trusted = rests(widest(row));
  }
}

/// Wakes the rows of particles that have deviated too far since the check. Returns false if one has deviated so far, or
/// is not finite, that a new check is due.
template <class S, int D, Metaball Kernel>
template <class X, class E>
bool Candidates<S, D, Kernel>::watch(const X& x, const E& execute) {
  const auto moved_squared = [&](std::size_t i) { return (place_of(x, particle()[i]) - expected(i)).squaredNorm(); };
  execute(watches_.size(), [&](std::size_t q) {
    Watch found{0, false, false};
    for (std::size_t i = q * chunk; i < std::min(particle().size(), (q + 1) * chunk); ++i)
      if (const S moved = moved_squared(i); !(moved <= allowance_[i])) {
        exceeding_[q * chunk + found.exceeding++] = static_cast<Index>(i);
        found.too_far = found.too_far || !(moved <= bound_[i] * bound_[i]);
      }
    watches_[q] = found;
  });
  for (const Watch& found : watches_)
    if (found.too_far) return false;
  for (std::size_t q = 0; q < watches_.size(); ++q)
    for (std::size_t k = q * chunk; k < q * chunk + watches_[q].exceeding; ++k)
      wake(exceeding_[k], moved_squared(exceeding_[k]));
  return true;
}

/// Wakes the rows that must no longer sleep, given the deviation of one of their particles.
template <class S, int D, Metaball Kernel>
void Candidates<S, D, Kernel>::wake(Index particle, S moved_squared) {
  S& allowance = allowance_[particle] = bound_[particle] * bound_[particle];
  for (Index q = broad_.rows_of_begin(particle); q < broad_.rows_of_begin(particle + 1); ++q) {
    Row& row = broad_.rows()[broad_.rows_of()[q]];
    const S motion = row.rest * bound_[particle], rest_squared = motion * motion;
    if (row.rest == S(0)) continue;
    if (rest_squared < moved_squared) {
      row.rest = 0;
      newly_active_ += row.kept - row.begin;
    } else {
      allowance = std::min(allowance, rest_squared);
    }
  }
}

}  // namespace hmps::inline HMPS_ABI::detail
