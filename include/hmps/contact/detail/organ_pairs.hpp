// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hmps/contact/organ.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/cell_volume.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The roles of a particle in an organ, as bits.
enum : std::uint8_t { is_slave = 1, is_master = 2, is_prescribed = 4 };

/// The organs of a scene and the pairs that may touch: declared once, without any state.
///
/// A member is a particle in one organ. Members are stored organ by organ, sorted by particle within each. All
/// particles that are members are numbered once, in the order of their indices. A side is an ordered pair of organs:
/// the slaves of one at the wall of the other.
template <class R>
class BasicOrganPairs {
 public:
  struct OrganRange {
    std::string name;
    std::size_t begin, end;  // of members
  };
  struct Pair {
    std::size_t first, second;
    std::vector<Index> excluded_slaves;  // ascending
    std::function<bool(Index, Index)> excluded;
    [[nodiscard]] bool may_be_slave(Index particle) const {
      return !std::binary_search(excluded_slaves.begin(), excluded_slaves.end(), particle);
    }
  };
  struct Side {
    std::size_t slaves, masters;  // organs
    std::size_t pair;
    std::size_t first_slot;  // each of its slaves has a slot, for what contact remembers of it from call to call
  };
  struct Member {
    Index particle, number;
    std::uint8_t flags;
    R radius;  // r_0 in m of a slave
    R volume;  // over l0^D
  };

  /// Returns the number of the organ, in `dimensions`. Throws `InputError` if it is empty, for a slave whose radius is
  /// below a fiftieth or above three quarters of `spacing` (m), and for a volume that is not one of a particle.
  std::size_t add_organ(const Organ& organ, double spacing, int dimensions = 3);
  /// Returns the number of the pair. Throws `InputError` as `MetaballContact::add_pair` says.
  std::size_t add_pair(std::size_t a, std::size_t b, const PairSettings& settings);
  /// Numbers the particles. Call it after the last organ has been added. Throws `InputError` if two organs give a
  /// particle different volumes.
  void number_particles();

  [[nodiscard]] const std::vector<OrganRange>& organs() const { return organs_; }
  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }
  [[nodiscard]] const std::vector<Side>& sides() const { return sides_; }
  [[nodiscard]] const std::vector<Member>& members() const { return members_; }
  /// The particles by number, ascending, and their roles in any organ.
  [[nodiscard]] const std::vector<Index>& particle() const { return particle_; }
  [[nodiscard]] const std::vector<std::uint8_t>& flags() const { return flags_; }
  /// Their volumes over l0^D.
  [[nodiscard]] const std::vector<double>& volume() const { return volume_; }
  /// The least of these volumes, or 1 if that is less.
  [[nodiscard]] double least_volume() const { return least_volume_; }
  /// r_0 in m of the slave of a side at `slot`.
  [[nodiscard]] double slave_radius(std::size_t side, std::size_t slot) const {
    return members_[organs_[sides_[side].slaves].begin + slot - sides_[side].first_slot].radius;
  }
  /// Number of slots of all sides.
  [[nodiscard]] std::size_t slots() const { return slots_; }

  /// Throws `InputError` unless views of `size` particles hold all that organs name.
  void require_particles(std::size_t size) const {
    require(size >= views_, "hmps: an organ names particle ", views_ - 1, " but the views hold ", size,
            " particles; indices count from 0 over all particles");
  }
  /// The members of organ `o`, ascending.
  [[nodiscard]] std::span<const Member> members_of(std::size_t o) const {
    return {members_.data() + organs_[o].begin, organs_[o].end - organs_[o].begin};
  }
  /// The particles of organ `o` in `role`, ascending.
  [[nodiscard]] std::vector<Index> particles_of(std::size_t o, std::uint8_t role) const {
    std::vector<Index> particles;
    for (const Member& member : members_of(o))
      if (member.flags & role) particles.push_back(member.particle);
    return particles;
  }
  /// Calls `visit(member)` for each member of organ `o` that forces move.
  template <class Visit>
  void for_each_movable(std::size_t o, Visit&& visit) const {
    for (const Member& member : members_of(o))
      if (!(member.flags & is_prescribed)) visit(member);
  }

 private:
  [[nodiscard]] bool is_slave_of(std::size_t o, Index particle) const {
    const auto first = members_.begin() + static_cast<std::ptrdiff_t>(organs_[o].begin),
               last = members_.begin() + static_cast<std::ptrdiff_t>(organs_[o].end);
    const auto at = std::lower_bound(first, last, particle, [](const Member& m, Index i) { return m.particle < i; });
    return at != last && at->particle == particle && (at->flags & is_slave) != 0;
  }
  [[nodiscard]] static double checked_radius(const Organ& organ, Index slave, double spacing);
  [[nodiscard]] static double checked_volume(const Organ& organ, Index particle, double spacing, int dimensions);
  void check_side(std::size_t slaves, std::size_t masters, const Pair& pair) const;
  [[nodiscard]] std::vector<Index> common(std::size_t a, std::size_t b, std::uint8_t role) const;

  std::vector<OrganRange> organs_;
  std::vector<Pair> pairs_;
  std::vector<Side> sides_;
  std::vector<Member> members_;
  std::vector<Index> particle_;
  std::vector<std::uint8_t> flags_;
  std::vector<double> volume_;
  std::size_t slots_ = 0, views_ = 0;
  double least_volume_ = 1;
};
/// A template, so that only programs with contact compile it.
using OrganPairs = BasicOrganPairs<double>;

