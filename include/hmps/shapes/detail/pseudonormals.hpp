// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The normals of the faces, edges and corners of a surface that tell whether a point lies inside or outside. The
/// normal of an edge is the sum of those of its two faces, that of a corner the sum of those of its faces weighted by
/// their angles (Baerentzen and Aanaes 2005). With p the nearest point of the surface, (x - p) . normal is positive if
/// x is outside. This is exact for a closed, oriented surface that does not meet itself, such as an `isosurface`.
/// Normals are not of unit length; they are zero where none of the surrounding faces has an area.
template <class S>
class Pseudonormals {
  using V = Vector<S, 3>;

 public:
  template <class T>
  explicit Pseudonormals(const SurfaceMesh<T>& mesh) : corners_(mesh.triangles), at_(mesh.vertices.size(), V::Zero()) {
    faces_.reserve(corners_.size());
    for (const auto& t : corners_) {
      std::array<V, 3> x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = mesh.vertices[t[k]].template cast<S>();
      const V area = (x[1] - x[0]).cross(x[2] - x[0]);
      const S size = area.norm();
      faces_.push_back(size > S(0) ? V(area / size) : V(V::Zero()));
      for (std::size_t k = 0; k < 3; ++k) {
        const V next = x[(k + 1) % 3] - x[k], last = x[(k + 2) % 3] - x[k];
        at_[t[k]] += std::atan2(next.cross(last).norm(), next.dot(last)) * faces_.back();
      }
    }
    find_neighbours();
  }

  /// The normal of a `TrianglePoint::part` of a triangle.
  [[nodiscard]] V operator()(std::size_t triangle, std::size_t part) const {
    if (part < 3) return at_[corners_[triangle][part]];
    if (part < 6) return faces_[triangle] + faces_[beside_[triangle][part - 3]];
    return faces_[triangle];
  }

 private:
  /// An edge of a triangle: its vertices, the triangle, and the number of the edge there.
  struct Edge {
    Index low, high;
    std::size_t triangle, side;
    [[nodiscard]] auto operator<=>(const Edge&) const = default;
  };
  /// Pairs the triangles that share an edge. At an edge of only one triangle, the triangle is paired with itself.
  void find_neighbours() {
    std::vector<Edge> edges;
    edges.reserve(3 * corners_.size());
    beside_.resize(corners_.size());
    for (std::size_t t = 0; t < corners_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(corners_[t][k], corners_[t][(k + 1) % 3]);
        edges.push_back({low, high, t, k});
        beside_[t][k] = t;
      }
    std::sort(edges.begin(), edges.end());
    for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
      const auto& [low, high, t, k] = edges[e];
      const auto& [next_low, next_high, u, l] = edges[e + 1];
      if (low != next_low || high != next_high) continue;
      beside_[t][k] = u;
      beside_[u][l] = t;
    }
  }

  std::vector<std::array<Index, 3>> corners_;
  std::vector<V> faces_, at_;                       // unit normals of triangles; normals at vertices
  std::vector<std::array<std::size_t, 3>> beside_;  // the triangle across each edge
};

}  // namespace hmps::inline HMPS_ABI::detail
