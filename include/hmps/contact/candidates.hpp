// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "hmps/contact/organ.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/neighbours/grid.hpp"

namespace hmps::detail {

/// Deformation gradients of undeformed or rigid particles.
template <class S, int D>
struct Undeformed {
  [[nodiscard]] Matrix<S, D> operator[](std::size_t) const { return Matrix<S, D>::Identity(); }
};

/// An upper bound of the largest singular value of F, exact in 2D and for equal stretches: mean plus
/// sqrt(D - 1) standard deviations of the eigenvalues of F^T F (Wolkowicz and Styan 1980).
template <class S, int D>
[[nodiscard]] S stretch_bound(const Matrix<S, D>& F) {
  const Matrix<S, D> C = F.transpose() * F;
  const S mean = C.trace() / S(D);
  const S variance = (C - mean * Matrix<S, D>::Identity()).squaredNorm() / S(D);
  return std::sqrt(mean + std::sqrt(S(D - 1) * variance));
}

/// Which slaves may meet which masters: kept valid, as supersets of what touches, while particles move.
/// A row is a slave of one side (ordered pair of organs) that has candidates; a slot is a particle that
/// is a master of some row.
template <class S, int D>
class Candidates {
 public:
  using Point = Vector<S, D>;
  static constexpr std::uint8_t is_slave = 1, is_master = 2, is_prescribed = 4;

  struct OrganRange {
    std::string name;
    std::size_t begin, end;
    Point shift, moved;  // common displacement that is taken off, and its latest value
    S motion, growth;    // largest displacement beyond `shift`, largest growth of a reach
  };
  struct Side {
    std::size_t slaves, masters;  // organs
    std::size_t pair;
    S limit;  // motion that the lists bear
    S motion;
  };
  struct Pair {
    std::size_t first, second;
    std::vector<Index> excluded_slaves;
    std::function<bool(Index, Index)> excluded;
  };
  struct Row {
    Index particle, touched;
    std::uint32_t side;
    std::size_t begin;
    S gap;  // no candidate reaches the slave before this much motion
  };
  struct Touched {
    Index particle;
    std::uint8_t flags;
    std::size_t rows, slots;  // ends in touched_rows, touched_slots
  };
  struct Entry {
    Index row, candidate;
  };

  // Of members (a particle in an organ), organ after organ, sorted by particle.
  std::vector<Index> particle;
  std::vector<std::uint8_t> flags;
  std::vector<OrganRange> organs;
  std::vector<Pair> pairs;
  std::vector<Side> sides;

  std::vector<Row> rows;       // with one more at the end for `begin`
  std::vector<Index> slot_of;  // per candidate
  std::vector<Index> slot_particle, slot_touched;
  std::vector<std::size_t> slot_begin;  // into slot_entries
  std::vector<Entry> slot_entries;      // what refers to a slot, rows ascending
  std::vector<Touched> touched;
  std::vector<Index> touched_rows, touched_slots;
  std::size_t rebuilds = 0;

  std::size_t add_organ(const Organ& organ) {
    require(!organ.slaves.empty() || !organ.masters.empty(), "hmps: organ '", organ.name,
            "' has neither slaves nor masters; give the indices of its surface particles");
    std::vector<std::pair<Index, std::uint8_t>> all;
    for (const Index i : organ.slaves) all.emplace_back(i, is_slave);
    for (const Index i : organ.masters) all.emplace_back(i, is_master);
    std::sort(all.begin(), all.end());
    const std::size_t begin = particle.size();
    for (const auto& [i, role] : all) {
      if (particle.size() == begin || particle.back() != i) {
        particle.push_back(i);
        flags.push_back(organ.prescribed && organ.prescribed(i) ? is_prescribed : 0);
      }
      flags.back() = static_cast<std::uint8_t>(flags.back() | role);
      largest_ = std::max(largest_, static_cast<std::size_t>(i));
    }
    organs.push_back({organ.name, begin, particle.size(), Point::Zero(), Point::Zero(), 0, 0});
    built_ = false;
    return organs.size() - 1;
  }

  std::size_t add_pair(std::size_t a, std::size_t b, const PairSettings& settings) {
    for (const std::size_t o : {a, b})
      require(o < organs.size(), "hmps: organ ", o, " of a contact pair does not exist; add_organ returned 0 to ",
              organs.size(), " - 1");
    require(a != b, "hmps: organ '", organs[a].name, "' is paired with itself; contact is between different organs");
    for (std::size_t m = organs[a].begin, k = organs[b].begin; m < organs[a].end && k < organs[b].end;) {
      require(particle[m] != particle[k], "hmps: particle ", particle[m], " is in both '", organs[a].name, "' and '",
              organs[b].name, "'; a pair needs organs without common particles");
      particle[m] < particle[k] ? ++m : ++k;
    }
    std::vector<Index> excluded(settings.excluded_slaves.begin(), settings.excluded_slaves.end());
    std::sort(excluded.begin(), excluded.end());
    pairs.push_back({a, b, std::move(excluded), settings.excluded});
    if (settings.roles != Roles::only_second_is_slave) add_side(a, b);
    if (settings.roles != Roles::only_first_is_slave) add_side(b, a);
    built_ = false;
    return pairs.size() - 1;
  }

