// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/particles/fitted_cloud.hpp"
#include "hmps/particles/fitted_field.hpp"
#include "hmps/particles/fitted_samples.hpp"
#include "hmps/search/grid.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI {

/// How `fit_particles` fits.
struct FitSettings {
  int least_layers = 2;           ///< across a wall, from 1 to 8; more where they fit
  double thinnest_spacing = 0.6;  ///< of layers, in spacings, above 0: walls that would need less get no particles
  double longest_edge = 4;        ///< in spacings: how far such parts may reach beyond the outermost particles
  int iterations = 200;           ///< of the repulsion, at least 1
};

/// What the progress hook of `fit_particles` is told after each iteration.
struct FitProgress {
  int iteration;   ///< counted from 1
  int iterations;  ///< that will be made
  double move;     ///< the longest move of a particle in this iteration in m
};

/// The progress hook that does nothing.
struct NoFitProgress {
  constexpr void operator()(const FitProgress&) const {}
};

/// What `fit_particles` returns.
template <class S, int D>
struct FittedParticles {
  std::vector<Vector<S, D>> positions;  ///< m
  std::vector<S> volumes;               ///< of each particle in m3 (2D: m2); their sum is the volume of the body
  std::vector<int> layers;              ///< through the wall where each particle lies, 0 in bulk
  std::vector<S> layer_spacings;        ///< their distance in m
  int iterations = 0;                   ///< made
  /// The largest distance in m of a particle of the outermost layer from half a layer inside the surface.
  double largest_distance = 0;

  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

namespace detail {

inline void validate(const FitSettings& s) {
  require(s.least_layers >= 1 && s.least_layers <= 8, "hmps: the least number of layers to fit is ", s.least_layers,
          "; give one from 1 to 8 (a wall needs 2 to bend)");
  require(s.thinnest_spacing > 0 && s.thinnest_spacing <= 1, "hmps: the thinnest spacing of layers to fit is ",
          s.thinnest_spacing, " spacings; give a share above 0 and up to 1 (0.6 is the default)");
  require(s.longest_edge > 0 && s.longest_edge <= 100, "hmps: the longest edge without particles is ", s.longest_edge,
          " spacings; give a positive number up to 100");
  require(s.iterations >= 1, "hmps: ", s.iterations, " iterations are to fit the particles; make at least one");
}

/// The volume of each particle: each sample belongs to the nearest one.
template <class Field, class Cloud, class E>
[[nodiscard]] std::vector<double> fitted_volumes(const Field& field, const Cloud& cloud, const FitSettings& settings,
                                                 const E& execute) {
  const auto& samples = field.samples();
  const auto& particles = cloud.particles();
  constexpr Index nobody = std::numeric_limits<Index>::max();
  const double l0 = field.spacing(), farthest = settings.longest_edge * l0;
  Grid<double, Field::dimension> grid;
  grid.build(particles.size(), l0, [&](std::size_t i) { return particles[i].place; });
  std::vector<Index> owner(samples.size());
  execute(samples.size(), [&](std::size_t k) {
    double least = std::numeric_limits<double>::infinity();
    owner[k] = nobody;
    for (double radius = std::min(l0, farthest); owner[k] == nobody; radius = std::min(2 * radius, farthest)) {
      grid.visit(samples[k].place, radius, [&](Index i, double squared) {
        if (squared < least || (squared == least && i < owner[k])) {
          least = squared;
          owner[k] = i;
        }
      });
      if (radius >= farthest) break;
    }
  });
  std::vector<double> volumes(particles.size(), 0.0);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (owner[k] == nobody) {
      const Layering here = field.layering(samples[k].place);
      require(!here.thick, "hmps: no particle lies within ", settings.longest_edge, " spacings of (",
              samples[k].place.transpose(), "), in a part of the body that is no wall; give a spacing below ", l0,
              " m, or a longest_edge of some spacings");
      throw InputError(message("hmps: the body is about ", here.thickness, " m thick at (",
                               samples[k].place.transpose(), "), too thin for ", here.count, " layers of spacing ", l0,
                               " m, and more than ", settings.longest_edge,
                               " spacings from any particle; give a spacing of at most ",
                               here.thickness / (settings.thinnest_spacing * here.count), " m, or fewer least_layers"));
    }
    volumes[owner[k]] += samples[k].volume;
  }
  return volumes;
}

}  // namespace detail

