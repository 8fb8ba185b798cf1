// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hmps/contact/detail/organ_pairs.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The Verlet list that contact evaluates: rows, each of one slave with the masters that it may touch, and the
/// transpose, the rows that each master is in. `rows()` and `awake()` have an extra element at the end, whose begins
/// are the ends of the last one.
///
/// Everything is in the order of the particles' indices, so sums over the pairs that touch do not depend on when lists
/// were built.
template <class S>
class ActiveRows {
 public:
  struct Row {
    Index slave;  // number among the awake particles
    std::uint32_t side;
    Index slot;
    Index begin;    // of its candidates
    S compression;  // bound of |F_j^-1| of its masters until the next check
  };
  struct Awake {
    Index particle;
    std::uint8_t flags;
    Index rows, entries;  // where its rows as a slave begin in slave_rows, and its entries as a master
    S inverse_volume;     // l0^D / V
  };

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  /// Every particle in the rows once, ascending.
  [[nodiscard]] const std::vector<Awake>& awake() const { return awake_; }
  /// Per candidate, the number of its master among the awake particles.
  [[nodiscard]] const std::vector<Index>& master_of() const { return master_of_; }
  /// Per candidate, its place among the entries of its master.
  [[nodiscard]] const std::vector<Index>& entry_of() const { return entry_of_; }
  /// Per entry, the row of its candidate: ascending for each master.
  [[nodiscard]] const std::vector<Index>& entry_rows() const { return entry_rows_; }
  /// The rows of each slave, ascending.
  [[nodiscard]] const std::vector<Index>& slave_rows() const { return slave_rows_; }

  void clear() {
    rows_.clear();
    master_of_.clear();
  }
  /// Adds a row, whose slave and masters (from `first` to `last`) are given by their numbers.
  void add(Index slave, std::uint32_t side, Index slot, S compression, const Index* first, const Index* last) {
    rows_.push_back({slave, side, slot, static_cast<Index>(master_of_.size()), compression});
    master_of_.insert(master_of_.end(), first, last);
  }
  /// Completes the list after the last row has been added: numbers the awake particles and lists the rows and entries
  /// of each.
  void finish(const OrganPairs& organs);

 private:
  void number_awake(const OrganPairs& organs);

  std::vector<Row> rows_;
  std::vector<Awake> awake_;
  std::vector<Index> master_of_, entry_of_, entry_rows_, slave_rows_;
  std::vector<Index> awake_of_;  // scratch, per numbered particle
};

template <class S>
void ActiveRows<S>::number_awake(const OrganPairs& organs) {
  awake_of_.assign(organs.particle().size(), no_index);
  for (const Row& row : rows_) awake_of_[row.slave] = 0;
  for (const Index j : master_of_) awake_of_[j] = 0;
  awake_.clear();
  for (std::size_t i = 0; i < awake_of_.size(); ++i)
    if (awake_of_[i] != no_index) {
      awake_of_[i] = static_cast<Index>(awake_.size());
      awake_.push_back({organs.particle()[i], organs.flags()[i], 0, 0, static_cast<S>(1 / organs.volume()[i])});
    }
  awake_.push_back({0, 0, 0, 0, 0});
}

template <class S>
void ActiveRows<S>::finish(const OrganPairs& organs) {
  number_awake(organs);
  const std::size_t row_count = rows_.size();
  for (Row& row : rows_) ++awake_[row.slave = awake_of_[row.slave]].rows;
  for (Index& j : master_of_) ++awake_[j = awake_of_[j]].entries;
  rows_.push_back({0, 0, 0, static_cast<Index>(master_of_.size()), 0});
  // At first these are ends; filling backwards moves each of them down to its begin.
  for (std::size_t t = 1; t < awake_.size(); ++t) {
    awake_[t].rows += awake_[t - 1].rows;
    awake_[t].entries += awake_[t - 1].entries;
  }
  slave_rows_.resize(row_count);
  entry_of_.resize(master_of_.size());
  entry_rows_.resize(master_of_.size());
  for (std::size_t r = row_count; r-- > 0;) {
    slave_rows_[--awake_[rows_[r].slave].rows] = static_cast<Index>(r);
    for (Index k = rows_[r + 1].begin; k-- > rows_[r].begin;)
      entry_rows_[entry_of_[k] = --awake_[master_of_[k]].entries] = static_cast<Index>(r);
  }
}

}  // namespace hmps::inline HMPS_ABI::detail
