// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/surface_mesh.hpp"

/// Closed surfaces of simple solids, for scenes with known answers: exact areas for `PatchPressure`, input for
/// `fit_particles` and `fill_lattice`. The surface of any other shape comes from `isosurface`, which rounds its edges.
namespace hmps::inline HMPS_ABI {

/// The surface of a box: twelve triangles. Throws `InputError` for a box without volume or with corners that are not
/// finite.
template <class S>
[[nodiscard]] SurfaceMesh<S> box_surface(const Box<S, 3>& box) {
  for (int c = 0; c < 3; ++c)
    detail::require(detail::is_finite(box.lower[c]) && detail::is_finite(box.upper[c]) && box.lower[c] < box.upper[c],
                    "hmps: the box of a surface reaches from ", box.lower[c], " to ", box.upper[c],
                    " m along component ", c, "; give finite corners, the lower one first");
  SurfaceMesh<S> mesh;
  mesh.source = "the surface of a box";
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back((k & 1) != 0 ? box.upper[0] : box.lower[0], (k & 2) != 0 ? box.upper[1] : box.lower[1],
                               (k & 4) != 0 ? box.upper[2] : box.lower[2]);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The surface of a solid of revolution about the z axis, such as a cylinder, a tube, a ball or a dish. Its vertices
/// lie on the exact surface; with n segments the volume is too small by the factor sin(2 pi / n) / (2 pi / n), 0.16 %
/// for 64.
///
///     const auto tube = revolved_surface<double>({{4e-3, 0}, {6e-3, 0}, {6e-3, 0.02}, {4e-3, 0.02}}, 64);
///
/// @param profile   corners (r, z) in m of the section, in either sense, without the first one again at the end; the
///                  profile must not cross itself, and may touch the axis at corners and along edges
/// @param segments  of the circle, at least 3
/// Throws `InputError` for a profile of fewer than three corners or without area, and for a corner that is not finite,
/// has a negative radius or coincides with the one before it.
template <class S>
[[nodiscard]] SurfaceMesh<S> revolved_surface(const std::vector<Vector<S, 2>>& profile, int segments) {
  const std::size_t n = profile.size();
  detail::require(n >= 3, "hmps: the profile of a solid of revolution has ", n, " corners; give three or more");
  detail::require(segments >= 3, "hmps: a solid of revolution has ", segments, " segments; give three or more");
  double twice_area = 0, extent = 0;
  for (const Vector<S, 2>& own : profile)
    for (int c = 0; c < 2; ++c)
      extent =
          std::max(extent, std::abs(static_cast<double>(own[c]) - (c == 0 ? 0 : static_cast<double>(profile[0][1]))));
  // sin(pi) is no exact zero: corners this close to the axis lie on it, and radii may be this far below zero.
  const double on_axis = 100 * static_cast<double>(std::numeric_limits<S>::epsilon()) * extent;
  for (std::size_t k = 0; k < n; ++k) {
    const Vector<S, 2>&own = profile[k], &next = profile[(k + 1) % n];
    detail::require(detail::all_finite(own) && !(static_cast<double>(own[0]) < -on_axis), "hmps: corner ", k,
                    " of the profile of a solid of revolution is (", own,
                    ") m; give finite numbers and a radius that is not negative");
    detail::require(own != next, "hmps: corners ", k, " and ", (k + 1) % n,
                    " of the profile of a solid of revolution coincide at (", own, ") m; give each corner once");
    const double z = static_cast<double>(profile[0][1]);
    twice_area += static_cast<double>(own[0]) * (static_cast<double>(next[1]) - z) -
                  static_cast<double>(next[0]) * (static_cast<double>(own[1]) - z);
  }
  detail::require(std::abs(twice_area) > on_axis * extent && detail::is_finite(twice_area),
                  "hmps: the profile of a solid of revolution encloses ", twice_area / 2,
                  " m2; give the corners of a section in order");

  SurfaceMesh<S> mesh;
  mesh.source = "the surface of a solid of revolution";
  const auto count = static_cast<std::size_t>(segments);
  const auto corner = [&](std::size_t k) -> const Vector<S, 2>& { return profile[twice_area > 0 ? k : n - 1 - k]; };
  const auto off_axis = [&](std::size_t k) { return static_cast<double>(corner(k)[0]) > on_axis; };
  std::vector<std::size_t> first(n);  // vertex of each corner: one on the axis, one for each segment elsewhere
  for (std::size_t k = 0; k < n; ++k) {
    first[k] = mesh.vertices.size();
    const Vector<S, 2>& at = corner(k);
    const double radius = off_axis(k) ? static_cast<double>(at[0]) : 0;
    for (std::size_t s = 0; s < (off_axis(k) ? count : 1); ++s) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(s) / static_cast<double>(count);
      mesh.vertices.emplace_back(static_cast<S>(radius * std::cos(angle)), static_cast<S>(radius * std::sin(angle)),
                                 at[1]);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    const bool from_axis = !off_axis(k), to_axis = !off_axis(next);
    for (std::size_t s = 0; s < count && !(from_axis && to_axis); ++s) {
      const auto vertex = [&](std::size_t c, std::size_t segment, bool single) {
        return static_cast<Index>(first[c] + (single ? 0 : segment % count));
      };
      const Index a = vertex(k, s, from_axis), b = vertex(k, s + 1, from_axis);
      const Index c = vertex(next, s + 1, to_axis), d = vertex(next, s, to_axis);
      if (!from_axis) mesh.triangles.push_back({a, b, c});
      if (!to_axis) mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace hmps::inline HMPS_ABI
