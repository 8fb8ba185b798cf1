// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/fixed_radius.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI {

/// A surface of triangles, counter-clockwise seen from outside.
template <class S>
struct SurfaceMesh {
  std::vector<Vector<S, 3>> vertices;           ///< m
  std::vector<std::array<Index, 3>> triangles;  ///< indices of vertices
  std::string source = "the surface";           ///< file name, for messages
};

/// The box around the vertices. Throws `InputError` if there are none, or one is not finite.
template <class S>
[[nodiscard]] Box<S, 3> bounds(const SurfaceMesh<S>& mesh) {
  require(!mesh.vertices.empty(), "hmps: ", mesh.source, " has no vertices; check that the file holds a surface");
  Box<S, 3> box{mesh.vertices.front(), mesh.vertices.front()};
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    require(mesh.vertices[k].allFinite(), "hmps: vertex ", k, " of ", mesh.source, " is (",
            mesh.vertices[k].transpose(), "); every coordinate must be a finite number");
    box.lower = box.lower.cwiseMin(mesh.vertices[k]);
    box.upper = box.upper.cwiseMax(mesh.vertices[k]);
  }
  return box;
}

/// Enclosed volume (m3); positive when triangles are counter-clockwise seen from outside. The
/// surface must be closed.
template <class S>
[[nodiscard]] double volume(const SurfaceMesh<S>& mesh) {
  if (mesh.vertices.empty()) return 0;
  // About a vertex rather than the origin, which may be metres away.
  const Vector<double, 3> base = mesh.vertices.front().template cast<double>();
  double six = 0;
  for (const auto& t : mesh.triangles) {
    const Vector<double, 3> a = mesh.vertices[t[0]].template cast<double>() - base;
    const Vector<double, 3> b = mesh.vertices[t[1]].template cast<double>() - base;
    const Vector<double, 3> c = mesh.vertices[t[2]].template cast<double>() - base;
    six += a.dot(b.cross(c));
  }
  return six / 6;
}

/// Merges vertices within `tolerance` of the largest extent (STL repeats every corner), and drops
/// the triangles that thereby lose a corner.
template <class S>
[[nodiscard]] SurfaceMesh<S> weld(const SurfaceMesh<S>& mesh, double tolerance = 1e-6) {
  require(tolerance >= 0 && tolerance < 0.1, "hmps: vertices are to be merged within ", tolerance,
          " of the surface's extent; give a small share such as 1e-6");
  const Box<S, 3> box = bounds(mesh);
  const S reach = static_cast<S>(tolerance) * (box.upper - box.lower).maxCoeff();
  const FixedRadiusSearch search(vectors(mesh.vertices));
  SurfaceMesh<S> result;
  result.source = mesh.source;
  constexpr Index none = static_cast<Index>(-1);
  std::vector<Index> name(mesh.vertices.size(), none);
  std::vector<Index> near;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    if (name[k] != none) continue;
    name[k] = static_cast<Index>(result.vertices.size());
    result.vertices.push_back(mesh.vertices[k]);
    search(mesh.vertices[k], reach, near);
    for (const Index j : near)
      if (name[j] == none) name[j] = name[k];
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    std::array<Index, 3> t{};
    for (std::size_t c = 0; c < 3; ++c) {
      require(mesh.triangles[k][c] < name.size(), "hmps: triangle ", k, " of ", mesh.source, " names vertex ",
              mesh.triangles[k][c], " but there are only ", name.size(), "; check the file");
      t[c] = name[mesh.triangles[k][c]];
    }
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.triangles.push_back(t);
  }
  return result;
}

/// Throws `InputError` unless the (welded) surface encloses a solid: finite vertices, triangles with
/// three different corners of `vertices`, and each edge run through as often in one direction as in
/// the other: by two triangles, or by four where two parts touch along an edge. The message
/// names the position of an edge where it fails. Triangles that intersect are not looked for.
template <class S>
void require_closed(const SurfaceMesh<S>& mesh) {
  const Box<S, 3> box = bounds(mesh);
  require(!mesh.triangles.empty(), "hmps: ", mesh.source, " has no triangles; check that the file holds a surface");
  struct Edge {
    Index low, high;
    int forward, backward;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    for (std::size_t c = 0; c < 3; ++c) {
      const Index a = t[c];
      const Index b = t[(c + 1) % 3];
      require(a < mesh.vertices.size(), "hmps: triangle ", k, " of ", mesh.source, " names vertex ", a,
              " but there are only ", mesh.vertices.size(), "; check the file");
      require(a != b, "hmps: triangle ", k, " of ", mesh.source, " names vertex ", a, " twice; weld the surface first");
      edges.push_back(a < b ? Edge{a, b, 1, 0} : Edge{b, a, 0, 1});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  std::size_t open = 0;
  std::size_t turned = 0;
  Vector<S, 3> open_at = box.lower;
  Vector<S, 3> turned_at = box.lower;
  for (std::size_t k = 0; k < edges.size();) {
    Edge edge = edges[k];
    for (++k; k < edges.size() && edges[k].low == edge.low && edges[k].high == edge.high; ++k) {
      edge.forward += edges[k].forward;
      edge.backward += edges[k].backward;
    }
    if (edge.forward == edge.backward) continue;
    const Vector<S, 3> middle = (mesh.vertices[edge.low] + mesh.vertices[edge.high]) / S(2);
    const bool odd = (edge.forward + edge.backward) % 2 != 0;
    if ((odd ? open : turned)++ == 0) (odd ? open_at : turned_at) = middle;
  }
  require(open == 0, "hmps: ", mesh.source, " is open at ", open, " edges, the first at (", open_at.transpose(),
          "), so that it has no inside; fill its holes in a mesh editor, or weld with a larger tolerance if its parts "
          "do not "
          "quite meet");
  require(turned == 0, "hmps: ", mesh.source, " has neighbouring triangles of opposite orientation at ", turned,
          " edges, the first at (", turned_at.transpose(), "); let a mesh editor make the normals consistent");
}

/// Whether `x` lies in the closed surface: whether it winds around x (sum of solid angles). Linear
/// in the number of triangles; `fill_lattice` is much faster for a lattice.
template <class S>
[[nodiscard]] bool inside(const SurfaceMesh<S>& mesh, const Vector<S, 3>& x) {
  double angle = 0;
  for (const auto& t : mesh.triangles) {
    const Vector<double, 3> a = (mesh.vertices[t[0]] - x).template cast<double>();
    const Vector<double, 3> b = (mesh.vertices[t[1]] - x).template cast<double>();
    const Vector<double, 3> c = (mesh.vertices[t[2]] - x).template cast<double>();
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(angle) > 2 * std::numbers::pi;
}

}  // namespace hmps::inline HMPS_ABI
