// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/candidates.hpp"
#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Numbers the particles of all organs once each, and cuts the members into chunks.
template <class S, int D, Metaball Ball>
void Candidates<S, D, Ball>::number() {
  organs_.number_particles();
  const std::size_t count = particle().size();
  awake_of_.assign(count, none);
  place_.assign(count, Point::Zero());
  drift_.assign(count, Point::Zero());
  metric_.assign(count, Matrix<S, D>::Identity());
  reach_.assign(count, S(0));
  compression_.assign(count, S(-1));
  bound_.assign(count, S(0));
  travel_.assign(count, S(0));
  strain_.assign(count, S(0));
  allowance_.assign(count, S(0));
  exceeding_.resize(count);
  watches_.resize((count + chunk - 1) / chunk);
  const auto& organs = organs_.organs();
  motion_.assign(organs.size(), OrganMotion{Point::Zero(), 0, 0});
  for (std::size_t o = 0; o < organs.size(); ++o)
    for (std::size_t m = organs[o].begin; m < organs[o].end; m += chunk)
      parts_.push_back({o, m, std::min(m + chunk, organs[o].end), 0, 0, Point::Zero()});
}

/// Builds the outer list from the places and reaches of the latest check.
template <class S, int D, Metaball Ball>
template <class E>
void Candidates<S, D, Ball>::build(const E& execute) {
  built_place_ = place_;
  built_reach_ = reach_;
  motion_.assign(motion_.size(), OrganMotion{Point::Zero(), 0, 0});
  outer_rows_.clear();
  outer_master_.clear();
  for (std::size_t s = 0; s < sides().size(); ++s) build_side(static_cast<std::uint32_t>(s), execute);
  require(outer_master_.size() < none, "hmps: ", outer_master_.size(),
          " candidates for contact are more than a 32-bit index can number; name fewer slaves and masters");
  outer_rows_.push_back({0, 0, 0, static_cast<Index>(outer_master_.size()), 0, 0, 0});
  kept_master_.resize(outer_master_.size());
  list_rows_of_particles();
  built_ = true;
  ++rebuilds;
}

template <class S, int D, Metaball Ball>
template <class E>
void Candidates<S, D, Ball>::build_side(std::uint32_t s, const E& execute) {
  const OrganPairs::Side& side = sides()[s];
  const auto &a = organs_.organs()[side.slaves], &b = organs_.organs()[side.masters];
  const OrganPairs::Pair& pair = organs_.pairs()[side.pair];
  const auto is_wall = [&](const OrganPairs::Member& member) {
    return (member.flags & is_master) && compression_[member.number] > 0;
  };
  // Only what lies in the other's box, grown by what it reaches, is looked at.
  constexpr S far = std::numeric_limits<S>::max() / S(4);
  Point low = Point::Constant(far), high = -low, low_a = low, high_a = high;
  S widest = 0;
  for (std::size_t m = b.begin; m < b.end; ++m)
    if (is_wall(members()[m])) {
      const Index j = members()[m].number;
      low = low.cwiseMin(place_[j]);
      high = high.cwiseMax(place_[j]);
      widest = std::max(widest, reach_[j]);
    }
  std::vector<Index> slaves, slot, masters;
  for (std::size_t m = a.begin; m < a.end; ++m) {
    const Index i = members()[m].number;
    if (!(members()[m].flags & is_slave)) continue;
    if (!pair.may_be_slave(particle()[i])) continue;
    low_a = low_a.cwiseMin(place_[i]);
    high_a = high_a.cwiseMax(place_[i]);
    const Point out = (low - place_[i]).cwiseMax(place_[i] - high);
    if (out.maxCoeff() > widest + margin_) continue;
    slaves.push_back(i);
    slot.push_back(static_cast<Index>(side.first_slot + m - a.begin));
  }
  // Organs far apart bear as much motion as lies between them; all slaves excluded: any.
  const S apart = low_a[0] <= high_a[0] ? (low - high_a).cwiseMax(low_a - high).maxCoeff() - widest : far;
  limit_[s] = S(0.999) * std::max(margin_, apart);
  if (slaves.empty()) return;
  Point low_s = Point::Constant(far), high_s = -low_s;
  for (const Index i : slaves) {
    low_s = low_s.cwiseMin(place_[i]);
    high_s = high_s.cwiseMax(place_[i]);
  }
  for (std::size_t m = b.begin; m < b.end; ++m) {
    const Index j = members()[m].number;
    const Point out = (low_s - place_[j]).cwiseMax(place_[j] - high_s);
    if (is_wall(members()[m]) && out.maxCoeff() <= reach_[j] + margin_) masters.push_back(j);
  }
  Grid<S, D> grid;
  grid.build(slaves.size(), radius_ + margin_, [&](std::size_t k) { return place_[slaves[k]]; });
  constexpr std::size_t batch = 256;
  std::vector<std::vector<Near>> found((masters.size() + batch - 1) / batch);
  execute(found.size(), [&](std::size_t q) {
    for (std::size_t l = q * batch; l < std::min(masters.size(), (q + 1) * batch); ++l) {
      const Index j = masters[l];
      grid.visit(place_[j], reach_[j] + margin_, [&](Index k, S) {
        if (!pair.excluded || !pair.excluded(particle()[slaves[k]], particle()[j])) found[q].push_back({k, j});
      });
    }
  });
  // Masters ascend from batch to batch, so they ascend within every row.
  std::vector<std::size_t> count(slaves.size() + 1, 0);
  for (const auto& list : found)
    for (const Near& near : list) ++count[near.slave + 1];
  const std::size_t first = outer_master_.size();
  for (std::size_t k = 0; k < slaves.size(); ++k) {
    if (count[k + 1] > 0) outer_rows_.push_back({slaves[k], s, slot[k], static_cast<Index>(first + count[k]), 0, 0, 0});
    count[k + 1] += count[k];
  }
  outer_master_.resize(first + count.back());
  for (const auto& list : found)
    for (const Near& near : list) outer_master_[first + count[near.slave]++] = near.master;
}

template <class S, int D, Metaball Ball>
void Candidates<S, D, Ball>::list_rows_of_particles() {
  const auto each = [&](auto&& visit) {
    for (std::size_t r = 0; r + 1 < outer_rows_.size(); ++r) {
      visit(outer_rows_[r].slave, r);
      for (Index k = outer_rows_[r].begin; k < outer_rows_[r + 1].begin; ++k) visit(outer_master_[k], r);
    }
  };
  rows_of_begin_.assign(particle().size() + 1, 0);
  each([&](Index i, std::size_t) { ++rows_of_begin_[i + 1]; });
  for (std::size_t i = 0; i < particle().size(); ++i) rows_of_begin_[i + 1] += rows_of_begin_[i];
  rows_of_.resize(rows_of_begin_.back());
  next_.assign(rows_of_begin_.begin(), rows_of_begin_.end() - 1);
  each([&](Index i, std::size_t r) { rows_of_[next_[i]++] = static_cast<Index>(r); });
}

}  // namespace hmps::inline HMPS_ABI::detail
