// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/candidates.hpp"

namespace hmps::detail {

template <class S, int D>
template <class X, class Gradients, class E>
void Candidates<S, D>::build(const X& x, const Gradients& F, S radius, S skin, const E& execute) {
  const std::size_t n = particle.size();
  place_.resize(n);
  reach_.resize(n);
  execute(n, [&](std::size_t m) {
    place_[m] = x[particle[m]].template cast<S>();
    reach_[m] = 0;
    if (flags[m] & is_master) {
      const S reach = radius * stretch_bound<S, D>(F[particle[m]].template cast<S>());
      reach_[m] = std::isfinite(reach) ? reach : S(0);
    }
  });
  partials_.clear();
  for (std::size_t o = 0; o < organs.size(); ++o) {
    OrganRange& organ = organs[o];
    organ.shift.setZero();
    organ.moved.setZero();
    organ.motion = organ.growth = 0;
    for (std::size_t m = organ.begin; m < organ.end; ++m)
      if (!std::isfinite(place_[m].sum())) fail(x, organ);
    for (std::size_t m = organ.begin; m < organ.end; m += chunk)
      partials_.push_back({o, m, std::min(m + chunk, organ.end), 0, 0, Point::Zero()});
  }
  rows.clear();
  candidate_member_.clear();
  for (std::size_t s = 0; s < sides.size(); ++s) build_side(static_cast<std::uint32_t>(s), radius, skin, execute);
  require(candidate_member_.size() < std::numeric_limits<Index>::max(), "hmps: ", candidate_member_.size(),
          " candidates for contact are more than a 32-bit index can number; name fewer slaves and masters");
  rows.push_back({0, 0, 0, candidate_member_.size(), 0});
  transpose();
  built_ = true;
  ++rebuilds;
}

template <class S, int D>
template <class E>
void Candidates<S, D>::build_side(std::uint32_t s, S radius, S skin, const E& execute) {
  Side& side = sides[s];
  const OrganRange &a = organs[side.slaves], &b = organs[side.masters];
  const Pair& pair = pairs[side.pair];
  side.motion = 0;
  // Only what lies in the other's box, grown by what it reaches, is looked at.
  constexpr S far = std::numeric_limits<S>::max();
  Point low = Point::Constant(far), high = -low, low_a = low, high_a = high;
  S widest = 0;
  for (std::size_t m = b.begin; m < b.end; ++m)
    if (flags[m] & is_master) {
      low = low.cwiseMin(place_[m]);
      high = high.cwiseMax(place_[m]);
      widest = std::max(widest, reach_[m]);
    }
  std::vector<std::size_t> slaves, masters;
  for (std::size_t m = a.begin; m < a.end; ++m) {
    if (!(flags[m] & is_slave)) continue;
    if (std::binary_search(pair.excluded_slaves.begin(), pair.excluded_slaves.end(), particle[m])) continue;
    low_a = low_a.cwiseMin(place_[m]);
    high_a = high_a.cwiseMax(place_[m]);
    const Point out = (low - place_[m]).cwiseMax(place_[m] - high);
    if (out.maxCoeff() <= widest + skin) slaves.push_back(m);
  }
  // All slaves may be excluded: then no motion matters.
  const S apart = low_a[0] <= high_a[0] ? (low - high_a).cwiseMax(low_a - high).maxCoeff() - widest : far;
  side.limit = S(0.999) * std::max(skin, apart);
  if (slaves.empty()) return;
  Point low_s = Point::Constant(far), high_s = -low_s;
  for (const std::size_t m : slaves) {
    low_s = low_s.cwiseMin(place_[m]);
    high_s = high_s.cwiseMax(place_[m]);
  }
  for (std::size_t m = b.begin; m < b.end; ++m) {
    if (!(flags[m] & is_master)) continue;
    const Point out = (low_s - place_[m]).cwiseMax(place_[m] - high_s);
    if (reach_[m] > 0 && out.maxCoeff() <= reach_[m] + skin) masters.push_back(m);
  }
  Grid<S, D> grid;
  grid.build(slaves.size(), radius + skin, [&](std::size_t k) { return place_[slaves[k]]; });
  constexpr std::size_t batch = 256;
  std::vector<std::vector<Near>> found((masters.size() + batch - 1) / batch);
  execute(found.size(), [&](std::size_t q) {
    for (std::size_t l = q * batch; l < std::min(masters.size(), (q + 1) * batch); ++l) {
      const std::size_t m = masters[l];
      grid.visit(place_[m], reach_[m] + skin, [&](Index k, S squared) {
        if (pair.excluded && pair.excluded(particle[slaves[k]], particle[m])) return;
        found[q].push_back({k, static_cast<Index>(m), std::sqrt(squared) - reach_[m]});
      });
    }
  });
  // Masters ascend from batch to batch, so they ascend within every row.
  std::vector<std::size_t> count(slaves.size() + 1, 0);
  std::vector<S> gap(slaves.size(), far);
  for (const auto& list : found)
    for (const Near& near : list) {
      ++count[near.slave + 1];
      gap[near.slave] = std::min(gap[near.slave], near.gap);
    }
  const std::size_t first = candidate_member_.size();
  for (std::size_t k = 0; k < slaves.size(); ++k) {
    if (count[k + 1] > 0) rows.push_back({particle[slaves[k]], 0, s, first + count[k], gap[k]});
    count[k + 1] += count[k];
  }
  candidate_member_.resize(first + count.back());
  for (const auto& list : found)
    for (const Near& near : list) candidate_member_[first + count[near.slave]++] = near.slot_member;
}

template <class S, int D>
void Candidates<S, D>::transpose() {
  const std::size_t row_count = rows.size() - 1;
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> slot_of_member(particle.size(), none);
  for (const Index m : candidate_member_) slot_of_member[m] = 0;
  slot_particle.clear();
  for (std::size_t m = 0; m < particle.size(); ++m)
    if (slot_of_member[m] != none) {
      slot_of_member[m] = static_cast<Index>(slot_particle.size());
      slot_particle.push_back(particle[m]);
    }
  slot_of.resize(candidate_member_.size());
  slot_begin.assign(slot_particle.size() + 1, 0);
  for (std::size_t k = 0; k < slot_of.size(); ++k) {
    slot_of[k] = slot_of_member[candidate_member_[k]];
    ++slot_begin[slot_of[k] + 1];
  }
  for (std::size_t l = 0; l < slot_particle.size(); ++l) slot_begin[l + 1] += slot_begin[l];
  slot_entries.resize(slot_of.size());
  std::vector<std::size_t> next(slot_begin.begin(), slot_begin.end() - 1);
  for (std::size_t r = 0; r < row_count; ++r)
    for (std::size_t k = rows[r].begin; k < rows[r + 1].begin; ++k)
      slot_entries[next[slot_of[k]]++] = {static_cast<Index>(r), static_cast<Index>(k)};

  // Each particle once, with all its rows and slots: the only place where its force is written.
  std::vector<std::uint8_t> flags_of(largest_ + 1, 0);
  for (std::size_t m = 0; m < particle.size(); ++m)
    flags_of[particle[m]] = static_cast<std::uint8_t>(flags_of[particle[m]] | flags[m]);
  std::vector<Index> touched_of(largest_ + 1, none);
  for (std::size_t r = 0; r < row_count; ++r) touched_of[rows[r].particle] = 0;
  for (const Index i : slot_particle) touched_of[i] = 0;
  touched.clear();
  for (std::size_t i = 0; i <= largest_; ++i)
    if (touched_of[i] != none) {
      touched_of[i] = static_cast<Index>(touched.size());
      touched.push_back({static_cast<Index>(i), flags_of[i], 0, 0});
    }
  slot_touched.resize(slot_particle.size());
  for (std::size_t r = 0; r < row_count; ++r) ++touched[rows[r].touched = touched_of[rows[r].particle]].rows;
  for (std::size_t l = 0; l < slot_particle.size(); ++l)
    ++touched[slot_touched[l] = touched_of[slot_particle[l]]].slots;
  std::size_t row_end = 0, slot_end = 0;
  for (Touched& t : touched) {
    row_end += t.rows;
    t.rows = row_end - t.rows;
    slot_end += t.slots;
    t.slots = slot_end - t.slots;
  }
  touched_rows.resize(row_end);
  touched_slots.resize(slot_end);
  // Filling moves each begin on to its end, which is where the next one begins.
  for (std::size_t r = 0; r < row_count; ++r) touched_rows[touched[rows[r].touched].rows++] = static_cast<Index>(r);
  for (std::size_t l = 0; l < slot_particle.size(); ++l)
    touched_slots[touched[slot_touched[l]].slots++] = static_cast<Index>(l);
}

}  // namespace hmps::detail
