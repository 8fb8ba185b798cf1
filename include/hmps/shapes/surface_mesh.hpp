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
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/fixed_radius.hpp"
#include "hmps/shapes/detail/surface_edges.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI {

/// A triangle surface; triangles are counter-clockwise seen from outside.
template <class S>
struct SurfaceMesh {
  std::vector<Vector<S, 3>> vertices;           ///< m
  std::vector<std::array<Index, 3>> triangles;  ///< indices of vertices
  std::string source = "the surface";           ///< file name, for messages
};

/// The bounding box of the vertices. Throws `InputError` if there is no vertex or one is not finite.
template <class S>
[[nodiscard]] Box<S, 3> bounds(const SurfaceMesh<S>& mesh) {
  detail::require(!mesh.vertices.empty(), "hmps: ", mesh.source,
                  " has no vertices; check that the file holds a surface");
  Box<S, 3> box{mesh.vertices.front(), mesh.vertices.front()};
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    detail::require(detail::all_finite(mesh.vertices[k]), "hmps: vertex ", k, " of ", mesh.source, " is (",
                    mesh.vertices[k], "); every coordinate must be a finite number");
    box.lower = box.lower.cwiseMin(mesh.vertices[k]);
    box.upper = box.upper.cwiseMax(mesh.vertices[k]);
  }
  return box;
}

/// The area vector of a triangle with corners a, b, c: its area in m2 along its normal, which points to the side from
/// which the corners are counter-clockwise.
[[nodiscard]] inline Vector<double, 3> area_vector(const Vector<double, 3>& a, const Vector<double, 3>& b,
                                                   const Vector<double, 3>& c) {
  // In numbers: every program that includes this compiles it, whether it calls it or not.
  const double ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, ac[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return {(ab[1] * ac[2] - ab[2] * ac[1]) / 2, (ab[2] * ac[0] - ab[0] * ac[2]) / 2,
          (ab[0] * ac[1] - ab[1] * ac[0]) / 2};
}

namespace detail {

/// Throws `InputError` if triangle `k` names a vertex that does not exist.
template <class S>
void require_corners(const SurfaceMesh<S>& mesh, std::size_t k) {
  for (const Index corner : mesh.triangles[k])
    require(corner < mesh.vertices.size(), "hmps: triangle ", k, " of ", mesh.source, " names vertex ", corner,
            " but there are only ", mesh.vertices.size(), "; check the file");
}

}  // namespace detail

/// The enclosed volume (m3) of a closed surface; positive if triangles are counter-clockwise seen from outside. Throws
/// `InputError` for a triangle that names a vertex that does not exist.
template <class S>
[[nodiscard]] double volume(const SurfaceMesh<S>& mesh) {
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) detail::require_corners(mesh, k);
  if (mesh.vertices.empty()) return 0;
  // Relative to a vertex, because the origin may be metres away.
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

/// Merges vertices closer than `tolerance` times the largest extent (STL repeats every corner), and drops triangles
/// that lose a corner.
template <class S>
[[nodiscard]] SurfaceMesh<S> weld(const SurfaceMesh<S>& mesh, double tolerance = 1e-6) {
  detail::require(tolerance >= 0 && tolerance < 0.1, "hmps: the tolerance for merging vertices is ", tolerance,
                  " of the surface's extent; give a small share such as 1e-6");
  const Box<S, 3> box = bounds(mesh);
  const S reach = static_cast<S>(tolerance) * (box.upper - box.lower).maxCoeff();
  const FixedRadiusSearch search(vectors(mesh.vertices));
  SurfaceMesh<S> result;
  result.source = mesh.source;
  std::vector<Index> name(mesh.vertices.size(), detail::no_index);
  std::vector<Index> nearby;
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    if (name[k] != detail::no_index) continue;
    name[k] = static_cast<Index>(result.vertices.size());
    result.vertices.push_back(mesh.vertices[k]);
    search(mesh.vertices[k], reach, nearby);
    for (const Index j : nearby)
      if (name[j] == detail::no_index) name[j] = name[k];
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    std::array<Index, 3> t{};
    for (std::size_t c = 0; c < 3; ++c) {
      detail::require(mesh.triangles[k][c] < name.size(), "hmps: triangle ", k, " of ", mesh.source, " names vertex ",
                      mesh.triangles[k][c], " but there are only ", name.size(), "; check the file");
      t[c] = name[mesh.triangles[k][c]];
    }
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.triangles.push_back(t);
  }
  return result;
}

