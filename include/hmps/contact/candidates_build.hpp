// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/candidates.hpp"

namespace hmps::detail {

template <class S, int D, Metaball Ball>
std::size_t Candidates<S, D, Ball>::add_organ(const Organ& organ) {
  require(!organ.slaves.empty() || !organ.masters.empty(), "hmps: organ '", organ.name,
          "' has neither slaves nor masters; give the indices of its surface particles");
  std::vector<std::pair<Index, std::uint8_t>> all;
  for (const Index i : organ.slaves) all.emplace_back(i, is_slave);
  for (const Index i : organ.masters) all.emplace_back(i, is_master);
  std::sort(all.begin(), all.end());
  require(all.back().first != none, "hmps: organ '", organ.name, "' names particle ", none, ", which is no index");
  const std::size_t begin = particle_.size();
  for (const auto& [i, role] : all) {
    if (particle_.size() == begin || particle_.back() != i) {
      particle_.push_back(i);
      flags_.push_back(organ.prescribed && organ.prescribed(i) ? is_prescribed : 0);
    }
    flags_.back() = static_cast<std::uint8_t>(flags_.back() | role);
  }
  particles_ = std::max(particles_, static_cast<std::size_t>(particle_.back()) + 1);
  organs.push_back({organ.name, begin, particle_.size(), Point::Zero(), 0, 0});
  partials_.clear();
  built_ = false;
  return organs.size() - 1;
}

template <class S, int D, Metaball Ball>
std::size_t Candidates<S, D, Ball>::add_pair(std::size_t a, std::size_t b, const PairSettings& settings) {
  for (const std::size_t o : {a, b})
    require(o < organs.size(), "hmps: organ ", o, " of a contact pair does not exist; only ", organs.size(),
            " organs were added, numbered from 0");
  require(a != b, "hmps: organ '", organs[a].name, "' is paired with itself; contact is between different organs");
  for (std::size_t m = organs[a].begin, k = organs[b].begin; m < organs[a].end && k < organs[b].end;) {
    require(particle_[m] != particle_[k], "hmps: particle ", particle_[m], " is in both '", organs[a].name, "' and '",
            organs[b].name, "'; a pair needs organs without common particles");
    particle_[m] < particle_[k] ? ++m : ++k;
  }
  std::vector<Index> excluded(settings.excluded_slaves.begin(), settings.excluded_slaves.end());
  std::sort(excluded.begin(), excluded.end());
  pairs.push_back({a, b, std::move(excluded), settings.excluded});
  if (settings.roles != Roles::only_second_is_slave) add_side(a, b);
  if (settings.roles != Roles::only_first_is_slave) add_side(b, a);
  built_ = false;
  return pairs.size() - 1;
}

template <class S, int D, Metaball Ball>
void Candidates<S, D, Ball>::add_side(std::size_t slaves, std::size_t masters) {
  const auto any = [&](std::size_t o, std::uint8_t role) {
    for (std::size_t m = organs[o].begin; m < organs[o].end; ++m)
      if (flags_[m] & role) return true;
    return false;
  };
  require(any(slaves, is_slave), "hmps: organ '", organs[slaves].name, "' has no slaves but is to touch '",
          organs[masters].name, "'; give it slaves, or let only the other be slave");
  require(any(masters, is_master), "hmps: organ '", organs[masters].name, "' has no masters but is to be touched by '",
          organs[slaves].name, "'; give it masters, or let only it be slave");
  sides.push_back({slaves, masters, pairs.size() - 1, 0});
}

/// Numbers the particles of all organs once each, and cuts the members into chunks.
template <class S, int D, Metaball Ball>
void Candidates<S, D, Ball>::number() {
  std::vector<Index> order(particle_.size());
  for (std::size_t m = 0; m < order.size(); ++m) order[m] = static_cast<Index>(m);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return particle_[a] < particle_[b]; });
  unique_.resize(particle_.size());
  unique_particle_.clear();
  unique_flags_.clear();
  for (const Index m : order) {
    if (unique_particle_.empty() || unique_particle_.back() != particle_[m]) {
      unique_particle_.push_back(particle_[m]);
      unique_flags_.push_back(0);
    }
    unique_[m] = static_cast<Index>(unique_particle_.size() - 1);
    unique_flags_.back() = static_cast<std::uint8_t>(unique_flags_.back() | flags_[m]);
  }
  touched_of_.assign(unique_particle_.size(), none);
  slot_of_member_.assign(particle_.size(), none);
  place_.assign(particle_.size(), Point::Zero());
  reach_.assign(particle_.size(), S(0));
  compression_.assign(particle_.size(), S(-1));
  partials_.clear();
  for (std::size_t o = 0; o < organs.size(); ++o)
    for (std::size_t m = organs[o].begin; m < organs[o].end; m += chunk)
      partials_.push_back({o, m, std::min(m + chunk, organs[o].end), 0, 0, 0, 0, 0, Point::Zero()});
}

