// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/candidates.hpp"
#include "hmps/contact/master_surface.hpp"

namespace hmps::detail {

/// Three particles of each organ tell when whole organs were moved by other means than steps in time.
template <class S, int D, Metaball Ball>
template <class X>
bool Candidates<S, D, Ball>::probe(const X& x) const {
  for (const OrganRange& organ : organs)
    for (const std::size_t m : {organ.begin, (organ.begin + organ.end) / 2, organ.end - 1})
      if (!((x[particle_[m]].template cast<S>() - place_[m]).squaredNorm() <= stray_squared_)) return true;
  return false;
}

template <class S, int D, Metaball Ball>
template <class X, class V, class Gradients, class E>
void Candidates<S, D, Ball>::check(const X& x, const V& v, const Gradients& F, S dt, const E& execute) {
  if (partials_.empty()) {
    number();
    built_ = false;
  }
  measure(x, v, F, execute);
  ++checks;
  if (built_ && S(2) * step_ + step_growth_ > margin()) ++late;
  for (const Side& side : sides) {
    const OrganRange &a = organs[side.slaves], &b = organs[side.masters];
    if (!(a.motion + b.motion + (a.moved - b.moved).norm() + b.growth + margin() < side.limit)) built_ = false;
  }
  if (!built_) build(execute);
  select(execute);
  // Half the margin for motion at twice the present speeds of both partners; growth of the reach is
  // slower than that, and is seen at the next check.
  const S naps = S(0.5) * margin() / (S(2) * speed_ * dt + std::numeric_limits<S>::min());
  naps_ = naps < S(longest_nap) ? static_cast<std::size_t>(naps) : longest_nap;
  stray_squared_ = S(0.16) * margin() * margin();
}

/// Places, reaches, and how far all moved since the outer lists were built and since the last check.
template <class S, int D, Metaball Ball>
template <class X, class V, class Gradients, class E>
void Candidates<S, D, Ball>::measure(const X& x, const V& v, const Gradients& F, const E& execute) {
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
      const Matrix<S, D> deformation = F[particle_[m]].template cast<S>();
      const S reach = radius_ * stretch_bound<S, D>(deformation);
      if (flags_[m] & is_master) {
        const S compression = stretch_bound<S, D>(inverse<S, D>(deformation));
        // A master that is squashed flat is no wall.
        compression_[m] = std::isfinite(compression) && std::isfinite(reach) ? compression : S(-1);
        if (built_) {
          growth = std::max(growth, reach - built_reach_[m]);
          step_growth = std::max(step_growth, reach - reach_[m]);
        }
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

template <class S, int D, Metaball Ball>
template <class X>
void Candidates<S, D, Ball>::fail(const X& x, const OrganRange& organ) const {
  for (std::size_t m = organ.begin; m < organ.end; ++m)
    for (int c = 0; c < D; ++c)
      if (!std::isfinite(x(particle_[m], c)))
        throw StateError(message("hmps: contact found component ", c, " of the position of particle ", particle_[m],
                                 " of '", organ.name, "' to be ", x(particle_[m], c),
                                 "; the run has become unstable: try a shorter step or a softer penalty"));
  throw StateError(message("hmps: contact found the positions of '", organ.name,
                           "' to overflow; the run has become unstable: try a shorter step or a softer penalty"));
}

/// Sorts out the masters of outer row `r` that the inner list keeps; none of them where the slave
/// cannot touch before the next check, for which C is bounded from above with every master nearer by
/// the margin. Returns the bound of |F_j^-1|.
template <class S, int D, Metaball Ball>
S Candidates<S, D, Ball>::keep(std::size_t r, Index& end) {
  const OuterRow& row = outer_rows_[r];
  const Point place = place_[row.member];
  S density = 0, compression = 0;
  end = row.begin;
  for (Index k = row.begin; k < outer_rows_[r + 1].begin; ++k) {
    const Index m = outer_member_[k];
    const S reach = reach_[m] + margin(), squared = (place_[m] - place).squaredNorm();
    if (!(squared <= reach * reach) || compression_[m] < S(0)) continue;
    kept_member_[end++] = m;
    compression = std::max(compression, compression_[m]);
    const S nearest = std::max(S(0), std::sqrt(squared) - margin()) / reach_[m];
    density += Ball::value(std::min(S(1), nearest * nearest));
  }
  // Five per cent for what the gradients may do meanwhile.
  compression *= S(1.05);
  const S l0 = normal_density.spacing(), support = S(1.05) * S(0.5) * l0 * reach_[row.member] / radius_;
  if (surface_distance(S(1), normal_density.inverse(density).value, l0) >= support * compression) end = row.begin;
  return compression;
}

template <class S, int D, Metaball Ball>
template <class E>
void Candidates<S, D, Ball>::select(const E& execute) {
  const std::size_t outer = outer_rows_.size() - 1;
  constexpr std::size_t batch = 64;
  execute((outer + batch - 1) / batch, [&](std::size_t q) {
    for (std::size_t r = q * batch; r < std::min(outer, (q + 1) * batch); ++r)
      outer_rows_[r].compression = keep(r, outer_rows_[r].kept);
  });
  rows.clear();
  candidate_member_.clear();
  for (std::size_t r = 0; r < outer; ++r) {
    const OuterRow& row = outer_rows_[r];
    if (row.kept == row.begin) continue;
    rows.push_back({row.particle, row.unique, row.side, static_cast<Index>(candidate_member_.size()), row.compression});
    candidate_member_.insert(candidate_member_.end(), kept_member_.begin() + row.begin,
                             kept_member_.begin() + row.kept);
  }
  rows.push_back({0, 0, 0, static_cast<Index>(candidate_member_.size()), 0});
  transpose();
}

/// Numbers the slots and the touched particles of the inner list and lists what refers to each.
template <class S, int D, Metaball Ball>
void Candidates<S, D, Ball>::transpose() {
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
  slot_rows.resize(slot_of.size());
  entry_of.resize(slot_of.size());
  next_.assign(slot_begin.begin(), slot_begin.end() - 1);
  for (std::size_t r = 0; r < row_count; ++r)
    for (Index k = rows[r].begin; k < rows[r + 1].begin; ++k) {
      entry_of[k] = next_[slot_of[k]]++;
      slot_rows[entry_of[k]] = static_cast<Index>(r);
    }
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
