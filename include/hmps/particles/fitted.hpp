// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/particles/detail/fitted_cloud.hpp"
#include "hmps/particles/detail/fitted_field.hpp"
#include "hmps/particles/detail/fitted_samples.hpp"
#include "hmps/particles/detail/fitted_volumes.hpp"
#include "hmps/particles/fitted_settings.hpp"
#include "hmps/particles/surface_lattice.hpp"
#include "hmps/search/fixed_radius.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/mesh_distance.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `fit_particles`.
template <class S, int D>
struct FittedParticles {
  std::vector<Vector<S, D>> positions;  ///< m
  std::vector<S> volumes;               ///< of each particle in m3 (2D: m2); their sum is the volume of the body
  std::vector<int> layers;              ///< number of layers through the wall at each particle, 0 in bulk
  std::vector<S> layer_spacings;        ///< distance of these layers in m, l0 in bulk
  /// The share of the surface around each particle (within 1.5 spacings, deep inside walls 3) that belongs to an edge,
  /// from 0 to 1: the largest ball in the body that touches the surface there meets a neighbouring face instead of the
  /// opposite one. A wall ends in an edge as deep as half its thickness. In bulk it is 0. A face at a plane of
  /// symmetry counts as an edge although none is there: set it to 0 beside such a face.
  std::vector<S> edges;
  double spacing = 0;  ///< l0 in m
  int iterations = 0;  ///< number of iterations made
  /// The largest deviation in m of a particle of the outermost layer from its depth of half a layer.
  double largest_deviation = 0;

  [[nodiscard]] std::size_t size() const { return positions.size(); }

  /// Appends the particles of another part of the body that was fitted separately with the same spacing, such as the
  /// piece by which it is held. The faces where the parts meet are not edges of the whole. Throws `InputError` for a
  /// part with another spacing.
  void append(FittedParticles part) {
    if (spacing > 0 && part.spacing > 0) {
      detail::require(std::abs(part.spacing / spacing - 1) < 1e-6, "hmps: a part with a spacing of ", part.spacing,
                      " m is appended to particles with one of ", spacing, " m; fit both with the same spacing");
      clear_edges(*this, part);
      clear_edges(part, *this);
    }
    if (!(spacing > 0)) spacing = part.spacing;
    const auto add = [](auto& all, const auto& some) { all.insert(all.end(), some.begin(), some.end()); };
    add(positions, part.positions);
    add(volumes, part.volumes);
    add(layers, part.layers);
    add(layer_spacings, part.layer_spacings);
    add(edges, part.edges);
    iterations = std::max(iterations, part.iterations);
    largest_deviation = std::max(largest_deviation, part.largest_deviation);
  }

 private:
  /// Sets to zero the `edges` that particles of `part` owe to the face where it meets the `other` part: the particles
  /// of the other part are half a spacing behind this face, an edge reaches half a thickness from it, and `edges` takes
  /// in 1.5 spacings more.
  static void clear_edges(FittedParticles& part, const FittedParticles& other) {
    const FixedRadiusSearch search(vectors(other.positions));
    for (std::size_t i = 0; i < part.edges.size(); ++i) {
      if (!(part.edges[i] > 0)) continue;
      const double half = 0.5 * part.layers[i] * static_cast<double>(part.layer_spacings[i]);
      if (search.count(part.positions[i], static_cast<S>(half + 2 * part.spacing)) > 0) part.edges[i] = 0;
    }
  }
};

