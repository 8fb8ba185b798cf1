// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/particles/detail/fitted_cloud.hpp"
#include "hmps/particles/detail/fitted_field.hpp"
#include "hmps/particles/fitted_settings.hpp"
#include "hmps/search/detail/grid.hpp"

/// The volumes of fitted particles, and the search for parts of the body without particles.
namespace hmps::inline HMPS_ABI::detail {

/// A spacing below `spacing` with which a place without particles would hold one.
[[nodiscard]] inline double finer_spacing(const Layering& here, const FitSettings& settings, double spacing) {
  const double apart = here.thickness / here.count;
  // Where the body is thick enough for particles, they may have been removed for lack of neighbours.
  return std::min(apart < settings.thinnest_spacing * spacing ? apart / settings.thinnest_spacing : apart,
                  0.9 * spacing);
}

/// Whether the straight line from a particle to a sample leaves the body.
template <int D>
[[nodiscard]] bool lies_across_gap(const FittedField<D>& field, const Vector<double, D>& particle,
                                   const Vector<double, D>& sample) {
  constexpr int looks = 16;
  for (int k = 1; k < looks; ++k) {
    const Vector<double, D> on_the_way = particle + static_cast<double>(k) / looks * (sample - particle);
    if (field(on_the_way) > 0.05 * field.spacing()) return true;
  }
  return false;
}

/// Throws `InputError` for a part of the body that holds no particle and is connected to none: a cluster of samples
/// about a spacing or more from their particles, of which even the closest one has its particle across a gap.
template <int D>
void require_no_part_alone(const FittedField<D>& field, const FittedCloud<D>& cloud, const std::vector<Index>& owner,
                           const FitSettings& settings) {
  const auto& samples = field.samples();
  const double l0 = field.spacing(), beside = 0.45 * l0;
  const auto place_of_particle = [&](std::size_t k) { return cloud.particles()[owner[k]].place; };
  std::vector<std::size_t> apart;
  for (std::size_t k = 0; k < samples.size(); ++k)
    if ((samples[k].place - place_of_particle(k)).norm() > 0.9 * l0) apart.push_back(k);
  Grid<double, D> grid;
  grid.build(apart.size(), beside, [&](std::size_t i) { return samples[apart[i]].place; });
  std::vector<char> seen(apart.size(), 0);
  std::vector<std::size_t> part;
  for (std::size_t start = 0; start < apart.size(); ++start) {
    if (seen[start]) continue;
    part.assign(1, start);
    seen[start] = 1;
    double volume = 0, least = std::numeric_limits<double>::infinity();
    std::size_t nearest = apart[start];
    for (std::size_t at = 0; at < part.size(); ++at) {
      const std::size_t k = apart[part[at]];
      volume += samples[k].volume;
      const double distance = (samples[k].place - place_of_particle(k)).norm();
      if (distance < least) {
        least = distance;
        nearest = k;
      }
      grid.visit(samples[k].place, beside, [&](Index i, double) {
        if (seen[i]) return;
        part.push_back(i);
        seen[i] = 1;
      });
    }
    const auto& place = samples[nearest].place;
    if (volume < std::pow(l0, D) || !lies_across_gap(field, place_of_particle(nearest), place)) continue;
    const Layering here = field.layering(place);
    throw_input_error({"hmps: a part of the body at (", place, "), about ", here.thickness,
                       " m thick, holds no particle, and the nearest one lies across a gap; give a spacing of at "
                       "most ",
                       finer_spacing(here, settings, l0), " m, fewer least_layers, or a body without that part"});
  }
}

/// The volume of each particle: each sample belongs to the nearest particle.
template <int D>
[[nodiscard]] std::vector<double> fitted_volumes(const FittedField<D>& field, const FittedCloud<D>& cloud,
                                                 const FitSettings& settings, const AnyExecutor& execute) {
  const auto& samples = field.samples();
  const auto& particles = cloud.particles();
  const double l0 = field.spacing(), farthest = settings.longest_edge * l0;
  Grid<double, D> grid;
  grid.build(particles.size(), l0, [&](std::size_t i) { return particles[i].place; });
  std::vector<Index> owner(samples.size());
  guarded(execute)(samples.size(), [&](std::size_t k) {
    double least = std::numeric_limits<double>::infinity();
    owner[k] = no_index;
    for (double radius = std::min(l0, farthest); owner[k] == no_index; radius = std::min(2 * radius, farthest)) {
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
    if (owner[k] == no_index) {
      const Layering here = field.layering(samples[k].place);
      require(!here.thick, "hmps: no particle lies within ", settings.longest_edge, " spacings of (", samples[k].place,
              "), in a part of the body that is not a wall; give a spacing below ", l0,
              " m, or a longest_edge of a few spacings");
      throw_input_error({"hmps: the body is about ", here.thickness, " m thick at (", samples[k].place,
                         "), too thin for ", here.count, " layers of spacing ", l0, " m, and more than ",
                         settings.longest_edge, " spacings from any particle; give a spacing of at most ",
                         finer_spacing(here, settings, l0), " m, or fewer least_layers"});
    }
    volumes[owner[k]] += samples[k].volume;
  }
  require_no_part_alone(field, cloud, owner, settings);
  return volumes;
}

}  // namespace hmps::inline HMPS_ABI::detail