/// Builds the outer lists from the places and reaches of the latest check.
template <class S, int D, Metaball Ball>
template <class E>
void Candidates<S, D, Ball>::build(const E& execute) {
  built_place_ = place_;
  built_reach_ = reach_;
  for (OrganRange& organ : organs) {
    organ.moved.setZero();
    organ.motion = organ.growth = 0;
  }
  outer_rows_.clear();
  outer_member_.clear();
  for (std::size_t s = 0; s < sides.size(); ++s) build_side(static_cast<std::uint32_t>(s), execute);
  require(outer_member_.size() < none, "hmps: ", outer_member_.size(),
          " candidates for contact are more than a 32-bit index can number; name fewer slaves and masters");
  outer_rows_.push_back({0, 0, 0, static_cast<Index>(outer_member_.size()), 0, 0, 0});
  kept_member_.resize(outer_member_.size());
  built_ = true;
  ++rebuilds;
}

template <class S, int D, Metaball Ball>
template <class E>
void Candidates<S, D, Ball>::build_side(std::uint32_t s, const E& execute) {
  Side& side = sides[s];
  const OrganRange &a = organs[side.slaves], &b = organs[side.masters];
  const Pair& pair = pairs[side.pair];
  // Only what lies in the other's box, grown by what it reaches, is looked at.
  constexpr S far = std::numeric_limits<S>::max() / S(4);
  Point low = Point::Constant(far), high = -low, low_a = low, high_a = high;
  S widest = 0;
  for (std::size_t m = b.begin; m < b.end; ++m)
    if (compression_[m] > 0) {
      low = low.cwiseMin(place_[m]);
      high = high.cwiseMax(place_[m]);
      widest = std::max(widest, reach_[m]);
    }
  std::vector<Index> slaves, masters;
  for (std::size_t m = a.begin; m < a.end; ++m) {
    if (!(flags_[m] & is_slave)) continue;
    if (std::binary_search(pair.excluded_slaves.begin(), pair.excluded_slaves.end(), particle_[m])) continue;
    low_a = low_a.cwiseMin(place_[m]);
    high_a = high_a.cwiseMax(place_[m]);
    const Point out = (low - place_[m]).cwiseMax(place_[m] - high);
    if (out.maxCoeff() <= widest + skin_) slaves.push_back(static_cast<Index>(m));
  }
  // Organs far apart bear as much motion as lies between them; all slaves excluded: any.
  const S apart = low_a[0] <= high_a[0] ? (low - high_a).cwiseMax(low_a - high).maxCoeff() - widest : far;
  side.limit = S(0.999) * std::max(skin_, apart);
  if (slaves.empty()) return;
  Point low_s = Point::Constant(far), high_s = -low_s;
  for (const Index m : slaves) {
    low_s = low_s.cwiseMin(place_[m]);
    high_s = high_s.cwiseMax(place_[m]);
  }
  for (std::size_t m = b.begin; m < b.end; ++m) {
    const Point out = (low_s - place_[m]).cwiseMax(place_[m] - high_s);
    if (compression_[m] > 0 && out.maxCoeff() <= reach_[m] + skin_) masters.push_back(static_cast<Index>(m));
  }
  Grid<S, D> grid;
  grid.build(slaves.size(), radius_ + skin_, [&](std::size_t k) { return place_[slaves[k]]; });
  constexpr std::size_t batch = 256;
  std::vector<std::vector<Near>> found((masters.size() + batch - 1) / batch);
  execute(found.size(), [&](std::size_t q) {
    for (std::size_t l = q * batch; l < std::min(masters.size(), (q + 1) * batch); ++l) {
      const Index m = masters[l];
      grid.visit(place_[m], reach_[m] + skin_, [&](Index k, S) {
        if (!pair.excluded || !pair.excluded(particle_[slaves[k]], particle_[m])) found[q].push_back({k, m});
      });
    }
  });
  // Masters ascend from batch to batch, so they ascend within every row.
  std::vector<std::size_t> count(slaves.size() + 1, 0);
  for (const auto& list : found)
    for (const Near& near : list) ++count[near.slave + 1];
  const std::size_t first = outer_member_.size();
  for (std::size_t k = 0; k < slaves.size(); ++k) {
    if (count[k + 1] > 0)
      outer_rows_.push_back(
          {particle_[slaves[k]], unique_[slaves[k]], s, static_cast<Index>(first + count[k]), slaves[k], 0, 0});
    count[k + 1] += count[k];
  }
  outer_member_.resize(first + count.back());
  for (const auto& list : found)
    for (const Near& near : list) outer_member_[first + count[near.slave]++] = near.master;
}

}  // namespace hmps::detail