  void refresh() { built_ = false; }
  [[nodiscard]] std::size_t largest_particle() const { return largest_; }

  /// Measures how far everything moved and builds the lists anew where they no longer hold.
  template <class X, class Gradients, class E>
  void update(const X& x, const Gradients& F, S radius, S skin, const E& execute) {
    if (built_) {
      measure(x, F, radius, execute);
      for (Side& side : sides) {
        const OrganRange &a = organs[side.slaves], &b = organs[side.masters];
        side.motion = a.motion + b.motion + (a.shift - b.shift).norm() + b.growth;
        if (!(side.motion < side.limit)) built_ = false;
      }
    }
    if (!built_) build(x, F, radius, skin, execute);
  }

 private:
  static constexpr std::size_t chunk = 512;
  struct Partial {
    std::size_t organ, begin, end;
    S motion, growth;
    Point sum;
  };

  void add_side(std::size_t slaves, std::size_t masters) {
    const auto any = [&](std::size_t o, std::uint8_t role) {
      return std::any_of(flags.begin() + static_cast<std::ptrdiff_t>(organs[o].begin),
                         flags.begin() + static_cast<std::ptrdiff_t>(organs[o].end),
                         [&](std::uint8_t f) { return (f & role) != 0; });
    };
    require(any(slaves, is_slave), "hmps: organ '", organs[slaves].name, "' has no slaves but is to touch '",
            organs[masters].name, "'; give it slaves, or let only the other be slave");
    require(any(masters, is_master), "hmps: organ '", organs[masters].name,
            "' has no masters but is to be touched by '", organs[slaves].name,
            "'; give it masters, or let only it be slave");
    sides.push_back({slaves, masters, pairs.size() - 1, 0, 0});
  }

  template <class X, class Gradients, class E>
  void measure(const X& x, const Gradients& F, S radius, const E& execute) {
    for (OrganRange& organ : organs) organ.shift = organ.moved;
    execute(partials_.size(), [&](std::size_t q) {
      Partial& part = partials_[q];
      const Point shift = organs[part.organ].shift;
      S motion = 0, growth = 0;
      Point sum = Point::Zero();
      for (std::size_t m = part.begin; m < part.end; ++m) {
        const Point u = x[particle[m]].template cast<S>() - place_[m];
        sum += u;
        motion = std::max(motion, (u - shift).squaredNorm());
        if (flags[m] & is_master)
          growth = std::max(growth, radius * stretch_bound<S, D>(F[particle[m]].template cast<S>()) - reach_[m]);
      }
      part.motion = motion;
      part.growth = growth;
      part.sum = sum;
    });
    for (OrganRange& organ : organs) {
      organ.motion = organ.growth = 0;
      organ.moved.setZero();
    }
    for (const Partial& part : partials_) {
      OrganRange& organ = organs[part.organ];
      organ.motion = std::max(organ.motion, part.motion);
      organ.growth = std::max(organ.growth, part.growth);
      organ.moved += part.sum;
    }
    for (OrganRange& organ : organs) {
      organ.motion = std::sqrt(organ.motion);
      organ.moved /= static_cast<S>(organ.end - organ.begin);
      // A NaN slips through the maxima but not through the sum.
      if (!std::isfinite(organ.moved.sum())) fail(x, organ);
    }
  }

  template <class X>
  void fail(const X& x, const OrganRange& organ) const {
    for (std::size_t m = organ.begin; m < organ.end; ++m)
      for (int c = 0; c < D; ++c)
        if (!std::isfinite(x(particle[m], c)))
          throw StateError(message("hmps: contact found component ", c, " of the position of particle ", particle[m],
                                   " of '", organ.name, "' to be ", x(particle[m], c),
                                   "; the run has become unstable: try a shorter step or a softer penalty"));
    throw StateError(message("hmps: the positions of '", organ.name, "' overflow; the run has become unstable"));
  }

  template <class X, class Gradients, class E>
  void build(const X& x, const Gradients& F, S radius, S skin, const E& execute);
  template <class E>
  void build_side(std::uint32_t s, S radius, S skin, const E& execute);
  void transpose();

  struct Near {
    Index slave, slot_member;
    S gap;
  };
  std::vector<Point> place_;  // per member, when the lists were built
  std::vector<S> reach_;
  std::vector<Partial> partials_;
  std::vector<Index> candidate_member_;
  std::size_t largest_ = 0;
  bool built_ = false;
};

}  // namespace hmps::detail

#include "hmps/contact/candidates_build.hpp"