template <class R>
std::size_t BasicOrganPairs<R>::add_organ(const Organ& organ, double spacing, int dimensions) {
  require(!organ.slaves.empty() || !organ.masters.empty(), "hmps: organ '", organ.name,
          "' has neither slaves nor masters; give the indices of its surface particles");
  std::vector<std::pair<Index, std::uint8_t>> all;
  for (const Index i : organ.slaves) all.emplace_back(i, is_slave);
  for (const Index i : organ.masters) all.emplace_back(i, is_master);
  std::sort(all.begin(), all.end());
  require(all.back().first != no_index, "hmps: organ '", organ.name, "' names particle ", no_index,
          ", which is not a valid index");
  const ParticleSet* const prescribed_set = set_in(organ.prescribed);
  require(prescribed_set == nullptr || all.back().first < prescribed_set->scene_size(), "hmps: organ '", organ.name,
          "' names particle ", all.back().first, ", but its set of prescribed particles is for a scene of ",
          prescribed_set == nullptr ? 0 : prescribed_set->scene_size(), " particles; make the set for all particles");
  std::vector<Member> own;
  for (auto at = all.begin(); at != all.end();) {
    const Index i = at->first;
    const double radius = organ.radius && at->second == is_slave ? checked_radius(organ, i, spacing) : spacing / 2;
    auto flags = static_cast<std::uint8_t>(organ.prescribed && organ.prescribed(i) ? is_prescribed : 0);
    for (; at != all.end() && at->first == i; ++at) flags = static_cast<std::uint8_t>(flags | at->second);
    const double volume = organ.volume ? checked_volume(organ, i, spacing, dimensions) : 1;
    least_volume_ = std::min(least_volume_, volume);
    own.push_back({i, no_index, flags, radius, volume});
  }
  views_ = std::max(views_, static_cast<std::size_t>(all.back().first) + 1);
  organs_.push_back({organ.name, members_.size(), members_.size() + own.size()});
  members_.insert(members_.end(), own.begin(), own.end());
  return organs_.size() - 1;
}

template <class R>
double BasicOrganPairs<R>::checked_radius(const Organ& organ, Index slave, double spacing) {
  constexpr double most = 0.75;   // half of the widest layers that `fit_particles` makes
  constexpr double least = 0.02;  // below half of its closest
  const double radius = organ.radius(slave);
  require(is_finite(radius) && radius >= least * spacing && radius <= most * spacing, "hmps: slave ", slave,
          " of organ '", organ.name, "' has a radius of ", radius, " m; give about half the spacing of ", spacing,
          " m, a length from ", least * spacing, " to ", most * spacing, " m");
  return radius;
}

template <class R>
double BasicOrganPairs<R>::checked_volume(const Organ& organ, Index particle, double spacing, int dimensions) {
  const double volume = organ.volume(particle), cell = std::pow(spacing, dimensions), share = volume / cell;
  require(is_finite(share) && share * volume_factor_of_bonds > 1 && share < volume_factor_of_bonds, "hmps: particle ",
          particle, " of organ '", organ.name, "' has a volume of ", volume, " m", dimensions,
          ", but a cube of the spacing of ", spacing, " m has ", cell, " m", dimensions,
          "; give the volume of this one particle, in metres");
  return share;
}

