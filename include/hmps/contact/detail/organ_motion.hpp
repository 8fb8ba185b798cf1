// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hmps/contact/detail/organ_pairs.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// How far organs have moved, and the reaches of their masters have grown, since the broad-phase list was built: how
/// much of the list's margin is used up. Two organs that move together use none of it, so the mean displacement of an
/// organ is counted separately from the motion of its members relative to that mean.
template <class S, int D>
class OrganMotion {
 public:
  using Point = Vector<S, D>;

  /// Starts anew with the members of `organs`, whose particles must be numbered.
  void resize(const OrganPairs& organs);
  /// Takes the places and reaches (m, one per numbered particle) from which the broad-phase list was built.
  void restart(const std::vector<Point>& place, const std::vector<S>& reach);
  /// Measures the motion since `restart`. Throws `StateError` if a place is not finite.
  template <class E>
  void measure(const OrganPairs& organs, const std::vector<Point>& place, const std::vector<S>& reach,
               const E& execute);

  /// How much (m) a slave and a master of `side` may have approached each other, plus how much the master's reach may
  /// have grown, since `restart`.
  [[nodiscard]] S used(const OrganPairs::Side& side) const {
    const Motion &a = motion_[side.slaves], &b = motion_[side.masters];
    return a.beside + b.beside + (a.mean - b.mean).norm() + b.growth;
  }

 private:
  static constexpr std::size_t chunk = 512;
  struct Motion {      // of an organ
    Point mean;        // displacement
    S beside, growth;  // largest displacement relative to the mean, largest growth of a reach
  };
  struct Part {  // of an organ's members
    std::size_t organ, begin, end;
    S beside_squared, growth;
    Point sum;
  };
  void measure_part(const OrganPairs& organs, const std::vector<Point>& place, const std::vector<S>& reach,
                    Part& part) const;
  [[noreturn]] static void fail(const OrganPairs& organs, const OrganPairs::OrganRange& organ,
                                const std::vector<Point>& place);

  std::vector<Motion> motion_;
  std::vector<Part> parts_;
  std::vector<Point> built_place_;
  std::vector<S> built_reach_;
};

template <class S, int D>
void OrganMotion<S, D>::resize(const OrganPairs& organs) {
  built_place_.assign(organs.particle().size(), Point::Zero());
  built_reach_.assign(organs.particle().size(), S(0));
  motion_.assign(organs.organs().size(), Motion{Point::Zero(), 0, 0});
  parts_.clear();
  for (std::size_t o = 0; o < organs.organs().size(); ++o) {
    const OrganPairs::OrganRange& organ = organs.organs()[o];
    for (std::size_t m = organ.begin; m < organ.end; m += chunk)
      parts_.push_back({o, m, std::min(m + chunk, organ.end), 0, 0, Point::Zero()});
  }
}

template <class S, int D>
void OrganMotion<S, D>::restart(const std::vector<Point>& place, const std::vector<S>& reach) {
  built_place_ = place;
  built_reach_ = reach;
  motion_.assign(motion_.size(), Motion{Point::Zero(), 0, 0});
}

template <class S, int D>
void OrganMotion<S, D>::measure_part(const OrganPairs& organs, const std::vector<Point>& place,
                                     const std::vector<S>& reach, Part& part) const {
  const Point mean = motion_[part.organ].mean;
  part.beside_squared = part.growth = 0;
  part.sum.setZero();
  for (std::size_t m = part.begin; m < part.end; ++m) {
    const OrganPairs::Member& member = organs.members()[m];
    const Point u = place[member.number] - built_place_[member.number];
    part.sum += u;
    part.beside_squared = std::max(part.beside_squared, (u - mean).squaredNorm());
    if (member.flags & is_master)
      part.growth = std::max(part.growth, reach[member.number] - built_reach_[member.number]);
  }
}

template <class S, int D>
template <class E>
void OrganMotion<S, D>::measure(const OrganPairs& organs, const std::vector<Point>& place, const std::vector<S>& reach,
                                const E& execute) {
  guarded(execute)(parts_.size(), [&](std::size_t q) { measure_part(organs, place, reach, parts_[q]); });
  std::vector<Point> previous(motion_.size());
  for (std::size_t o = 0; o < motion_.size(); ++o) {
    previous[o] = motion_[o].mean;
    motion_[o] = {Point::Zero(), 0, 0};
  }
  for (const Part& part : parts_) {
    Motion& organ = motion_[part.organ];
    organ.beside = std::max(organ.beside, part.beside_squared);
    organ.growth = std::max(organ.growth, part.growth);
    organ.mean += part.sum;
  }
  for (std::size_t o = 0; o < motion_.size(); ++o) {
    Motion& organ = motion_[o];
    const OrganPairs::OrganRange& range = organs.organs()[o];
    // A NaN slips through the maxima but not through the sum.
    if (!all_finite(organ.mean)) fail(organs, range, place);
    organ.mean /= static_cast<S>(range.end - range.begin);
    // The parts are relative to the previous mean. Adding the change of the mean makes this a bound for the new one.
    organ.beside = std::sqrt(organ.beside) + (organ.mean - previous[o]).norm();
  }
}

template <class S, int D>
void OrganMotion<S, D>::fail(const OrganPairs& organs, const OrganPairs::OrganRange& organ,
                             const std::vector<Point>& place) {
  for (std::size_t m = organ.begin; m < organ.end; ++m)
    for (int c = 0; c < D; ++c)
      if (const S at = place[organs.members()[m].number][c]; !is_finite(at))
        throw StateError(message("hmps: contact found component ", c, " of the position of particle ",
                                 organs.members()[m].particle, " of '", organ.name, "' to be ", at,
                                 "; the run has become unstable: try a shorter step or a softer penalty"));
  throw StateError(message("hmps: contact found the positions of '", organ.name,
                           "' to overflow; the run has become unstable: try a shorter step or a softer penalty"));
}

}  // namespace hmps::inline HMPS_ABI::detail