/// Drops triangles with the same corners and orientation as an earlier one (some files hold each triangle twice),
/// unless the surface would be less closed without them.
template <class S>
[[nodiscard]] SurfaceMesh<S> drop_repeated(SurfaceMesh<S> mesh) {
  const auto repeated = detail::needless_repeats(mesh.triangles);
  if (!repeated.empty()) mesh.triangles = detail::without(mesh.triangles, repeated);
  return mesh;
}

namespace detail {

/// Throws `InputError` unless the surface has triangles, and each has three different, finite vertices.
template <class S>
void require_triangles(const SurfaceMesh<S>& mesh) {
  (void)bounds(mesh);
  require(!mesh.triangles.empty(), "hmps: ", mesh.source, " has no triangles; check that the file holds a surface");
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& t = mesh.triangles[k];
    require_corners(mesh, k);
    for (std::size_t c = 0; c < 3; ++c) {
      require(t[c] != t[(c + 1) % 3], "hmps: triangle ", k, " of ", mesh.source, " names vertex ", t[c],
              " twice; weld the surface first");
    }
  }
}

/// The defects that keep a surface from being closed, with the midpoint of the first edge of each kind in m.
template <class S>
struct EdgeFaults {
  struct Kind {
    std::size_t count = 0;
    Vector<S, 3> at = Vector<S, 3>::Zero();
  };
  Kind open;     ///< edges of one triangle
  Kind crowded;  ///< edges of three, five, ... triangles
  Kind turned;   ///< edges traversed more often in one direction than in the other
  Kind shared;   ///< edges of four, six, ... triangles, as many in either direction: no fault in itself
  Kind folded;   ///< edges of one triangle in both orientations

  explicit EdgeFaults(const SurfaceMesh<S>& mesh) : EdgeFaults(mesh, edge_uses(mesh.triangles)) {}
  EdgeFaults(const SurfaceMesh<S>& mesh, const std::vector<EdgeUse>& edges) {
    for (const EdgeUse& edge : edges) {
      if (edge.balanced() && edge.uses() == 2 && !edge.folded()) continue;
      Kind& kind = edge.folded()          ? folded
                   : edge.balanced()      ? shared
                   : edge.uses() == 1     ? open
                   : edge.uses() % 2 != 0 ? crowded
                                          : turned;
      if (kind.count++ == 0) kind.at = (mesh.vertices[edge.low] + mesh.vertices[edge.high]) / S(2);
    }
  }
};

