// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/detail/resolution.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/surface_mesh.hpp"
#include "hmps/shapes/triangle_tree.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
/// Throws `InputError` if `distance` (m) is larger than the cloud of `points`, for example if given in millimetres, and
/// if `patch` spans a hundred times as much as the cloud, as it does in millimetres.
template <class T, class S>
void require_extent(const VectorView<T, 3>& points, const SurfaceMesh<S>& patch, double distance) {
  const Box<S, 3> box = bounds(patch);
  if (points.size() < 2) return;
  Vector<double, 3> low = points[0].template cast<double>(), high = low;
  for (std::size_t i = 1; i < points.size(); ++i) {
    low = low.cwiseMin(points[i].template cast<double>());
    high = high.cwiseMax(points[i].template cast<double>());
  }
  const double extent = (high - low).norm(), of_patch = static_cast<double>((box.upper - box.lower).norm());
  require(distance <= extent, "hmps: the distance of particles to a patch is to be at most ", distance,
          " m, but all particles lie within ", extent,
          " m of each other, so that all of them would qualify; give a distance such as the spacing, in metres");
  require(of_patch < 100 * extent, "hmps: ", patch.source, " spans ", of_patch, " m, but the particles span only ",
          extent, " m; give both in metres (a file in millimetres is read with a scale of 1e-3)");
}
}  // namespace detail

/// The particles that lie within `distance` (m) of the patch, or beyond it by rounding (1e-5 of it and a few units in
/// the last place of the coordinates), for example those to be held by `hold`, by `ControlRegion` or, as
/// `~particles_near(...)`, by the `moves` of `relax`. Hold one layer: a body begins to deform at the particles that are
/// held, so that with two of them it is rigid for one spacing more. At a face along the lattice, 0.99 spacings select
/// one layer; at a face at an angle to it they select one to two layers, of which `surface_layers(...).outermost` is
/// one. Throws `InputError` if there is no such particle, for a distance that is not positive or is larger than the
/// body, for a surface in another unit than the particles, and for a broken surface.
template <class T, class S, Executor E = Serial>
[[nodiscard]] ParticleSet particles_near(const VectorView<T, 3>& points, const SurfaceMesh<S>& patch, double distance,
                                         const E& execute = {}) {
  detail::require(detail::is_finite(distance) && distance > 0, "hmps: the largest distance of particles to a patch is ",
                  distance, " m; it must be positive, such as the spacing");
  require_finite(points, "the position");
  detail::require_extent(points, patch, distance);
  const double reach = (1 + 1e-5) * distance + detail::rounding_of_distances(points) +
                       detail::rounding_of_distances(vectors(patch.vertices));
  const TriangleTree tree(patch);
  std::vector<char> is_near(points.size(), 0);
  detail::guarded(execute)(points.size(), [&](std::size_t i) {
    is_near[i] = tree.distance(points[i].template cast<double>()) <= reach ? 1 : 0;
  });
  ParticleSet found(points.size(), [&](std::size_t i) { return is_near[i] != 0; });
  detail::require(
      !found.empty(), "hmps: no particle lies within ", distance, " m of ", patch.source,
      "; check that both are in metres, and that the body has particles there: a part thinner than a spacing or two "
      "has none, or supported_particles leaves them out; else give a larger distance");
  return found;
}

}  // namespace hmps::inline HMPS_ABI