/// Returns particles fitted to the surface of a body at any orientation: those of the outermost layer lie half a layer
/// inside the surface, walls hold a whole number of layers, and all particles are about evenly spaced. They do not lie
/// on a lattice: bond them with a `BondList`.
///
///     const auto fitted = fit_particles(shape, box, l0);
///     const BondList<double, 3> bonds(vectors(fitted.positions), {.spacing = l0});
///
/// The body is the part of `shape` in `box`. Its thickness is the diameter of the largest balls in it that touch
/// opposite sides, up to eight spacings; thicker parts are bulk, where the inner layers fade. A wall of thickness t has
/// n = t / spacing layers, rounded, and at least `least_layers`, which lie t / n apart: from two layers on 0.75 to 1.25
/// spacings, and less only where `least_layers` requires it. Each particle stands for spacing^D whatever n is: where
/// layers are closer, the particles of a layer are further apart, so that a force that treats all volumes as equal is
/// right in sum. The fit starts with a particle wherever a space-filling curve has passed that volume of a layer. Then
/// `iterations` of a repulsion within 1.6 spacings, with a decreasing step, spread the particles within the layers.
/// Finally particles are removed until each has `least_support`. The volume of a particle is that of the samples of the
/// body (4^D per spacing^D, more at the surface) to which it is the nearest particle.
///
/// The result is deterministic and does not depend on the executor. docs/fitted.md says what it is good for.
///
/// @param shape     must be about the signed distance to a depth of a few spacings, above all near the surface; united
///                  parts must overlap, because there is a surface between parts that only touch
/// @param box       in m, tight or not; its faces cut the shape
/// @param spacing   l0 in m
/// Throws `InputError` for a spacing that is not positive or that rounding to `S` does not resolve to a hundredth, a
/// box that is empty, too large or not finite, bad settings, a shape that is NaN (with the position) or no distance at
/// a quarter of its surface, a shape without volume in the box, a body in which no particle has enough support, and,
/// with the position, a part of the body that is thinner than `least_layers` layers of `thinnest_spacing` and reaches
/// further than `longest_edge` beyond the particles, or one that is connected to no particle. Thin edges up to that
/// length are left to the nearest particles.
template <class F, class S, int D, Executor E = Serial>
requires Shape<F, S, D>
[[nodiscard]] FittedParticles<S, D> fit_particles(const F& shape, const Box<S, D>& box, std::type_identity_t<S> spacing,
                                                  const FitSettings& settings = {}, const E& execute = {}) {
  static_assert(D == 2 || D == 3, "hmps: fitted particles have 2 or 3 dimensions");
  detail::validate(settings);
  const double l0 = static_cast<double>(spacing);
  const detail::AnyExecutor loops = std::cref(execute);
  detail::FittedField<D> field(shape, box, l0, settings.least_layers);
  field.sample(loops);
  field.measure(loops);
  const double thinnest = (1 - 1e-5) * settings.thinnest_spacing * l0;  // tolerates the rounding of a thickness
  detail::FittedCloud<D> cloud(field, thinnest);
  cloud.seed(loops);
  for (int k = 0; k < settings.iterations; ++k) {
    const double left = 1 - static_cast<double>(k) / settings.iterations;
    const double move = cloud.iterate(k, left, loops);
    if (settings.progress) settings.progress(FitProgress{k + 1, settings.iterations, move});
  }
  cloud.settle(loops);
  if (settings.least_support > 0) cloud.remove_weak(settings.least_support);

  FittedParticles<S, D> result;
  result.spacing = l0;
  result.iterations = settings.iterations;
  for (const double volume : detail::fitted_volumes(field, cloud, settings, loops))
    result.volumes.push_back(static_cast<S>(volume));
  result.positions.reserve(cloud.particles().size());
  for (const auto& p : cloud.particles()) {
    result.positions.push_back(p.place.template cast<S>());
    result.layers.push_back(p.layers.thick ? 0 : p.layers.count);
    result.layer_spacings.push_back(static_cast<S>(p.layers.spacing));
    result.edges.push_back(static_cast<S>(p.layers.edge));
    if (p.layers.layer(p.depth) == 0)
      result.largest_deviation = std::max(result.largest_deviation, std::abs(p.depth - p.layers.level(0)));
  }
  return result;
}

/// The same for the body inside a closed surface, whose distance is `MeshDistance`:
///
///     const auto fitted = fit_particles(read_surface("organ.stl", 1e-3), l0);
///
/// Also throws `InputError` as `require_closed` does, and for a spacing that seems to be in a different unit from the
/// surface.
template <class S, Executor E = Serial>
[[nodiscard]] FittedParticles<S, 3> fit_particles(const SurfaceMesh<S>& mesh, std::type_identity_t<S> spacing,
                                                  const FitSettings& settings = {}, const E& execute = {}) {
  require_closed(mesh);
  const MeshDistance<S> shape(mesh);
  detail::require_plausible(mesh, shape.box(), static_cast<double>(spacing));
  return fit_particles(shape, shape.box(), spacing, settings, execute);
}

}  // namespace hmps::inline HMPS_ABI
