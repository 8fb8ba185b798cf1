// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/candidates.hpp"

namespace hmps::detail {

/// Three particles of each organ tell when whole organs were moved by other means than steps in time.
template <class S, int D>
template <class X>
bool Candidates<S, D>::probe(const X& x) const {
  for (const OrganRange& organ : organs)
    for (const std::size_t m : {organ.begin, (organ.begin + organ.end) / 2, organ.end - 1})
      if (!((x[particle_[m]].template cast<S>() - place_[m]).squaredNorm() <= stray_squared_)) return true;
  return false;
}

template <class S, int D>
template <class X, class V, class Gradients, class E>
void Candidates<S, D>::check(const X& x, const V& v, const Gradients& F, S dt, S radius, S skin, const E& execute) {
  if (partials_.empty()) {
    number();
    built_ = false;
  }
  const S margin = S(0.4) * skin;
  measure(x, v, F, radius, execute);
  ++checks;
  if (built_ && S(2) * step_ + step_growth_ > margin) ++late;
  for (const Side& side : sides) {
    const OrganRange &a = organs[side.slaves], &b = organs[side.masters];
    if (!(a.motion + b.motion + (a.moved - b.moved).norm() + b.growth + margin < side.limit)) built_ = false;
  }
  if (!built_) build(radius, skin, execute);
  select(margin, execute);
  // Half the margin for motion at twice the present speeds of both partners; growth of the reach is
  // slower than that, and is seen at the next check.
  const S naps = S(0.5) * margin / (S(2) * speed_ * dt + std::numeric_limits<S>::min());
  naps_ = naps < S(longest_nap) ? static_cast<std::size_t>(naps) : longest_nap;
  stray_squared_ = S(0.16) * margin * margin;
}

/// Places, reaches, and how far all moved since the outer lists were built and since the last check.
template <class S, int D>
template <class X, class V, class Gradients, class E>
void Candidates<S, D>::measure(const X& x, const V& v, const Gradients& F, S radius, const E& execute) {
  execute(partials_.size(), [&](std::size_t q) {
    Partial& part = partials_[q];
    const Point shift = organs[part.organ].moved;
    S motion = 0, growth = 0, speed = 0, step = 0, step_growth = 0;
    Point sum = Point::Zero();
    for (std::size_t m = part.begin; m < part.end; ++m) {
      const Point place = x[particle_[m]].template cast<S>();
      if (built_) {
        const Point u = place - built_place_[m];
        sum += u;
        motion = std::max(motion, (u - shift).squaredNorm());
        step = std::max(step, (place - place_[m]).squaredNorm());
      } else {
        sum += place;
      }
      speed = std::max(speed, v[particle_[m]].template cast<S>().squaredNorm());
      place_[m] = place;
      if (!(flags_[m] & is_master)) continue;
      S reach = radius * stretch_bound<S, D>(F[particle_[m]].template cast<S>());
      if (!std::isfinite(reach)) reach = S(-1);
      if (built_) {
        growth = std::max(growth, reach - built_reach_[m]);
        step_growth = std::max(step_growth, reach - reach_[m]);
      }
      reach_[m] = reach;
    }
    part = {part.organ, part.begin, part.end, motion, growth, speed, step, step_growth, sum};
  });
  speed_ = step_ = step_growth_ = 0;
  std::size_t organ_of_failure = organs.size();
  std::vector<Point> shift(organs.size());
  for (std::size_t o = 0; o < organs.size(); ++o) {
    shift[o] = organs[o].moved;
    organs[o].motion = organs[o].growth = 0;
    organs[o].moved.setZero();
  }
  for (const Partial& part : partials_) {
    OrganRange& organ = organs[part.organ];
    organ.motion = std::max(organ.motion, part.motion);
    organ.growth = std::max(organ.growth, part.growth);
    organ.moved += part.sum;
    speed_ = std::max(speed_, part.speed);
    step_ = std::max(step_, part.step);
    step_growth_ = std::max(step_growth_, part.step_growth);
    // A NaN slips through the maxima but not through the sum.
    if (!std::isfinite(part.sum.sum())) organ_of_failure = std::min(organ_of_failure, part.organ);
  }
  if (organ_of_failure < organs.size()) fail(x, organs[organ_of_failure]);
  speed_ = std::sqrt(speed_);
  step_ = std::sqrt(step_);
  for (std::size_t o = 0; o < organs.size(); ++o) {
    OrganRange& organ = organs[o];
    // `motion` was measured beyond the mean of the check before, which serves as well as the present.
    organ.motion = std::sqrt(organ.motion);
    const Point mean = organ.moved / static_cast<S>(organ.end - organ.begin);
    organ.motion += (mean - shift[o]).norm();
    organ.moved = mean;
  }
}

template <class S, int D>
template <class X>
void Candidates<S, D>::fail(const X& x, const OrganRange& organ) const {
  for (std::size_t m = organ.begin; m < organ.end; ++m)
    for (int c = 0; c < D; ++c)
      if (!std::isfinite(x(particle_[m], c)))
        throw StateError(message("hmps: contact found component ", c, " of the position of particle ", particle_[m],
                                 " of '", organ.name, "' to be ", x(particle_[m], c),
                                 "; the run has become unstable: try a shorter step or a softer penalty"));
  throw StateError(message("hmps: contact found the positions of '", organ.name,
                           "' to overflow; the run has become unstable: try a shorter step or a softer penalty"));
}

/// The inner list: what lies within reach plus `margin` now.
template <class S, int D>
template <class E>
void Candidates<S, D>::select(S margin, const E& execute) {
  const std::size_t outer = outer_rows_.size() - 1;
  constexpr std::size_t batch = 64;
  execute((outer + batch - 1) / batch, [&](std::size_t q) {
    for (std::size_t r = q * batch; r < std::min(outer, (q + 1) * batch); ++r) {
      OuterRow& row = outer_rows_[r];
      const Point place = place_[row.member];
      Index end = row.begin;
      for (std::size_t k = row.begin; k < outer_rows_[r + 1].begin; ++k) {
        const Index m = outer_member_[k];
        const S reach = reach_[m] + margin;
        if (reach_[m] > S(0) && (place_[m] - place).squaredNorm() <= reach * reach) kept_member_[end++] = m;
      }
      row.kept = end;
    }
  });
  rows.clear();
  candidate_member_.clear();
  for (std::size_t r = 0; r < outer; ++r) {
    const OuterRow& row = outer_rows_[r];
    if (row.kept == row.begin) continue;
    rows.push_back({row.particle, row.unique, row.side, static_cast<Index>(candidate_member_.size())});
    candidate_member_.insert(candidate_member_.end(), kept_member_.begin() + row.begin,
                             kept_member_.begin() + row.kept);
  }
  rows.push_back({0, 0, 0, static_cast<Index>(candidate_member_.size())});
  transpose();
}

/// Numbers the slots and the touched particles of the inner list and lists what refers to each.
template <class S, int D>
void Candidates<S, D>::transpose() {
  const std::size_t row_count = rows.size() - 1;
  // Members ascend, so slots follow the particles' order.
  for (const Index m : candidate_member_) slot_of_member_[m] = 0;
  slot_member.clear();
  slot_particle.clear();
  for (std::size_t m = 0; m < slot_of_member_.size(); ++m)
    if (slot_of_member_[m] != none) {
      slot_of_member_[m] = static_cast<Index>(slot_member.size());
      slot_member.push_back(static_cast<Index>(m));
      slot_particle.push_back(particle_[m]);
    }
  const std::size_t slot_count = slot_member.size();
  slot_of.resize(candidate_member_.size());
  slot_begin.assign(slot_count + 1, 0);
  for (std::size_t k = 0; k < slot_of.size(); ++k) {
    slot_of[k] = slot_of_member_[candidate_member_[k]];
    ++slot_begin[slot_of[k] + 1];
  }
  for (std::size_t l = 0; l < slot_count; ++l) slot_begin[l + 1] += slot_begin[l];
  slot_entries.resize(slot_of.size());
  next_.assign(slot_begin.begin(), slot_begin.end() - 1);
  for (std::size_t r = 0; r < row_count; ++r)
    for (Index k = rows[r].begin; k < rows[r + 1].begin; ++k)
      slot_entries[next_[slot_of[k]]++] = {static_cast<Index>(r), k};
  for (const Index m : slot_member) slot_of_member_[m] = none;

  // Each particle once, with all its rows and slots: the only place where its force is written.
  for (std::size_t r = 0; r < row_count; ++r) touched_of_[rows[r].touched] = 0;
  for (const Index m : slot_member) touched_of_[unique_[m]] = 0;
  touched.clear();
  for (std::size_t u = 0; u < touched_of_.size(); ++u)
    if (touched_of_[u] != none) {
      touched_of_[u] = static_cast<Index>(touched.size());
      touched.push_back({unique_particle_[u], unique_flags_[u], 0, 0});
    }
  slot_touched.resize(slot_count);
  for (std::size_t r = 0; r < row_count; ++r) ++touched[rows[r].touched = touched_of_[rows[r].touched]].rows;
  for (std::size_t l = 0; l < slot_count; ++l) ++touched[slot_touched[l] = touched_of_[unique_[slot_member[l]]]].slots;
  Index row_end = 0, slot_end = 0;
  for (Touched& t : touched) {
    row_end += t.rows;
    t.rows = row_end - t.rows;
    slot_end += t.slots;
    t.slots = slot_end - t.slots;
  }
  std::fill(touched_of_.begin(), touched_of_.end(), none);
  touched_rows.resize(row_end);
  touched_slots.resize(slot_end);
  // Filling moves each begin on to its end, which is where the next one begins.
  for (std::size_t r = 0; r < row_count; ++r) touched_rows[touched[rows[r].touched].rows++] = static_cast<Index>(r);
  for (std::size_t l = 0; l < slot_count; ++l) touched_slots[touched[slot_touched[l]].slots++] = static_cast<Index>(l);
}

}  // namespace hmps::detail
