// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The rows of bonds of a `BondList`: for each block, first the whole rows, which read one run of slots, then the split
/// rows, which read one run for each half of the lanes.
template <class K>
class BondRuns {
  static constexpr std::size_t half_width = Lanes<K>::width / 2;

 public:
  /// A bond of one lane; its neighbour is slot `first + lane`.
  struct Bond {
    std::int32_t first;
    std::uint32_t lane;
    K w;
  };
  /// The first row of a block, its first split row, and the first entry of its runs in `starts_`.
  struct Group {
    std::uint32_t row = 0, split = 0, start = 0;
  };

  std::vector<Lanes<K>> weights;     ///< One entry per row.
  std::vector<std::int32_t> starts;  ///< First slot of each run of a row: one per row, two if it is split.
  std::vector<Group> groups;         ///< One per block, and one past the last.

  void reserve(std::size_t blocks) {
    groups.reserve(blocks + 1);
    groups.push_back({});
  }
  /// Appends `rows` empty rows, so that a sweep may prefetch beyond the last one, and releases unused memory.
  void pad(std::size_t rows) {
    weights.resize(weights.size() + rows, Lanes<K>(K(0)));
    weights.shrink_to_fit();
    starts.shrink_to_fit();
  }
  [[nodiscard]] std::size_t bytes() const {
    return weights.size() * sizeof(Lanes<K>) + starts.size() * sizeof(std::int32_t) + groups.size() * sizeof(Group);
  }

  /// Adds the rows of the next block from the bonds of both halves of its lanes: first a whole row for each run that
  /// both halves share, then a split row for each pair of runs that only one half has.
  void add(std::array<std::vector<Bond>, 2>& halves) {
    std::array<std::vector<std::size_t>, 2> alone;  // where in `halves` a run begins
    const auto run = [&](std::size_t h, std::size_t k) {
      if (k >= halves[h].size()) return std::numeric_limits<std::int32_t>::max();
      return halves[h][k].first;
    };
    /// Writes the weights of the run at `k` of one half into the row; returns the start of the next run.
    const auto fill = [&](std::size_t h, std::size_t k, Lanes<K>& row) {
      const std::int32_t first = run(h, k);
      for (; run(h, k) == first && k < halves[h].size(); ++k) row.lane[halves[h][k].lane] = halves[h][k].w;
      return k;
    };
    for (auto& half : halves)
      std::sort(half.begin(), half.end(), [](const Bond& a, const Bond& b) { return a.first < b.first; });
    Lanes<K> skipped;
    for (std::array<std::size_t, 2> k{0, 0}; k[0] < halves[0].size() || k[1] < halves[1].size();) {
      const std::int32_t first = run(0, k[0]), second = run(1, k[1]);
      if (first == second) {
        starts.push_back(first);
        Lanes<K>& row = weights.emplace_back(K(0));
        for (std::size_t h = 0; h < 2; ++h) k[h] = fill(h, k[h], row);
      } else {
        const std::size_t h = first < second ? 0 : 1;
        alone[h].push_back(k[h]);
        k[h] = fill(h, k[h], skipped);
      }
    }
    groups.back().split = static_cast<std::uint32_t>(weights.size());
    for (std::size_t k = 0; k < std::max(alone[0].size(), alone[1].size()); ++k) {
      Lanes<K>& row = weights.emplace_back(K(0));
      for (std::size_t h = 0; h < 2; ++h) {
        // A half without a run reads the run of the other half.
        const std::size_t of = k < alone[h].size() ? h : 1 - h;
        starts.push_back(run(of, alone[of][k]));
        if (of == h) fill(h, alone[h][k], row);
      }
    }
    require(starts.size() < no_index, "hmps: the bonds of ", groups.size() * Lanes<K>::width,
            " particles are more than a 32-bit index can number; divide the body into parts");
    groups.push_back({static_cast<std::uint32_t>(weights.size()), 0, static_cast<std::uint32_t>(starts.size())});
  }
};

}  // namespace hmps::inline HMPS_ABI::detail
