// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The sets into which the numbers from 0 to `size` - 1 fall when some are joined, directly or through others: the
/// pieces of a body, the parts of a surface.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  void join(Index a, Index b) {
    a = lowest(a);
    b = lowest(b);
    parent_[a < b ? b : a] = a < b ? a : b;
  }
  /// The lowest number in the set of `i`, whatever the order of the joins. Shortens the way to it.
  [[nodiscard]] Index lowest(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace hmps::inline HMPS_ABI::detail
