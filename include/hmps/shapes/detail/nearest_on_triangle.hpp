// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// A point of a triangle, and the part of the triangle to which it belongs.
template <class S>
struct TrianglePoint {
  Vector<S, 3> place;
  /// A corner (0 to 2), the inside of an edge (3 to 5, which start from corner 0 to 2), or the inside of the face (6).
  std::size_t part;
};

/// The point of the edges of a triangle that is nearest to `x`.
template <class S>
[[nodiscard]] TrianglePoint<S> nearest_on_edges(const std::array<Vector<S, 3>, 3>& corners, const Vector<S, 3>& x) {
  TrianglePoint<S> nearest{corners[0], 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector<S, 3>&from = corners[k], &to = corners[(k + 1) % 3];
    const S share = nearest_on_segment<S, 3>(from, to, x);
    const Vector<S, 3> at = from + share * (to - from);
    if ((at - x).squaredNorm() < (nearest.place - x).squaredNorm())
      nearest = {at, share <= S(0) ? k : share >= S(1) ? (k + 1) % 3 : k + 3};
  }
  return nearest;
}

/// The point of the triangle a, b, c that is nearest to `x` (Ericson 2005, section 5.1.5). Corners may coincide or be
/// collinear.
template <class S>
[[nodiscard]] TrianglePoint<S> nearest_on_triangle(const std::array<Vector<S, 3>, 3>& corners, const Vector<S, 3>& x) {
  using V = Vector<S, 3>;
  const auto& [a, b, c] = corners;
  const V ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const S d1 = ab.dot(ax), d2 = ac.dot(ax), d3 = ab.dot(bx), d4 = ac.dot(bx), d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d1 <= 0 && d2 <= 0) return {a, 0};
  if (d3 >= 0 && d4 <= d3) return {b, 1};
  if (d6 >= 0 && d5 <= d6) return {c, 2};
  const S vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  // An edge without length would give 0 / 0; its point lies on the other two edges.
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 - d3 > 0) return {a + d1 / (d1 - d3) * ab, 3};
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 - d6 > 0) return {a + d2 / (d2 - d6) * ac, 5};
  const S bc = (d4 - d3) + (d5 - d6);  // the squared length of that edge
  if (va <= 0 && d4 >= d3 && d5 >= d6 && bc > 0) return {b + (d4 - d3) / bc * (c - b), 4};
  const S sum = va + vb + vc;  // the square of twice the area
  const V within = a + vb / sum * ab + vc / sum * ac;
  // With edges of length L the rounding of `sum` is about 1e-16 L^3 |x - a|. If `sum` is lost in it, an edge may be
  // nearer.
  const S size = ab.squaredNorm() + ac.squaredNorm();
  if (sum * sum > 1e-26 * size * size * size * (size + ax.squaredNorm())) return {within, 6};
  const TrianglePoint<S> edge = nearest_on_edges(corners, x);
  const bool lies_within = va > 0 && vb > 0 && vc > 0;
  if (lies_within && (within - x).squaredNorm() < (edge.place - x).squaredNorm()) return {within, 6};
  return edge;
}

}  // namespace hmps::inline HMPS_ABI::detail
