// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hmps/contact/detail/organ_pairs.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/search/detail/grid.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The broad-phase list: for every slave, the masters within reach plus a margin. Each row belongs to one slave of one
/// side.
template <class S, int D>
class BroadPhase {
 public:
  using Point = Vector<S, D>;
  struct Row {
    Index slave;  // number of the particle
    std::uint32_t side;
    Index slot;
    Index begin;  // of its candidates
  };
  /// What the list is built from; the vectors have one element per numbered particle.
  struct Source {
    const OrganPairs& organs;
    const std::vector<Point>& place;    // in m
    const std::vector<S>& reach;        // of a master, in m
    const std::vector<S>& compression;  // negative: no wall
    S radius, margin;                   // r_e and the margin in m
  };

  /// Throws `InputError` if there are more candidates than an index can number.
  void build(const Source& source, const AnyExecutor& execute);

  /// With an extra row at the end, whose `begin` is the end of the last row's candidates.
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  /// Per candidate, the number of its master: ascending in each row.
  [[nodiscard]] const std::vector<Index>& masters() const { return masters_; }
  /// How much (m) the organs of a side may move, and reaches grow, in all before the list may miss a pair.
  [[nodiscard]] S limit(std::size_t side) const { return limit_[side]; }
  /// Particle `i` is in the rows `rows_of()[q]` with q from `rows_of_begin(i)` to `rows_of_begin(i + 1) - 1`.
  [[nodiscard]] const std::vector<Index>& rows_of() const { return rows_of_; }
  [[nodiscard]] Index rows_of_begin(std::size_t i) const { return rows_of_begin_[i]; }

 private:
  struct Box {
    Point low = Point::Constant(std::numeric_limits<S>::max() / S(4)), high = -low;
    void add(const Point& place) {
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
    [[nodiscard]] bool empty() const { return !(low[0] <= high[0]); }
    /// How far `place` lies outside, along the axis where it lies furthest outside.
    [[nodiscard]] S distance(const Point& place) const { return (low - place).cwiseMax(place - high).maxCoeff(); }
  };
  struct Near {
    Index slave, master;
  };
  struct Part {  // of one side: the slaves, with their slots, and the masters that could meet
    std::vector<Index> slaves, slots, masters;
  };

  [[nodiscard]] Part choose(const Source& source, std::size_t side);
  void search(const Source& source, std::size_t side, const Part& part, const AnyExecutor& execute);
  void append(std::size_t side, const Part& part, const std::vector<std::vector<Near>>& found);
  void list_rows_of_particles(std::size_t particles);

