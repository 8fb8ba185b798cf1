// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/detail/resolution.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI {

/// The area of a surface, or of a patch of one, in m2. Throws `InputError` for a triangle that names a vertex that does
/// not exist.
template <class S>
[[nodiscard]] double area(const SurfaceMesh<S>& mesh) {
  double sum = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    detail::require_corners(mesh, k);
    const auto& t = mesh.triangles[k];
    sum += area_vector(mesh.vertices[t[0]].template cast<double>(), mesh.vertices[t[1]].template cast<double>(),
                       mesh.vertices[t[2]].template cast<double>())
               .norm();
  }
  return sum;
}

/// A patch of a surface, to be held or loaded: the triangles for which `holds(centre, normal)` is true, with the middle
/// of the triangle in m and its outward unit normal. Choose them by direction or position, or by a shape:
///
///     const auto base = surface_patch(mesh, [](const auto& at, const auto& n) { return n[2] < -0.9; });
///     const auto spot = surface_patch(mesh, [&](const auto& at, const auto& n) { return ball(at) < 0; });
///
/// Triangles are taken whole: if they are large compared with the patch, `refine` the surface first. Triangles without
/// area are left out. Throws `InputError` if no triangle is chosen, for a broken surface, and for a closed surface that
/// is inside out (its normals point inwards).
template <class S, class Holds>
[[nodiscard]] SurfaceMesh<S> surface_patch(const SurfaceMesh<S>& mesh, const Holds& holds) {
  detail::require_triangles(mesh);
  const detail::EdgeFaults<S> faults(mesh);
  detail::require(faults.open.count + faults.crowded.count + faults.turned.count > 0 || !(volume(mesh) < 0),
                  "hmps: ", mesh.source, " is closed and inside out: its volume is ", volume(mesh),
                  " m3, and its normals point inwards; flip its normals in a mesh editor, or swap two corners of each "
                  "triangle");
  SurfaceMesh<S> patch;
  patch.source = "a patch of " + mesh.source;
  std::vector<Index> name(mesh.vertices.size(), detail::no_index);
  for (const auto& t : mesh.triangles) {
    const Vector<double, 3> a = mesh.vertices[t[0]].template cast<double>();
    const Vector<double, 3> b = mesh.vertices[t[1]].template cast<double>();
    const Vector<double, 3> c = mesh.vertices[t[2]].template cast<double>();
    const Vector<double, 3> across = area_vector(a, b, c);
    if (!(across.norm() > 0)) continue;
    Vector<S, 3> centre;
    for (int d = 0; d < 3; ++d) centre[d] = static_cast<S>((a[d] + b[d] + c[d]) / 3);
    const Vector<S, 3> normal = (across / across.norm()).template cast<S>();
    if (!holds(centre, normal)) continue;
    std::array<Index, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (name[t[k]] == detail::no_index) {
        name[t[k]] = static_cast<Index>(patch.vertices.size());
        patch.vertices.push_back(mesh.vertices[t[k]]);
      }
      corners[k] = name[t[k]];
    }
    patch.triangles.push_back(corners);
  }
  const Box<S, 3> box = bounds(mesh);
  detail::require(!patch.triangles.empty(), "hmps: none of the ", mesh.triangles.size(), " triangles of ", mesh.source,
                  ", which reaches from (", box.lower, ") to (", box.upper,
                  ") m, is in the patch; check the patch's position and direction, or refine the surface");
  return patch;
}

namespace detail {
/// A number of triangles below that into which `refine` divides one with these edges, in units of the longest edge that
/// may remain. While all edges are longer than that, it makes four triangles of half the size. While two are, it makes
/// three, each with two edges of at least (e - 1) / 2, with e the shorter of the two: a median from the end of the
/// third edge, which is at most 1, is not shorter. So a sliver gives nearly as many triangles as a square on its long
/// edge.
[[nodiscard]] inline double fewest_refined(std::array<double, 3> edges) {
  std::sort(edges.begin(), edges.end());
  double count = 1, shortest = edges[0], middle = edges[1];
  constexpr double enough = 1e12;
  for (; shortest > 1 && count < enough; shortest /= 2, middle /= 2) count *= 4;
  for (; middle > 1 && count < enough; middle = (middle - 1) / 2) count *= 3;
  return count;
}
}  // namespace detail

/// The surface with triangles whose edges are at most `longest` (m) long: those longer than it by more than rounding
/// (1e-5 of it and a few units in the last place of the coordinates) are halved until none is left.
/// Neighbours share their new vertices, so that a closed surface stays closed; its shape does not change. A sliver
/// is divided into slivers, nearly as many as a square on its longest edge would give. Throws `InputError` for a length
/// that is not positive, a broken surface, and if the result would have more than 20 million triangles, in most cases
/// at once.
template <class S>
[[nodiscard]] SurfaceMesh<S> refine(SurfaceMesh<S> mesh, double longest) {
  detail::require(detail::is_finite(longest) && longest > 0, "hmps: a surface is to be refined to edges of ", longest,
                  " m; give a positive length");
  detail::require_triangles(mesh);
  constexpr double most = 2e7;
  const auto length = [&](Index a, Index b) {
    return static_cast<double>((mesh.vertices[a] - mesh.vertices[b]).norm());
  };
  // Edges that only rounding makes longer are not halved.
  const double bound = longest * (1 + 1e-5) + detail::rounding_of_distances(vectors(mesh.vertices));
  double expected = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    expected += detail::fewest_refined({length(a, b) / bound, length(b, c) / bound, length(c, a) / bound});
  expected = std::max(expected, area(mesh) / (longest * longest));
  detail::require(expected < most, "hmps: ", mesh.source, " refined to edges of ", longest, " m has more than ",
                  expected, " triangles; give a larger length, in metres, or remove long slivers in a mesh editor");
  for (bool again = true; again;) {
    again = false;
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<Index>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / S(2));
      return at->second;
    };
    std::vector<std::array<Index, 3>> finer;
    finer.reserve(mesh.triangles.size());
    for (auto t : mesh.triangles) {
      const auto is_long = [&](std::size_t k) { return length(t[k], t[(k + 1) % 3]) > bound; };
      const int count = int{is_long(0)} + int{is_long(1)} + int{is_long(2)};
      if (count == 0) {
        finer.push_back(t);
        continue;
      }
      again = true;
      // Rotated so that the first edge is long and, if two edges are long, the third one is not.
      while (count == 1 ? !is_long(0) : count == 2 && is_long(2)) std::rotate(t.begin(), t.begin() + 1, t.end());
      const auto [a, b, c] = t;
      const Index ab = middle(a, b);
      if (count == 1) {
        finer.insert(finer.end(), {{a, ab, c}, {ab, b, c}});
        continue;
      }
      const Index bc = middle(b, c);
      finer.push_back({ab, b, bc});
      if (count == 3) {
        const Index ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {bc, c, ca}, {ab, bc, ca}});
      } else if (length(a, bc) < length(ab, c)) {
        finer.insert(finer.end(), {{a, ab, bc}, {a, bc, c}});
      } else {
        finer.insert(finer.end(), {{a, ab, c}, {ab, bc, c}});
      }
    }
    detail::require(static_cast<double>(finer.size()) < most, "hmps: ", mesh.source, " refined to edges of ", longest,
                    " m has more than ", most, " triangles; give a larger length, in metres");
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

}  // namespace hmps::inline HMPS_ABI
