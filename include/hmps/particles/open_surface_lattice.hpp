// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/disjoint_sets.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/particles/surface_lattice.hpp"
#include "hmps/shapes/detail/surface_edges.hpp"
#include "hmps/shapes/surface_mesh.hpp"
#include "hmps/shapes/triangle_tree.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `fill_open_lattice`: the particles, and the assumptions that were made.
template <class S>
struct OpenLattice {
  std::vector<Vector<S, 3>> points;  ///< m
  std::size_t open_edges = 0;        ///< edges of one triangle
  std::size_t crowded_edges = 0;     ///< edges of three, five, ... triangles: flaps and inner walls
  std::size_t holes = 0;             ///< connected groups of open edges
  double largest_hole = 0;           ///< diagonal in m of the bounding box of the largest hole
  /// Number of sites, inside or outside, with a winding number between 0.25 and 0.75 in magnitude. They lie near holes,
  /// where the surface does not determine what is inside.
  std::size_t doubtful_sites = 0;
};

namespace detail {

/// Writes the number of holes and the size of the largest one to `result`.
template <class S>
void measure_holes(const SurfaceMesh<S>& mesh, const std::vector<EdgeUse>& edges, OpenLattice<S>& result) {
  DisjointSets groups(mesh.vertices.size());
  const auto is_open = [](const EdgeUse& edge) { return edge.uses() == 1; };
  for (const EdgeUse& edge : edges)
    if (is_open(edge)) groups.join(edge.low, edge.high);
  std::map<Index, Box<S, 3>> holes;
  for (const EdgeUse& edge : edges) {
    if (!is_open(edge)) continue;
    for (const Index v : {edge.low, edge.high}) {
      const Vector<S, 3>& x = mesh.vertices[v];
      Box<S, 3>& box = holes.try_emplace(groups.lowest(v), Box<S, 3>{x, x}).first->second;
      box.lower = box.lower.cwiseMin(x);
      box.upper = box.upper.cwiseMax(x);
    }
  }
  result.holes = holes.size();
  for (const auto& [group, box] : holes)
    result.largest_hole = std::max(result.largest_hole, static_cast<double>((box.upper - box.lower).norm()));
}

}  // namespace detail

/// Fills a surface that need not be closed with lattice sites, as `fill_lattice` does: a site is inside if its winding
/// number exceeds one half (Jacobson et al. 2013). This closes each hole with a smooth cover; the smaller the hole, the
/// less its cover matters. For a closed surface the points are those of `fill_lattice`. Check the other results: many
/// doubtful sites mean that the shape is a guess. Takes a few microseconds per site of the bounding box. Slabs run
/// through `execute`; the result does not depend on it.
///
///     const auto mesh = read_surface<double>("organ.stl", {.scale = 1e-3, .closed = false});
///     const auto [points, open_edges, crowded, holes, largest_hole, doubtful] = fill_open_lattice(mesh, 1.2e-3);
///
/// @param mesh  welded; triangles may be missing, but neighbours must have consistent orientation
/// Throws `InputError` as `fill_lattice` does, for repeated triangles, for neighbours of opposite orientation, and for
/// a surface that does not clearly enclose any site (winding number of 0.75 or more).
template <class S, Executor E = Serial>
[[nodiscard]] OpenLattice<S> fill_open_lattice(const SurfaceMesh<S>& mesh, std::type_identity_t<S> spacing,
                                               const std::type_identity_t<Vector<S, 3>>& origin = Vector<S, 3>::Zero(),
                                               const E& execute = {}) {
  const TriangleTree tree(mesh);
  const auto edges = detail::edge_uses(mesh.triangles);
  const detail::EdgeFaults<S> faults(mesh, edges);
  detail::require_single(mesh, faults);
  detail::require_oriented(mesh, faults);
  OpenLattice<S> result;
  result.open_edges = faults.open.count;
  result.crowded_edges = faults.crowded.count;
  detail::measure_holes(mesh, edges, result);

  const Box<S, 3> box = bounds(mesh);
  detail::require_plausible(mesh, box, static_cast<double>(spacing));
  const auto sites = detail::lattice_sites<S, 3>(box, spacing, origin);
  // Sites on the lower sides of the surface are inside, as in `fill_lattice`.
  const auto shift =
      detail::tie_shift<double, 3>(detail::surface_tolerance<S, 3>(box, static_cast<double>(spacing), origin));
  std::vector<std::vector<Vector<S, 3>>> slabs(static_cast<std::size_t>(sites.count[0]));
  std::vector<std::size_t> doubtful(slabs.size(), 0), sure(slabs.size(), 0);
  detail::guarded(execute)(slabs.size(), [&](std::size_t slab) {
    std::size_t in_doubt = 0, surely_inside = 0;
    Vector<double, 3> x;
    x[0] = sites.coordinate(0, static_cast<std::int64_t>(slab));
    for (std::int64_t j = 0; j < sites.count[1]; ++j) {
      x[1] = sites.coordinate(1, j);
      for (std::int64_t k = 0; k < sites.count[2]; ++k) {
        x[2] = sites.coordinate(2, k);
        const double winding = std::abs(tree.winding_number(x + shift));
        if (winding > 0.25 && winding < 0.75) ++in_doubt;
        if (winding >= 0.75) ++surely_inside;
        if (winding > 0.5) slabs[slab].push_back(x.template cast<S>());
      }
    }
    doubtful[slab] = in_doubt;
    sure[slab] = surely_inside;
  });
  for (const std::size_t count : doubtful) result.doubtful_sites += count;
  result.points = detail::joined<S, 3>(slabs, execute);
  // A flat sheet has a winding number of one half on itself, so that rounding may classify its sites as inside.
  detail::require(std::any_of(sure.begin(), sure.end(), [](std::size_t count) { return count > 0; }),
                  "hmps: ", mesh.source, ", which is open at ", result.open_edges,
                  " edges, does not clearly enclose any lattice site of spacing ", spacing,
                  " m (winding number 0.75 or more): it is too open, or the spacing is too large");
  return result;
}

}  // namespace hmps::inline HMPS_ABI