/// Throws `InputError` for repeated triangles, in the same orientation or, throughout a part, in both. `mesh` must be
/// welded; `faults` are its faults.
template <class S>
void require_single(const SurfaceMesh<S>& mesh, const EdgeFaults<S>& faults) {
  // Repeated triangles share their edges with others, or, in two orientations, with each other alone.
  if (faults.crowded.count + faults.turned.count + faults.shared.count + faults.folded.count == 0) return;
  const auto middle = [&](std::size_t k) {
    const auto& t = mesh.triangles[k];
    return Vector<S, 3>((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / S(3));
  };
  const auto repeated = needless_repeats(mesh.triangles);
  if (!repeated.empty())
    throw_input_error({"hmps: ", mesh.source, " has ", mesh.triangles.size(), " triangles, of which ", repeated.size(),
                       " are repeated, the first at (", middle(repeated.front()),
                       "); call drop_repeated, or delete the duplicate faces"});
  const auto hollow = double_sided(mesh.triangles, mesh.vertices.size());
  if (!hollow.empty())
    throw_input_error({"hmps: ", mesh.source, " has a part of ", hollow.size(), " triangles, at (",
                       middle(hollow.front()),
                       "), that is double-sided: each triangle occurs in both orientations, so that the part "
                       "encloses nothing; keep the outer triangle of each pair in a mesh editor"});
}

/// Throws `InputError` unless neighbouring triangles have consistent orientation.
template <class S>
void require_oriented(const SurfaceMesh<S>& mesh, const EdgeFaults<S>& faults) {
  require(faults.turned.count == 0, "hmps: ", mesh.source, " has neighbouring triangles of opposite orientation at ",
          faults.turned.count, " edges, the first at (", faults.turned.at,
          "); make the normals consistent in a mesh editor");
}

}  // namespace detail

/// Throws `InputError` unless the (welded) surface encloses a solid: all vertices are finite, each triangle has three
/// different corners, and each edge is traversed equally often in both directions: by two triangles, or by four where
/// two parts touch along an edge. Triangles must not be repeated: neither in the same orientation (unless the surface
/// were open without them), nor in both orientations throughout a part. The message gives the position of the defect.
/// Does not look for intersecting triangles.
template <class S>
void require_closed(const SurfaceMesh<S>& mesh) {
  detail::require_triangles(mesh);
  const detail::EdgeFaults<S> faults(mesh);
  detail::require_single(mesh, faults);
  const std::string crowded =
      faults.crowded.count == 0
          ? ""
          : detail::message(faults.crowded.count,
                            " edges at which an odd number of triangles meet, three or more, the first ", "at (",
                            faults.crowded.at, "): a flap or an inner wall; delete it in a mesh editor");
  detail::require(
      faults.open.count == 0, "hmps: ", mesh.source, " is open at ", faults.open.count, " edges, the first at (",
      faults.open.at,
      "), so that it has no inside; fill its holes in a mesh editor, weld with a larger tolerance if its parts do "
      "not quite meet, or read it with .closed = false and fill it with fill_open_lattice",
      crowded.empty() ? "" : ". It also has ", crowded);
  detail::require(crowded.empty(), "hmps: ", mesh.source, " has ", crowded);
  detail::require_oriented(mesh, faults);
}

namespace detail {
/// The signed solid angle of the triangle a, b, c seen from the origin (van Oosterom and Strackee 1983).
template <class R>
[[nodiscard]] R solid_angle(const Vector<R, 3>& a, const Vector<R, 3>& b, const Vector<R, 3>& c) {
  const R la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}
}  // namespace detail

/// Whether `x` lies inside the closed surface, by its winding number (sum of solid angles). Linear in the number of
/// triangles; `fill_lattice` is much faster for a lattice. Throws `InputError` for a surface without triangles, a
/// triangle that names a vertex that does not exist, and a position that is not finite.
template <class S>
[[nodiscard]] bool inside(const SurfaceMesh<S>& mesh, const Vector<S, 3>& x) {
  detail::require(!mesh.triangles.empty(), "hmps: ", mesh.source,
                  " has no triangles; check that the file holds a surface");
  detail::require(detail::all_finite(x), "hmps: whether (", x, ") is inside ", mesh.source,
                  " cannot be decided; coordinates must be finite");
  double angle = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    detail::require_corners(mesh, k);
    const auto& t = mesh.triangles[k];
    angle += detail::solid_angle<double>((mesh.vertices[t[0]] - x).template cast<double>(),
                                         (mesh.vertices[t[1]] - x).template cast<double>(),
                                         (mesh.vertices[t[2]] - x).template cast<double>());
  }
  return std::abs(angle) > 2 * std::numbers::pi;
}

}  // namespace hmps::inline HMPS_ABI
