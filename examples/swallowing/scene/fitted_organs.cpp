// SPDX-License-Identifier: MIT
#include "scene/fitted_organs.hpp"

#include <cstddef>
#include <hmps/executors/openmp.hpp>
#include <hmps/shapes/redistanced.hpp>

namespace swallowing {

FittedOrgans fit_organs(double spacing, int threads) {
  const hmps::OpenMP execute{threads};
  const Anatomy anatomy;
  const auto sign = [&anatomy](const Point& x) { return anatomy.organ_at(1e3 * x) == Organ::none ? 1.0 : -1.0; };
  // Cells as wide as the samples of the fit.
  const auto organs = hmps::redistanced(sign, bounds_of_organs(), spacing / 4, execute);
  // Where drawn organs end side by side they leave fins thinner than a millimetre, which are longer than the edges that
  // `fit_particles` expects. Their volume goes to the nearest particles, whatever the spacing.
  constexpr double longest_fin = 20e-3;  // m
  const hmps::FitSettings settings{.longest_edge = longest_fin / spacing};
  FittedOrgans fitted{hmps::fit_particles(organs, bounds_of_organs(), spacing, settings, execute), {}};
  for (std::size_t i = 0; i < fitted.particles.size(); ++i)
    fitted.depth.push_back(-organs(fitted.particles.positions[i]) / fitted.particles.layer_spacings[i]);
  return fitted;
}

}  // namespace swallowing
