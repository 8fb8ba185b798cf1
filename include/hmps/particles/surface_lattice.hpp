// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// A point of the plane in integer multiples of 2^-29 of the surface's extent, which makes orientation tests exact in
/// 64 bits.
using PlanePoint = std::array<std::int64_t, 2>;

/// The side of the line a, b on which the point p lies: +1 left, -1 right. A point on the line takes the side of p
/// shifted by an infinitesimal step along x and a still smaller one along y. 0 only if a = b. With one rule for all
/// triangles, a column crosses each closed surface equally often upwards and downwards.
[[nodiscard]] inline int side(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) {
  const std::int64_t dx = b[0] - a[0];
  const std::int64_t dy = b[1] - a[1];
  const std::int64_t turn = dx * (p[1] - a[1]) - dy * (p[0] - a[0]);
  const auto sign = [](std::int64_t n) { return n > 0 ? 1 : n < 0 ? -1 : 0; };
  return turn != 0 ? sign(turn) : dy != 0 ? -sign(dy) : sign(dx);
}

/// A crossing of a column along z with a triangle.
struct Crossing {
  std::size_t column;
  double z;   ///< m
  int winds;  ///< +1 where the column leaves an outward-oriented surface going up, -1 where it enters
};

/// Maps positions to `PlanePoint`s.
struct PlaneGrid {
  std::array<double, 2> lower{};
  double steps_per_metre = 0;
  [[nodiscard]] std::int64_t operator()(int axis, double coordinate) const {
    return std::llround((coordinate - lower[static_cast<std::size_t>(axis)]) * steps_per_metre);
  }
};

/// Throws `InputError` if the extent of a surface and the spacing seem to be in different units: more sites than can be
/// sampled, or a spacing larger than the surface.
template <class S>
void require_plausible(const SurfaceMesh<S>& mesh, const Box<S, 3>& box, double spacing) {
  if (!is_finite(spacing) || spacing <= 0) return;  // `lattice_sites` reports this
  const Vector<double, 3> extent = (box.upper - box.lower).template cast<double>();
  double sites = 1, largest = extent[0];
  for (int c = 0; c < 3; ++c) {
    sites *= std::max(extent[c] / spacing, 1.0);
    largest = std::max(largest, extent[c]);
  }
  require(sites <= most_sites, "hmps: ", mesh.source, " is ", largest, " m large and holds about ", sites,
          " lattice sites of spacing ", spacing,
          " m: give both in metres (a file in millimetres is read with a scale of 1e-3), or a larger spacing");
  require(spacing <= largest, "hmps: ", mesh.source, " is ", largest, " m large, less than one spacing of ", spacing,
          " m: give both in metres (1 mm is 1e-3), or a smaller spacing");
}

/// All crossings of the columns of `sites` with the triangles, ordered by column and height.
template <class S>
[[nodiscard]] std::vector<Crossing> crossings(const SurfaceMesh<S>& mesh, const LatticeSites<3>& sites,
                                              const PlaneGrid& grid) {
  std::array<std::vector<std::int64_t>, 2> lines;
  for (int axis = 0; axis < 2; ++axis)
    for (std::int64_t k = 0; k < sites.count[axis]; ++k)
      lines[static_cast<std::size_t>(axis)].push_back(grid(axis, sites.coordinate(axis, k)));

  std::vector<Crossing> result;
  for (const auto& t : mesh.triangles) {
    std::array<PlanePoint, 3> p{};
    std::array<double, 3> z{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector<double, 3> vertex = mesh.vertices[t[c]].template cast<double>();
      p[c] = {grid(0, vertex[0]), grid(1, vertex[1])};
      z[c] = vertex[2];
    }
    std::array<std::size_t, 2> first{};
    std::array<std::size_t, 2> last{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto& line = lines[axis];
      const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
      first[axis] = static_cast<std::size_t>(std::lower_bound(line.begin(), line.end(), low) - line.begin());
      last[axis] = static_cast<std::size_t>(std::upper_bound(line.begin(), line.end(), high) - line.begin());
    }
    for (std::size_t i = first[0]; i < last[0]; ++i) {
      for (std::size_t j = first[1]; j < last[1]; ++j) {
        const PlanePoint x{lines[0][i], lines[1][j]};
        const int turn = side(p[0], p[1], x);
        if (turn == 0 || side(p[1], p[2], x) != turn || side(p[2], p[0], x) != turn) continue;
        const auto weight = [&](std::size_t a, std::size_t b) {
          return static_cast<double>((p[b][0] - p[a][0]) * (x[1] - p[a][1]) - (p[b][1] - p[a][1]) * (x[0] - p[a][0]));
        };
        const double w0 = weight(1, 2);
        const double w1 = weight(2, 0);
        const double w2 = weight(0, 1);
        const double height = (w0 * z[0] + w1 * z[1] + w2 * z[2]) / (w0 + w1 + w2);
        result.push_back({i * lines[1].size() + j, height, turn});
      }
    }
  }
  std::sort(result.begin(), result.end(), [](const Crossing& a, const Crossing& b) {
    return a.column != b.column ? a.column < b.column : a.z != b.z ? a.z < b.z : a.winds < b.winds;
  });
  return result;
}

}  // namespace detail

