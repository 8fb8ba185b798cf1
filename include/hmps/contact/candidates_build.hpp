// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/candidates.hpp"
#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI::detail {

template <class S, int D, Metaball Ball>
std::size_t Candidates<S, D, Ball>::add_organ(const Organ& organ) {
  require(!organ.slaves.empty() || !organ.masters.empty(), "hmps: organ '", organ.name,
          "' has neither slaves nor masters; give the indices of its surface particles");
  std::vector<std::pair<Index, std::uint8_t>> all;
  for (const Index i : organ.slaves) all.emplace_back(i, is_slave);
  for (const Index i : organ.masters) all.emplace_back(i, is_master);
  std::sort(all.begin(), all.end());
  require(all.back().first != none, "hmps: organ '", organ.name, "' names particle ", none, ", which is no index");
  const std::size_t begin = members_.size();
  for (const auto& [i, role] : all) {
    if (members_.size() == begin || members_.back().particle != i) {
      const bool prescribed = organ.prescribed && organ.prescribed(i);
      members_.push_back({i, none, static_cast<std::uint8_t>(prescribed ? is_prescribed : 0)});
    }
    members_.back().flags = static_cast<std::uint8_t>(members_.back().flags | role);
  }
  particles_ = std::max(particles_, static_cast<std::size_t>(members_.back().particle) + 1);
  organs.push_back({organ.name, begin, members_.size(), Point::Zero(), 0, 0});
  parts_.clear();
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
    require(members_[m].particle != members_[k].particle, "hmps: particle ", members_[m].particle, " is in both '",
            organs[a].name, "' and '", organs[b].name, "'; a pair needs organs without common particles");
    members_[m].particle < members_[k].particle ? ++m : ++k;
  }
  for (std::size_t p = 0; p < pairs.size(); ++p)
    require(!(pairs[p].first == a && pairs[p].second == b) && !(pairs[p].first == b && pairs[p].second == a),
            "hmps: organs '", organs[a].name, "' and '", organs[b].name, "' already are contact pair ", p,
            "; declare a pair once (the order does not matter), or its forces count twice");
  std::vector<Index> excluded(settings.excluded_slaves.begin(), settings.excluded_slaves.end());
  std::sort(excluded.begin(), excluded.end());
  const Pair pair{a, b, std::move(excluded), settings.excluded};
  const bool first = settings.roles != Roles::only_second_is_slave,
             second = settings.roles != Roles::only_first_is_slave;
  if (first) check_side(a, b, pair);
  if (second) check_side(b, a, pair);
  pairs.push_back(pair);
  if (first) add_side(a, b);
  if (second) add_side(b, a);
  built_ = false;
  return pairs.size() - 1;
}

/// Throws `InputError` unless `slaves` has slaves and `masters` masters, and if another side has a slave and a master
/// of this one too: each would push the other twice.
template <class S, int D, Metaball Ball>
void Candidates<S, D, Ball>::check_side(std::size_t slaves, std::size_t masters, const Pair& pair) const {
  const auto any = [&](std::size_t o, std::uint8_t role) {
    for (std::size_t m = organs[o].begin; m < organs[o].end; ++m)
      if (members_[m].flags & role) return true;
    return false;
  };
  require(any(slaves, is_slave), "hmps: organ '", organs[slaves].name, "' has no slaves but is to touch '",
          organs[masters].name, "'; give it slaves, or let only the other be slave");
  require(any(masters, is_master), "hmps: organ '", organs[masters].name, "' has no masters but is to be touched by '",
          organs[slaves].name, "'; give it masters, or let only it be slave");
  for (const Side& side : sides) {
    const Pair& other = pairs[side.pair];
    std::vector<Index> common_slaves = common(slaves, side.slaves, is_slave);
    std::erase_if(common_slaves, [&](Index i) { return !may_be_slave(pair, i) || !may_be_slave(other, i); });
    if (common_slaves.empty()) continue;
    const std::vector<Index> common_masters = common(masters, side.masters, is_master);
    for (const Index i : common_slaves)
      for (const Index j : common_masters)
        require((pair.excluded && pair.excluded(i, j)) || (other.excluded && other.excluded(i, j)), "hmps: slave ", i,
                " would be pushed by master ", j, " twice: in the pair of '", organs[slaves].name, "' and '",
                organs[masters].name, "', and in that of '", organs[side.slaves].name, "' and '",
                organs[side.masters].name, "'; declare each body once, or exclude the slave from one of the pairs");
  }
}

/// The particles that organs `a` and `b` both have in `role`, ascending.
template <class S, int D, Metaball Ball>
std::vector<Index> Candidates<S, D, Ball>::common(std::size_t a, std::size_t b, std::uint8_t role) const {
  std::vector<Index> particles;
  for (std::size_t m = organs[a].begin, k = organs[b].begin; m < organs[a].end && k < organs[b].end;) {
    const Member &one = members_[m], &other = members_[k];
    if (one.particle == other.particle && (one.flags & other.flags & role)) particles.push_back(one.particle);
    m += one.particle <= other.particle;
    k += other.particle <= one.particle;
  }
  return particles;
}

template <class S, int D, Metaball Ball>
void Candidates<S, D, Ball>::add_side(std::size_t slaves, std::size_t masters) {
  sides.push_back({slaves, masters, pairs.size() - 1, seats, 0});
  seats += organs[slaves].end - organs[slaves].begin;
}

