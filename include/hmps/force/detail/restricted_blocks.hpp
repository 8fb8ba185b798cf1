// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The blocks that each sweep of an `InternalForce` visits: all, or those that some particles need.
template <Bonds B>
class RestrictedBlocks {
 public:
  /// From now on, visits only what the particles with `moves(i)` need. `means` is how often the mean dilatation is
  /// taken.
  template <class Moves>
  void restrict_to(const B& bonds, Moves&& moves, int means) {
    std::vector<char> moving(bonds.size());
    for (std::size_t i = 0; i < moving.size(); ++i) moving[i] = moves(i) ? 1 : 0;
    summed_ = blocks_of(bonds, moving);
    with_neighbours(bonds, moving);
    coupled_ = blocks_of(bonds, moving);
    if (means > 0) {  // the pressure depends on neighbours, and their dilatation on their neighbours
      for (int ring = 0; ring < 2 * means; ++ring) with_neighbours(bonds, moving);
      dilated_ = blocks_of(bonds, moving);
    }
    restricted_ = true;
  }

  /// Calls `visit(block)` for the blocks that a sweep of the mean dilatation must visit.
  template <class E, class Visit>
  void dilated(const B& bonds, const E& execute, Visit&& visit) const {
    sweep(bonds, dilated_, execute, visit);
  }
  /// The same for the sweep of the deformation gradient.
  template <class E, class Visit>
  void coupled(const B& bonds, const E& execute, Visit&& visit) const {
    sweep(bonds, coupled_, execute, visit);
  }
  /// The same for the sum over bonds.
  template <class E, class Visit>
  void summed(const B& bonds, const E& execute, Visit&& visit) const {
    sweep(bonds, summed_, execute, visit);
  }
  [[nodiscard]] std::size_t bytes() const {
    return (dilated_.size() + coupled_.size() + summed_.size()) * sizeof(Index);
  }

 private:
  /// The blocks that contain a marked particle.
  [[nodiscard]] static std::vector<Index> blocks_of(const B& bonds, const std::vector<char>& marked) {
    std::vector<char> found(bonds.block_count(), 0);
    for (std::size_t i = 0; i < marked.size(); ++i)
      if (marked[i]) found[bonds.slot(i) / B::width] = 1;
    std::vector<Index> blocks;
    for (std::size_t block = 0; block < found.size(); ++block)
      if (found[block]) blocks.push_back(static_cast<Index>(block));
    return blocks;
  }
  /// Marks the neighbours of all marked particles too.
  static void with_neighbours(const B& bonds, std::vector<char>& marked) {
    const std::vector<char> before = marked;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i]) bonds.for_each_bond(i, [&](std::size_t j, const auto&, auto) { marked[j] = 1; });
  }
  template <class E, class Visit>
  void sweep(const B& bonds, const std::vector<Index>& blocks, const E& execute, Visit& visit) const {
    if (restricted_)
      guarded(execute)(blocks.size(), [&](std::size_t k) { visit(blocks[k]); });
    else
      guarded(execute)(bonds.block_count(), visit);
  }

  bool restricted_ = false;
  std::vector<Index> dilated_, coupled_, summed_;
};

}  // namespace hmps::inline HMPS_ABI::detail