/// Fills the closed surface `mesh` with particles on a simple cubic lattice, in the order of `fill_lattice` for
/// implicit shapes. Intersects columns along z with the triangles, in time linear in triangles, crossings and sites.
/// A site is inside if its winding number is not zero: overlapping parts are united, and an inverted part within
/// another is a hole. Sites on the lower sides of the surface are inside, so that a box of n spacings holds n sites per
/// direction whatever the origin.
///
/// Throws `InputError` as `require_closed` does, for a spacing that is not positive, for too many sites, for a
/// spacing larger than the surface, and for one that rounding to `S` does not resolve to a hundredth.
template <class S, Executor E = Serial>
[[nodiscard]] std::vector<Vector<S, 3>> fill_lattice(
    const SurfaceMesh<S>& mesh, std::type_identity_t<S> spacing,
    const std::type_identity_t<Vector<S, 3>>& origin = Vector<S, 3>::Zero(), const E& execute = {}) {
  require_closed(mesh);
  const Box<S, 3> box = bounds(mesh);
  detail::require_plausible(mesh, box, static_cast<double>(spacing));
  const auto sites = detail::lattice_sites<S, 3>(box, spacing, origin);
  const Vector<double, 3> lower = box.lower.template cast<double>();
  const double extent =
      std::max((box.upper - box.lower).template cast<double>().maxCoeff(), static_cast<double>(spacing));
  const detail::PlaneGrid grid{{lower[0], lower[1]}, 536870912.0 / extent};
  const auto crossings = detail::crossings(mesh, sites, grid);

  const auto rows = static_cast<std::size_t>(sites.count[1]);
  std::vector<std::vector<Vector<S, 3>>> slabs(static_cast<std::size_t>(sites.count[0]));
  detail::guarded(execute)(slabs.size(), [&](std::size_t slab) {
    const auto before = [](const detail::Crossing& crossing, std::size_t column) { return crossing.column < column; };
    auto at = std::lower_bound(crossings.begin(), crossings.end(), slab * rows, before);
    const auto end = std::lower_bound(at, crossings.end(), (slab + 1) * rows, before);
    while (at != end) {
      const std::size_t column = at->column;
      Vector<S, 3> x;
      x[0] = static_cast<S>(sites.coordinate(0, static_cast<std::int64_t>(slab)));
      x[1] = static_cast<S>(sites.coordinate(1, static_cast<std::int64_t>(column - slab * rows)));
      // The first site at or above a height.
      const auto site = [&](double z) {
        const double k = std::ceil((z - sites.coordinate(2, 0)) / sites.spacing - 1e-9);
        return static_cast<std::int64_t>(std::clamp(k, 0.0, static_cast<double>(sites.count[2])));
      };
      int winding = 0;
      for (; at != end && at->column == column; ++at) {
        winding += at->winds;
        if (winding == 0 || at + 1 == end) continue;
        for (std::int64_t k = site(at->z); k < site((at + 1)->z); ++k) {
          x[2] = static_cast<S>(sites.coordinate(2, k));
          slabs[slab].push_back(x);
        }
      }
    }
  });
  return detail::joined<S, 3>(slabs, execute);
}

}  // namespace hmps::inline HMPS_ABI
