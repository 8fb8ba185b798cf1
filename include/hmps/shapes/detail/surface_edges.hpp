// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/disjoint_sets.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

// All of this is in templates, with `I` an index, so that only programs with surfaces compile it.

template <class I>
using BasicTriangles = std::vector<std::array<I, 3>>;
using Triangles = BasicTriangles<Index>;

/// An edge of a surface, and the number of triangles that traverse it in each direction.
template <class I>
struct BasicEdgeUse {
  I low, high;  ///< its vertices
  int forward, backward;
  I across;  ///< exclusive or of the third corners of its triangles: 0 if there are two and they are the same

  [[nodiscard]] int uses() const { return forward + backward; }
  [[nodiscard]] bool balanced() const { return forward == backward; }
  /// Whether its two triangles are the same one in both orientations.
  [[nodiscard]] bool folded() const { return forward == 1 && backward == 1 && across == 0; }
};
using EdgeUse = BasicEdgeUse<Index>;

/// The edges of `triangles`, each once, ordered by their vertices.
template <class I = Index>
[[nodiscard]] std::vector<BasicEdgeUse<I>> edge_uses(const BasicTriangles<I>& triangles) {
  std::vector<BasicEdgeUse<I>> edges;
  edges.reserve(3 * triangles.size());
  for (const auto& t : triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const I a = t[c], b = t[(c + 1) % 3], across = t[(c + 2) % 3];
      edges.push_back(a < b ? BasicEdgeUse<I>{a, b, 1, 0, across} : BasicEdgeUse<I>{b, a, 0, 1, across});
    }
  const auto key = [](const BasicEdgeUse<I>& e) { return std::pair(e.low, e.high); };
  std::sort(edges.begin(), edges.end(),
            [&](const BasicEdgeUse<I>& a, const BasicEdgeUse<I>& b) { return key(a) < key(b); });
  std::size_t kept = 0;
  for (const BasicEdgeUse<I>& edge : edges) {
    if (kept > 0 && key(edges[kept - 1]) == key(edge)) {
      edges[kept - 1].forward += edge.forward;
      edges[kept - 1].backward += edge.backward;
      edges[kept - 1].across ^= edge.across;
    } else {
      edges[kept++] = edge;
    }
  }
  edges.erase(edges.begin() + static_cast<std::ptrdiff_t>(kept), edges.end());
  return edges;
}

template <class I = Index>
[[nodiscard]] std::size_t count_unbalanced(const std::vector<BasicEdgeUse<I>>& edges) {
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [](const BasicEdgeUse<I>& e) { return !e.balanced(); }));
}

/// The triangle rotated to start with its smallest vertex: equal for equal corners in the same orientation.
template <class I = Index>
[[nodiscard]] std::array<I, 3> turned_to_smallest(std::array<I, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// The triangles with the same corners and orientation as an earlier one, in order.
template <class I = Index>
[[nodiscard]] std::vector<std::size_t> repeated_triangles(const BasicTriangles<I>& triangles) {
  using Named = std::pair<std::array<I, 3>, std::size_t>;
  std::vector<Named> named;
  named.reserve(triangles.size());
  for (std::size_t k = 0; k < triangles.size(); ++k) named.emplace_back(turned_to_smallest(triangles[k]), k);
  std::sort(named.begin(), named.end());
  std::vector<std::size_t> repeated;
  for (std::size_t k = 1; k < named.size(); ++k)
    if (named[k].first == named[k - 1].first) repeated.push_back(named[k].second);
  std::sort(repeated.begin(), repeated.end());
  return repeated;
}

template <class I = Index>
[[nodiscard]] BasicTriangles<I> without(const BasicTriangles<I>& triangles, const std::vector<std::size_t>& dropped) {
  BasicTriangles<I> left;
  left.reserve(triangles.size() - dropped.size());
  auto next = dropped.begin();
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    if (next != dropped.end() && *next == k)
      ++next;
    else
      left.push_back(triangles[k]);
  }
  return left;
}

/// The repeated triangles if the surface is as closed without them, otherwise none: two parts may share a triangle, for
/// example two boxes on the same ground.
template <class I = Index>
[[nodiscard]] std::vector<std::size_t> needless_repeats(const BasicTriangles<I>& triangles) {
  std::vector<std::size_t> repeated = repeated_triangles(triangles);
  if (!repeated.empty() &&
      count_unbalanced(edge_uses(without(triangles, repeated))) > count_unbalanced(edge_uses(triangles)))
    repeated.clear();
  return repeated;
}

/// The triangles of connected parts in which every triangle occurs equally often in both orientations, so that the part
/// encloses nothing; in order.
template <class I = Index>
[[nodiscard]] std::vector<std::size_t> double_sided(const BasicTriangles<I>& triangles, std::size_t vertices) {
  std::map<std::array<I, 3>, int> net;
  DisjointSets parts(vertices);
  const auto sorted = [](std::array<I, 3> t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  for (const auto& t : triangles) {
    net[sorted(t)] += turned_to_smallest(t) == sorted(t) ? 1 : -1;
    parts.join(t[0], t[1]);
    parts.join(t[0], t[2]);
  }
  std::vector<char> encloses(vertices, 0);
  for (const auto& [t, sum] : net)
    if (sum != 0) encloses[parts.lowest(t[0])] = 1;
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    if (!encloses[parts.lowest(triangles[k][0])]) found.push_back(k);
  return found;
}

}  // namespace hmps::inline HMPS_ABI::detail
