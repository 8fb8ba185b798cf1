// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "hmps/bonds/bond_settings.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/search/fixed_radius.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Throws `InputError` if `settings` do not fit the cloud of `search`: if a quarter of its particles have more than
/// 2.5 times the neighbours expected within the radius (on a lattice at most 1.6 times) or all have more than 4 times
/// as many on average, if nine in ten have none, or if the nearest neighbour typically lies further away than 1.25
/// spacings (1.12 in the densest packing). All occur when metres and millimetres are mixed. The first would take memory
/// quadratic in the number of particles, so a sample of 64 particles, spread over the cloud, is tested in advance. The
/// tests for too few neighbours are made only if `also_alone` is set.
template <class T, int D>
void require_plausible_spacing(const FixedRadiusSearch<T, D>& search, const BondSettings& settings,
                               typename VectorView<T, D>::Scalar radius, bool also_alone = true) {
  constexpr std::size_t most_samples = 64;
  constexpr double ball = (D == 3 ? 4. / 3 : 1.) * std::numbers::pi;  // volume for radius 1, particles at spacing 1
  const double usual = std::max(2.0 * D, ball * std::pow(settings.radius_ratio, D));
  const std::size_t n = search.points().size(), samples = std::min(n, most_samples);
  if (n < 2) return;
  // Equal steps could hit one face of a lattice only.
  const auto sample = [&](std::size_t k) {
    const double within = std::fmod(static_cast<double>(k) * std::numbers::phi, 1.0);
    return std::min(n - 1, (k * n + static_cast<std::size_t>(within * static_cast<double>(n))) / samples);
  };
  std::vector<std::size_t> counts;
  std::size_t sum = 0, alone = 0, most = 0, fullest = 0, lonely = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t i = sample(k);
    const std::size_t neighbours = search.count(search.points()[i], radius) - 1;
    counts.push_back(neighbours);
    sum += neighbours;
    if (neighbours > most) {
      most = neighbours;
      fullest = i;
    }
    if (neighbours == 0 && alone++ == 0) lonely = i;
  }
  const auto nearest = [&] {
    std::vector<double> distance(samples);
    for (std::size_t k = 0; k < samples; ++k) distance[k] = static_cast<double>(search.nearest(sample(k)));
    std::nth_element(distance.begin(), distance.begin() + static_cast<std::ptrdiff_t>(samples / 2), distance.end());
    return distance[samples / 2];
  };
  const double mean = static_cast<double>(sum) / static_cast<double>(samples);
  const auto quarter = counts.begin() + static_cast<std::ptrdiff_t>(3 * samples / 4);  // most may lie at the surface
  std::nth_element(counts.begin(), quarter, counts.end());
  if (mean > 4 * usual || static_cast<double>(*quarter) > 2.5 * usual)
    throw_input_error({"hmps: particle ", fullest, " has ", most, " neighbours within the effective radius of ", radius,
                       " m, ", samples, " particles that were sampled have ", std::round(mean),
                       " on average, but a spacing of ", settings.spacing, " m gives about ", std::round(usual),
                       "; the typical distance to the nearest particle is ", nearest(),
                       " m: give a spacing of that size, in the unit of the positions"});
  if (!also_alone) return;
  const double apart = nearest();
  if (10 * alone >= 9 * samples) {
    const std::string remedy = apart < 1.5 * settings.spacing
                                   ? message("the radius of ", settings.radius_ratio,
                                             " spacings is too short; radius_ratio is a number of "
                                             "spacings, not metres, such as 1.75")
                                   : message("a spacing of ", settings.spacing,
                                             " m looks wrong; give a spacing of that size, in the unit of "
                                             "the positions");
    throw_input_error({"hmps: particle ", lonely, " has 0 neighbours within the effective radius of ", radius,
                       " m, and so have ", alone, " of ", samples,
                       " particles that were sampled; the typical distance to the nearest particle is ", apart,
                       " m: ", remedy});
  }
  require(apart <= 1.25 * settings.spacing, "hmps: the typical distance to the nearest particle is ", apart, " m, ",
          apart / settings.spacing, " times the spacing of ", settings.spacing,
          " m, but particles that fill a body lie at most 1.12 spacings from the nearest; give a spacing of that size, "
          "in the unit of the positions");
}

}  // namespace hmps::inline HMPS_ABI::detail
