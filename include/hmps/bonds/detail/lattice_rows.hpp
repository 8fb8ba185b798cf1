// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/lanes/detail/window.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The rows of bonds of a `LatticeBonds`. The rows of a block are sorted into groups, one for each set of axes along
/// which the offset of a bond may lie, and within a group by offset. In most blocks each row is a run of consecutive
/// neighbours. In thin walls and other bodies whose lattice rows are short, an offset takes several runs; if a target
/// reads windows fast, such a block has rows that pick their neighbours from a window, usually one for each offset.
/// Both give a particle its bonds in the same order.
template <class K, int D>
class LatticeRows {
 public:
  static constexpr std::size_t width = WindowPlaces<K>::width;
  /// Number of sets of axes; the set with the bits b has the index b - 1.
  static constexpr unsigned directions = (1u << D) - 1;
  using Places = typename WindowPlaces<K>::Stored;

  /// A row: the neighbour of each lane l whose bit is set in `lanes` has the slot `first` + l, or, if the block has
  /// windows, `first` + the place of l.
  struct Row {
    std::int32_t first;
    std::uint16_t lanes;
    std::uint16_t offset;
  };
  static_assert(width <= 16, "hmps: the lanes of a row are kept in 16 bits");
  /// A run of neighbours of a block, with its group.
  struct Placed {
    std::size_t group;
    Row run;
  };

  LatticeRows() = default;
  /// Stores `placed`, the runs of `blocks` blocks, sorted by offset and then by slot. Throws `InputError` for too many.
  LatticeRows(const std::vector<Placed>& placed, std::size_t blocks, bool windows = windows_are_fast)
      : group_(blocks * directions + 1, 0), first_places_(blocks, no_windows) {
    require(placed.size() < std::numeric_limits<std::uint32_t>::max(), "hmps: the bonds of ", blocks,
            " blocks of particles make ", placed.size(), " runs, more than can be numbered; divide the body");
    for (const Placed& p : placed) ++group_[p.group + 1];
    std::partial_sum(group_.begin(), group_.end(), group_.begin());
    rows_.resize(placed.size());
    std::vector<std::uint32_t> next(group_.begin(), group_.end() - 1);
    for (const Placed& p : placed) rows_[next[p.group]++] = p.run;
    if (windows) merge_runs();
  }

  [[nodiscard]] HMPS_INLINE const Row* begin(std::size_t group) const { return rows_.data() + group_[group]; }
  [[nodiscard]] HMPS_INLINE const Row* end(std::size_t group) const { return rows_.data() + group_[group + 1]; }
  /// Whether the rows of `block` pick their neighbours from windows.
  [[nodiscard]] HMPS_INLINE bool has_windows(std::size_t block) const { return first_places_[block] != no_windows; }
  /// The places of the neighbours of the first row of a block with windows; those of the other rows follow.
  [[nodiscard]] HMPS_INLINE const Places* places(std::size_t block) const {
    return places_.data() + first_places_[block];
  }
  /// The slot of the neighbour of lane `l` in `row`, a row of `block`.
  [[nodiscard]] std::size_t neighbour(std::size_t block, const Row* row, std::size_t l) const {
    const std::size_t place = has_windows(block) ? places(block)[row - begin(block * directions)][l] : l;
    return static_cast<std::size_t>(row->first + static_cast<std::ptrdiff_t>(place));
  }
  [[nodiscard]] std::size_t bytes() const {
    return rows_.size() * sizeof(Row) + (group_.size() + first_places_.size()) * sizeof(std::uint32_t) +
           places_.size() * sizeof(Places);
  }

 private:
  /// Replaces the runs of blocks with windows where this takes less time: a row with a window takes between 1.1 and 1.5
  /// times as long as one with a run (half a hollow ball with a wall of three particles).
  void merge_runs() {
    constexpr double cost_of_window = 1.3;
    std::vector<Row> rows, merged;
    std::vector<Places> places;
    std::vector<std::uint32_t> group{0};
    for (std::size_t block = 0; block < first_places_.size(); ++block) {
      merged.clear();
      places.clear();
      std::array<std::uint32_t, directions> ends;
      for (unsigned k = 0; k < directions; ++k) {
        merge_group(block * directions + k, merged, places);
        ends[k] = static_cast<std::uint32_t>(merged.size());
      }
      const Row* const first = begin(block * directions);
      const auto before = static_cast<std::uint32_t>(rows.size());
      const auto count = static_cast<std::size_t>(begin((block + 1) * directions) - first);
      const bool windows = cost_of_window * static_cast<double>(merged.size()) < static_cast<double>(count);
      if (windows) {
        first_places_[block] = static_cast<std::uint32_t>(places_.size());
        places_.insert(places_.end(), places.begin(), places.end());
      } else {
        for (unsigned k = 0; k < directions; ++k)
          ends[k] = static_cast<std::uint32_t>(end(block * directions + k) - first);
      }
      const Row* const from = windows ? merged.data() : first;
      rows.insert(rows.end(), from, from + (windows ? merged.size() : count));
      for (const std::uint32_t e : ends) group.push_back(before + e);
    }
    rows.shrink_to_fit();
    places_.shrink_to_fit();
    rows_ = std::move(rows);
    group_ = std::move(group);
  }

  /// Appends the rows with windows that replace the runs of `group`. The runs of an offset are sorted by lane, and so
  /// are their neighbours by slot.
  void merge_group(std::size_t group, std::vector<Row>& merged, std::vector<Places>& places) const {
    constexpr auto lanes = static_cast<std::int32_t>(width);
    bool open = false;
    for (const Row* run = begin(group); run != end(group); ++run)
      for (std::size_t l = 0; l < width; ++l) {
        if ((run->lanes >> l & 1u) == 0) continue;
        const std::int32_t neighbour = run->first + static_cast<std::int32_t>(l);
        if (!open || merged.back().offset != run->offset || neighbour - merged.back().first >= 2 * lanes) {
          merged.push_back({neighbour / lanes * lanes, 0, run->offset});
          places.push_back({});
          open = true;
        }
        merged.back().lanes = static_cast<std::uint16_t>(merged.back().lanes | 1u << l);
        places.back()[l] = static_cast<std::uint8_t>(neighbour - merged.back().first);
      }
  }

  static constexpr std::uint32_t no_windows = std::numeric_limits<std::uint32_t>::max();

  std::vector<Row> rows_;
  std::vector<std::uint32_t> group_;         ///< First row of each group.
  std::vector<Places> places_;               ///< One entry per row with a window.
  std::vector<std::uint32_t> first_places_;  ///< Of each block: index into places_, or `no_windows`.
};

}  // namespace hmps::inline HMPS_ABI::detail