template <class R>
std::size_t BasicOrganPairs<R>::add_pair(std::size_t a, std::size_t b, const PairSettings& settings) {
  for (const std::size_t o : {a, b})
    require(o < organs_.size(), "hmps: organ ", o, " of a contact pair does not exist; only ", organs_.size(),
            " organs were added, numbered from 0");
  require(a != b, "hmps: organ '", organs_[a].name, "' is paired with itself; contact is between different organs");
  for (std::size_t m = organs_[a].begin, k = organs_[b].begin; m < organs_[a].end && k < organs_[b].end;) {
    require(members_[m].particle != members_[k].particle, "hmps: particle ", members_[m].particle, " is in both '",
            organs_[a].name, "' and '", organs_[b].name, "'; a pair needs organs without common particles");
    members_[m].particle < members_[k].particle ? ++m : ++k;
  }
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    require(!(pairs_[p].first == a && pairs_[p].second == b) && !(pairs_[p].first == b && pairs_[p].second == a),
            "hmps: organs '", organs_[a].name, "' and '", organs_[b].name, "' are already contact pair ", p,
            "; declare a pair once (the order does not matter), or its forces count twice");
  std::vector<Index> excluded(settings.excluded_slaves.begin(), settings.excluded_slaves.end());
  std::sort(excluded.begin(), excluded.end());
  for (const Index i : excluded)
    require(is_slave_of(a, i) || is_slave_of(b, i), "hmps: particle ", i, " is excluded from the contact of '",
            organs_[a].name, "' and '", organs_[b].name, "' but is a slave of neither; give indices of their slaves");
  const Pair pair{a, b, std::move(excluded), settings.excluded};
  const bool first = settings.roles != Roles::only_second_is_slave,
             second = settings.roles != Roles::only_first_is_slave;
  const auto all_excluded = [&](std::size_t o) {
    const std::vector<Index> slaves = particles_of(o, is_slave);
    return std::none_of(slaves.begin(), slaves.end(), [&](Index i) { return pair.may_be_slave(i); });
  };
  require(pair.excluded_slaves.empty() || (first && !all_excluded(a)) || (second && !all_excluded(b)),
          "hmps: all slaves of '", organs_[a].name, "' and '", organs_[b].name,
          "' that could touch are excluded; leave the pair out, or check the distance (m) given to exclude_attached");
  if (first) check_side(a, b, pair);
  if (second) check_side(b, a, pair);
  pairs_.push_back(pair);
  const auto add_side = [&](std::size_t slaves, std::size_t masters) {
    sides_.push_back({slaves, masters, pairs_.size() - 1, slots_});
    slots_ += organs_[slaves].end - organs_[slaves].begin;
  };
  if (first) add_side(a, b);
  if (second) add_side(b, a);
  return pairs_.size() - 1;
}

/// Throws `InputError` unless `slaves` has slaves and `masters` has masters, and if another side shares a slave and a
/// master with this one: they would push each other twice.
template <class R>
void BasicOrganPairs<R>::check_side(std::size_t slaves, std::size_t masters, const Pair& pair) const {
  const auto any = [&](std::size_t o, std::uint8_t role) {
    const auto members = members_of(o);
    return std::any_of(members.begin(), members.end(), [&](const Member& m) { return (m.flags & role) != 0; });
  };
  require(any(slaves, is_slave), "hmps: organ '", organs_[slaves].name, "' has no slaves but is to touch '",
          organs_[masters].name, "'; give it slaves, or choose `roles` in which only the other organ is slave");
  require(any(masters, is_master), "hmps: organ '", organs_[masters].name, "' has no masters but is to be touched by '",
          organs_[slaves].name, "'; give it masters, or choose `roles` in which only this organ is slave");
  for (const Side& side : sides_) {
    const Pair& other = pairs_[side.pair];
    std::vector<Index> common_slaves = common(slaves, side.slaves, is_slave);
    std::erase_if(common_slaves, [&](Index i) { return !pair.may_be_slave(i) || !other.may_be_slave(i); });
    if (common_slaves.empty()) continue;
    const std::vector<Index> common_masters = common(masters, side.masters, is_master);
    for (const Index i : common_slaves)
      for (const Index j : common_masters)
        require((pair.excluded && pair.excluded(i, j)) || (other.excluded && other.excluded(i, j)), "hmps: slave ", i,
                " would be pushed by master ", j, " twice: in the pair of '", organs_[slaves].name, "' and '",
                organs_[masters].name, "', and in that of '", organs_[side.slaves].name, "' and '",
                organs_[side.masters].name, "'; declare each body once, or exclude the slave from one of the pairs");
  }
}

/// The particles in `role` that organs `a` and `b` share, ascending.
template <class R>
std::vector<Index> BasicOrganPairs<R>::common(std::size_t a, std::size_t b, std::uint8_t role) const {
  std::vector<Index> particles;
  for (std::size_t m = organs_[a].begin, k = organs_[b].begin; m < organs_[a].end && k < organs_[b].end;) {
    const Member &one = members_[m], &other = members_[k];
    if (one.particle == other.particle && (one.flags & other.flags & role)) particles.push_back(one.particle);
    m += one.particle <= other.particle;
    k += other.particle <= one.particle;
  }
  return particles;
}

template <class R>
void BasicOrganPairs<R>::number_particles() {
  particle_.clear();
  for (const Member& member : members_) particle_.push_back(member.particle);
  std::sort(particle_.begin(), particle_.end());
  particle_.erase(std::unique(particle_.begin(), particle_.end()), particle_.end());
  flags_.assign(particle_.size(), 0);
  volume_.assign(particle_.size(), 0);
  for (Member& member : members_) {
    const auto found = std::lower_bound(particle_.begin(), particle_.end(), member.particle);
    member.number = static_cast<Index>(found - particle_.begin());
    flags_[member.number] = static_cast<std::uint8_t>(flags_[member.number] | member.flags);
    double& volume = volume_[member.number];
    constexpr double rounding = 1e-6;
    require(!(volume > 0) || std::abs(volume - member.volume) <= rounding * volume, "hmps: two organs give particle ",
            member.particle, " volumes of ", volume, " and ", member.volume, " l0^D; give it one volume");
    if (!(volume > 0)) volume = member.volume;
  }
}

}  // namespace hmps::inline HMPS_ABI::detail