/// Particles that are fitted to the surface of a body, whichever way it lies: those of the outermost layer lie half a
/// layer inside the surface, walls hold a whole number of layers, and all are about evenly spaced. They lie on no
/// lattice: bond them with a `BondList`.
///
///     const auto fitted = fit_particles(shape, box, l0);
///     const BondList<double, 3> bonds(vectors(fitted.positions), {.spacing = l0});
///
/// The body is the part of `shape` in `box`. Its thickness is that of the largest balls in it that touch opposite
/// sides, up to eight spacings; what is thicker is bulk, where the inner layers fade. A wall of thickness t has
/// n = t / spacing layers, rounded, and at least `least_layers`, which lie t / n apart: 0.75 to 1.25 spacings from two
/// layers on, and less only where `least_layers` asks for it. Each particle stands for spacing^D whatever n: where
/// layers are closer, particles of a layer are wider apart, so that a force that takes all volumes as equal is right
/// in sum. Start: a particle wherever that volume of a layer has been passed along a space-filling curve. Then
/// `iterations` of a repulsion within 1.6 spacings, with a falling step, within the layers. The volume of a particle is
/// that of the samples of the body (4^D per spacing^D, more at the surface) that it is the nearest to.
///
/// The result is deterministic and does not depend on the executor. docs/fitted.md says what it is good for.
///
/// @param shape     must be about the signed distance to a depth of a few spacings, above all near the surface: parts
///                  that are united must overlap, since where they only touch there is a surface in between
/// @param box       in m, tight or not; its faces cut
/// @param spacing   l0 in m
/// @param progress  called as progress(FitProgress) after each iteration
/// Throws `InputError` for a spacing that is not positive, a box that is empty, too large or not finite, bad settings,
/// a shape that is NaN, with the position, a shape without volume in the box, and a part of the body that is thinner
/// than `least_layers` layers of `thinnest_spacing` and reaches further than `longest_edge` beyond the particles, with
/// the place. Thin edges up to that length are left to the nearest particles.
template <class F, class S, int D, Executor E = Serial, std::invocable<const FitProgress&> Progress = NoFitProgress>
requires Shape<F, S, D>
[[nodiscard]] FittedParticles<S, D> fit_particles(const F& shape, const Box<S, D>& box, std::type_identity_t<S> spacing,
                                                  const FitSettings& settings = {}, const E& execute = {},
                                                  Progress&& progress = {}) {
  static_assert(D == 2 || D == 3, "hmps: fitted particles have 2 or 3 dimensions");
  detail::validate(settings);
  const double l0 = static_cast<double>(spacing);
  detail::FittedField<F, S, D> field(shape, box, l0, settings.least_layers);
  field.sample(execute);
  field.measure(execute);
  const double thinnest = (1 - 1e-5) * settings.thinnest_spacing * l0;  // whatever the rounding of a thickness
  detail::FittedCloud<decltype(field), D> cloud(field, thinnest);
  cloud.seed(execute);
  for (int k = 0; k < settings.iterations; ++k) {
    const double left = 1 - static_cast<double>(k) / settings.iterations;
    const double move = cloud.iterate(k, left, execute);
    progress(FitProgress{k + 1, settings.iterations, move});
  }
  cloud.settle(execute);

  FittedParticles<S, D> result;
  result.iterations = settings.iterations;
  for (const double volume : detail::fitted_volumes(field, cloud, settings, execute))
    result.volumes.push_back(static_cast<S>(volume));
  result.positions.reserve(cloud.particles().size());
  for (const auto& p : cloud.particles()) {
    result.positions.push_back(p.place.template cast<S>());
    result.layers.push_back(p.layers.thick ? 0 : p.layers.count);
    result.layer_spacings.push_back(static_cast<S>(p.layers.spacing));
    if (p.layers.layer(p.depth) == 0)
      result.largest_distance = std::max(result.largest_distance, std::abs(p.depth - p.layers.level(0)));
  }
  return result;
}

}  // namespace hmps::inline HMPS_ABI