/// Numbers the particles of all organs once each, and cuts the members into chunks.
template <class S, int D, Metaball Ball>
void Candidates<S, D, Ball>::number() {
  particle_.clear();
  for (const Member& member : members_) particle_.push_back(member.particle);
  std::sort(particle_.begin(), particle_.end());
  particle_.erase(std::unique(particle_.begin(), particle_.end()), particle_.end());
  const std::size_t count = particle_.size();
  flags_.assign(count, 0);
  for (Member& member : members_) {
    const auto found = std::lower_bound(particle_.begin(), particle_.end(), member.particle);
    member.number = static_cast<Index>(found - particle_.begin());
    flags_[member.number] = static_cast<std::uint8_t>(flags_[member.number] | member.flags);
  }
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
  strayed_.resize(count);
  watches_.resize((count + chunk - 1) / chunk);
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
  for (OrganRange& organ : organs) {
    organ.moved.setZero();
    organ.motion = organ.growth = 0;
  }
  outer_rows_.clear();
  outer_master_.clear();
  for (std::size_t s = 0; s < sides.size(); ++s) build_side(static_cast<std::uint32_t>(s), execute);
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
  Side& side = sides[s];
  const OrganRange &a = organs[side.slaves], &b = organs[side.masters];
  const Pair& pair = pairs[side.pair];
  const auto is_wall = [&](const Member& member) {
    return (member.flags & is_master) && compression_[member.number] > 0;
  };
  // Only what lies in the other's box, grown by what it reaches, is looked at.
  constexpr S far = std::numeric_limits<S>::max() / S(4);
  Point low = Point::Constant(far), high = -low, low_a = low, high_a = high;
  S widest = 0;
  for (std::size_t m = b.begin; m < b.end; ++m)
    if (is_wall(members_[m])) {
      const Index j = members_[m].number;
      low = low.cwiseMin(place_[j]);
      high = high.cwiseMax(place_[j]);
      widest = std::max(widest, reach_[j]);
    }
  std::vector<Index> slaves, seat, masters;
  for (std::size_t m = a.begin; m < a.end; ++m) {
    const Index i = members_[m].number;
    if (!(members_[m].flags & is_slave)) continue;
    if (!may_be_slave(pair, particle_[i])) continue;
    low_a = low_a.cwiseMin(place_[i]);
    high_a = high_a.cwiseMax(place_[i]);
    const Point out = (low - place_[i]).cwiseMax(place_[i] - high);
    if (out.maxCoeff() > widest + margin_) continue;
    slaves.push_back(i);
    seat.push_back(static_cast<Index>(side.first_seat + m - a.begin));
  }
  // Organs far apart bear as much motion as lies between them; all slaves excluded: any.
  const S apart = low_a[0] <= high_a[0] ? (low - high_a).cwiseMax(low_a - high).maxCoeff() - widest : far;
  side.limit = S(0.999) * std::max(margin_, apart);
  if (slaves.empty()) return;
  Point low_s = Point::Constant(far), high_s = -low_s;
  for (const Index i : slaves) {
    low_s = low_s.cwiseMin(place_[i]);
    high_s = high_s.cwiseMax(place_[i]);
  }
  for (std::size_t m = b.begin; m < b.end; ++m) {
    const Index j = members_[m].number;
    const Point out = (low_s - place_[j]).cwiseMax(place_[j] - high_s);
    if (is_wall(members_[m]) && out.maxCoeff() <= reach_[j] + margin_) masters.push_back(j);
  }
  Grid<S, D> grid;
  grid.build(slaves.size(), radius_ + margin_, [&](std::size_t k) { return place_[slaves[k]]; });
  constexpr std::size_t batch = 256;
  std::vector<std::vector<Near>> found((masters.size() + batch - 1) / batch);
  execute(found.size(), [&](std::size_t q) {
    for (std::size_t l = q * batch; l < std::min(masters.size(), (q + 1) * batch); ++l) {
      const Index j = masters[l];
      grid.visit(place_[j], reach_[j] + margin_, [&](Index k, S) {
        if (!pair.excluded || !pair.excluded(particle_[slaves[k]], particle_[j])) found[q].push_back({k, j});
      });
    }
  });
  // Masters ascend from batch to batch, so they ascend within every row.
  std::vector<std::size_t> count(slaves.size() + 1, 0);
  for (const auto& list : found)
    for (const Near& near : list) ++count[near.slave + 1];
  const std::size_t first = outer_master_.size();
  for (std::size_t k = 0; k < slaves.size(); ++k) {
    if (count[k + 1] > 0) outer_rows_.push_back({slaves[k], s, seat[k], static_cast<Index>(first + count[k]), 0, 0, 0});
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
  rows_of_begin_.assign(particle_.size() + 1, 0);
  each([&](Index i, std::size_t) { ++rows_of_begin_[i + 1]; });
  for (std::size_t i = 0; i < particle_.size(); ++i) rows_of_begin_[i + 1] += rows_of_begin_[i];
  rows_of_.resize(rows_of_begin_.back());
  next_.assign(rows_of_begin_.begin(), rows_of_begin_.end() - 1);
  each([&](Index i, std::size_t r) { rows_of_[next_[i]++] = static_cast<Index>(r); });
}

}  // namespace hmps::inline HMPS_ABI::detail
