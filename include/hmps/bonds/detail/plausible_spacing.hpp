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

/// The number of the particle of `n` that is sample `k` of `samples`: spread over all of them in unequal steps, because
/// equal ones could hit one face of a lattice only.
inline std::size_t spread_sample(std::size_t k, std::size_t samples, std::size_t n) {
  const double within = std::fmod(static_cast<double>(k) * std::numbers::phi, 1.0);
  return std::min(n - 1, (k * n + static_cast<std::size_t>(within * static_cast<double>(n))) / samples);
}

/// The spacing (m) of the square or cubic lattice that the sampled particles of `search` form, at any angle, whose
/// distances to the nearest particle are `nearest` (m, of which the median is `apart`); 0 if they do not form one, or
/// if it is a single line or layer. On such a lattice the nearest distances are equal, most particles have a
/// neighbour on at least 2 D - 1 sides, and the next ones are on the diagonals.
template <class T, int D>
double sampled_lattice_spacing(const FixedRadiusSearch<T, D>& search, const std::vector<double>& nearest,
                               double apart) {
  constexpr double regular = 1e-3;  // of the distance
  for (const double distance : nearest)
    if (std::abs(distance - apart) > regular * apart) return 0;
  std::size_t sides = 0, before_diagonals = 0, with_diagonals = 0;
  for (std::size_t k = 0; k < nearest.size(); ++k) {
    const auto& x = search.points()[spread_sample(k, nearest.size(), search.points().size())];
    const auto within = [&](double ratio) {
      return search.count(x, static_cast<typename VectorView<T, D>::Scalar>(ratio * apart)) - 1;
    };
    sides = std::max(sides, within(1.02));
    before_diagonals = std::max(before_diagonals, within(1.3));
    with_diagonals = std::max(with_diagonals, within(1.5));
  }
  const bool is_lattice = sides + 1 >= 2 * std::size_t{D} && sides <= 2 * std::size_t{D} && before_diagonals == sides &&
                          with_diagonals > sides;
  return is_lattice ? apart : 0;
}

/// Throws `InputError` if `settings` do not fit the cloud of `search`:
/// - if its particles have, on average, more than four times the neighbours expected within the radius, for which a
///   list would take memory quadratic in their number;
/// - if a quarter of them have more than 3.5 times as many, and the nearest one is typically closer than 0.8 spacings;
/// - if they form a square or cubic lattice, at any angle, whose spacing differs by more than two per cent;
/// - if nine in ten have none, or the nearest one is typically farther away than 1.6 spacings; in clouds made by
///   `fit_particles` it is at most 1.53 spacings away. This is tested only if `also_alone` is set.
///
/// Mixed metres and millimetres are found in this way, and so are spacings of 0.6 times the right one and, in thick
/// bodies, of 1.5 times; those between are as plausible in clouds that are not regular, and are found on lattices only.
/// A sample of 64 particles, spread over the cloud, is tested.
template <class T, int D>
void require_plausible_spacing(const FixedRadiusSearch<T, D>& search, const BondSettings& settings,
                               typename VectorView<T, D>::Scalar radius, bool also_alone = true) {
  constexpr std::size_t most_samples = 64;
  constexpr double ball = (D == 3 ? 4. / 3 : 1.) * std::numbers::pi;  // volume for radius 1, particles at spacing 1
  const double usual = std::max(2.0 * D, ball * std::pow(settings.radius_ratio, D));
  const std::size_t n = search.points().size(), samples = std::min(n, most_samples);
  if (n < 2) return;
  const auto sample = [&](std::size_t k) { return spread_sample(k, samples, n); };
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
  std::vector<double> nearest(samples);
  for (std::size_t k = 0; k < samples; ++k) nearest[k] = static_cast<double>(search.nearest(sample(k)));
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(samples / 2), nearest.end());
  const double apart = nearest[samples / 2];
  const double mean = static_cast<double>(sum) / static_cast<double>(samples);
  const auto quarter = counts.begin() + static_cast<std::ptrdiff_t>(3 * samples / 4);  // most may lie at the surface
  std::nth_element(counts.begin(), quarter, counts.end());
  const bool is_dense = static_cast<double>(*quarter) > 3.5 * usual && apart < 0.8 * settings.spacing;
  if (mean > 4 * usual || is_dense)
    throw_input_error({"hmps: particle ", fullest, " has ", most, " neighbours within the effective radius of ", radius,
                       " m, ", samples, " particles that were sampled have ", std::round(mean),
                       " on average, but a spacing of ", settings.spacing, " m gives about ", std::round(usual),
                       "; the typical distance to the nearest particle is ", apart,
                       " m: give a spacing of that size, in the unit of the positions"});
  const double lattice = sampled_lattice_spacing(search, nearest, apart);
  require(
      lattice == 0 || std::abs(lattice / settings.spacing - 1) <= 0.02,
      "hmps: the particles lie on a lattice of spacing ", lattice, " m, but a spacing of ", settings.spacing,
      " m was given; give that of the lattice, in the unit of the positions (for a larger or smaller neighbourhood, "
      "change radius_ratio)");
  if (!also_alone) return;
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
  require(settings.unbonded || apart <= 1.6 * settings.spacing,
          "hmps: the typical distance to the nearest particle is ", apart, " m, ", apart / settings.spacing,
          " times the spacing of ", settings.spacing,
          " m; give a spacing of about that size, in the unit of the positions");
}

}  // namespace hmps::inline HMPS_ABI::detail
