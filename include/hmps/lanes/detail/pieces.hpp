// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/disjoint_sets.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The pieces of a body: no bond joins particles of two of them. Stores nothing if there is only one.
class Pieces {
 public:
  Pieces() = default;
  /// `joined` are the particles that bonds join; `particle_of` is the particle of each slot, or `no_index`.
  HMPS_COLD Pieces(DisjointSets& joined, const std::vector<Index>& particle_of) {
    std::vector<Index> name(particle_of.size(), no_index), count;
    piece_of_.assign(particle_of.size(), 0);
    for (std::size_t slot = 0; slot < particle_of.size(); ++slot) {
      if (particle_of[slot] == no_index) continue;
      Index& piece = name[joined.lowest(particle_of[slot])];
      if (piece == no_index) {
        piece = static_cast<Index>(count.size());
        count.push_back(0);
      }
      piece_of_[slot] = piece;
      ++count[piece];
    }
    if (count.size() < 2) {
      piece_of_ = {};
      return;
    }
    middle_.resize(count.size());
    std::vector<Index> passed(count.size(), 0);
    for (std::size_t slot = 0; slot < particle_of.size(); ++slot)
      if (const Index i = particle_of[slot]; i != no_index)
        if (const Index piece = piece_of_[slot]; passed[piece]++ == count[piece] / 2) middle_[piece] = i;
  }

  /// For each piece, the particle in the middle of the order of the sweeps; empty if there is only one piece.
  [[nodiscard]] const std::vector<Index>& middle() const { return middle_; }
  /// The piece of the particle in `slot`, if there are several.
  [[nodiscard]] Index of(std::size_t slot) const { return piece_of_[slot]; }
  [[nodiscard]] std::size_t bytes() const { return (piece_of_.size() + middle_.size()) * sizeof(Index); }

 private:
  std::vector<Index> piece_of_, middle_;
};

}  // namespace hmps::inline HMPS_ABI::detail