  std::vector<Row> rows_;
  std::vector<Index> masters_;
  std::vector<S> limit_;
  std::vector<Index> rows_of_begin_, rows_of_, next_;
};

template <class S, int D>
void BroadPhase<S, D>::build(const Source& source, const AnyExecutor& execute) {
  rows_.clear();
  masters_.clear();
  const std::size_t sides = source.organs.sides().size();
  limit_.assign(sides, S(0));
  for (std::size_t s = 0; s < sides; ++s)
    if (const Part part = choose(source, s); !part.slaves.empty()) search(source, s, part, execute);
  require(masters_.size() + rows_.size() < no_index, "hmps: ", masters_.size() + rows_.size(),
          " candidates for contact are more than a 32-bit index can number; name fewer slaves and masters");
  rows_.push_back({0, 0, 0, static_cast<Index>(masters_.size())});
  list_rows_of_particles(source.place.size());
}

/// Chooses the slaves in the box of the masters, and the masters in the box of these slaves, where each box is enlarged
/// by reach and margin.
template <class S, int D>
typename BroadPhase<S, D>::Part BroadPhase<S, D>::choose(const Source& source, std::size_t s) {
  const OrganPairs::Side& side = source.organs.sides()[s];
  const OrganPairs::Pair& pair = source.organs.pairs()[side.pair];
  const auto &a = source.organs.organs()[side.slaves], &b = source.organs.organs()[side.masters];
  const auto& members = source.organs.members();
  const auto is_wall = [&](const OrganPairs::Member& member) {
    return (member.flags & is_master) && source.compression[member.number] > 0;
  };
  Box wall, all_slaves, near_slaves;
  S widest = 0;
  for (std::size_t m = b.begin; m < b.end; ++m)
    if (is_wall(members[m])) {
      wall.add(source.place[members[m].number]);
      widest = std::max(widest, source.reach[members[m].number]);
    }
  Part part;
  for (std::size_t m = a.begin; m < a.end; ++m) {
    const Index i = members[m].number;
    if (!(members[m].flags & is_slave) || !pair.may_be_slave(members[m].particle)) continue;
    all_slaves.add(source.place[i]);
    if (wall.distance(source.place[i]) > widest + source.margin) continue;
    near_slaves.add(source.place[i]);
    part.slaves.push_back(i);
    part.slots.push_back(static_cast<Index>(side.first_slot + m - a.begin));
  }
  // Organs far apart tolerate as much motion as lies between them; with all slaves excluded, any motion.
  const S apart = all_slaves.empty()
                      ? std::numeric_limits<S>::max() / S(4)
                      : (wall.low - all_slaves.high).cwiseMax(all_slaves.low - wall.high).maxCoeff() - widest;
  limit_[s] = S(0.999) * std::max(source.margin, apart);
  if (part.slaves.empty()) return part;
  for (std::size_t m = b.begin; m < b.end; ++m) {
    const Index j = members[m].number;
    if (is_wall(members[m]) && near_slaves.distance(source.place[j]) <= source.reach[j] + source.margin)
      part.masters.push_back(j);
  }
  return part;
}

template <class S, int D>
void BroadPhase<S, D>::search(const Source& source, std::size_t side, const Part& part, const AnyExecutor& execute) {
  const OrganPairs::Pair& pair = source.organs.pairs()[source.organs.sides()[side].pair];
  const std::vector<Index>& particle = source.organs.particle();
  Grid<S, D> grid;
  grid.build(part.slaves.size(), source.radius + source.margin,
             [&](std::size_t k) { return source.place[part.slaves[k]]; });
  constexpr std::size_t batch = 256;
  std::vector<std::vector<Near>> found((part.masters.size() + batch - 1) / batch);
  guarded(execute)(found.size(), [&](std::size_t q) {
    for (std::size_t l = q * batch; l < std::min(part.masters.size(), (q + 1) * batch); ++l) {
      const Index j = part.masters[l];
      grid.visit(source.place[j], source.reach[j] + source.margin, [&](Index k, S) {
        if (!pair.excluded || !pair.excluded(particle[part.slaves[k]], particle[j])) found[q].push_back({k, j});
      });
    }
  });
  append(side, part, found);
}

/// Sorts the pairs found by slave. Masters ascend from batch to batch, so they ascend within every row.
template <class S, int D>
void BroadPhase<S, D>::append(std::size_t side, const Part& part, const std::vector<std::vector<Near>>& found) {
  const std::size_t slaves = part.slaves.size(), first = masters_.size();
  std::vector<std::size_t> count(slaves + 1, 0);
  for (const auto& list : found)
    for (const Near& nearby : list) ++count[nearby.slave + 1];
  for (std::size_t k = 0; k < slaves; ++k) {
    if (count[k + 1] > 0)
      rows_.push_back(
          {part.slaves[k], static_cast<std::uint32_t>(side), part.slots[k], static_cast<Index>(first + count[k])});
    count[k + 1] += count[k];
  }
  masters_.resize(first + count.back());
  for (const auto& list : found)
    for (const Near& nearby : list) masters_[first + count[nearby.slave]++] = nearby.master;
}

template <class S, int D>
void BroadPhase<S, D>::list_rows_of_particles(std::size_t particles) {
  const auto each = [&](auto&& visit) {
    for (std::size_t r = 0; r + 1 < rows_.size(); ++r) {
      visit(rows_[r].slave, r);
      for (Index k = rows_[r].begin; k < rows_[r + 1].begin; ++k) visit(masters_[k], r);
    }
  };
  rows_of_begin_.assign(particles + 1, 0);
  each([&](Index i, std::size_t) { ++rows_of_begin_[i + 1]; });
  for (std::size_t i = 0; i < particles; ++i) rows_of_begin_[i + 1] += rows_of_begin_[i];
  rows_of_.resize(rows_of_begin_.back());
  next_.assign(rows_of_begin_.begin(), rows_of_begin_.end() - 1);
  each([&](Index i, std::size_t r) { rows_of_[next_[i]++] = static_cast<Index>(r); });
}

}  // namespace hmps::inline HMPS_ABI::detail
