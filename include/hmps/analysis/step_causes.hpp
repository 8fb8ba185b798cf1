// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "hmps/analysis/probed_scene.hpp"
#include "hmps/analysis/stable_step.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI {

/// A named part of the composed force, for `step_causes`. Refers to the force.
template <class Force>
struct NamedForce {
  std::string name;
  Force& force;
};
template <class Force>
NamedForce(const char*, Force&) -> NamedForce<Force>;

/// Contribution of one part of the force to the limiting mode.
struct StepCause {
  std::string name;
  double stiffness = 0;  ///< k in 1/s2; the sum over all parts is omega^2 of the mode
  double damping = 0;    ///< c in 1/s
  double share = 0;      ///< fraction of dt^2 k + 2 dt c = 4 at the limit
};

/// Finds which parts of the force limit the step. Evaluates the Rayleigh quotient of `found`, the result of
/// `stable_step` for the whole force, for each part, and sorts the parts by their share, largest first. The parts must
/// add up to the whole, for example `internal_force(bonds, artificial(E_hat))` and `internal_force(bonds,
/// elastic(law))`; the shares then add up to 1. A part with a negative share softens the mode. Takes two force
/// evaluations per part, and two more if the part depends on velocities.
///
/// The other arguments are those of `stable_step`. Throws as that does, and `InputError` for parts that add up to more
/// than the whole, as those of another density do.
template <class X, class V, int D, PerParticle Rho, class... Forces>
[[nodiscard]] std::vector<StepCause> step_causes(const StableStep& found, const VectorView<X, D>& x,
                                                 const VectorView<V, D>& v, const Rho& density,
                                                 const StableStepSettings& settings,
                                                 const NamedForce<Forces>&... parts) {
  using T = typename VectorView<X, D>::Scalar;
  const std::size_t n = x.size();
  detail::validate(settings);
  detail::require(found.mode.size() == n * D, "hmps: the mode that step_causes was given has ", found.mode.size(),
                  " numbers, but ", n, " particles in ", D, " dimensions need ", n * D,
                  "; give the result of stable_step for the same particles");
  double squares = 0;
  for (const double amplitude : found.mode) squares += amplitude * amplitude;
  detail::require(std::abs(squares - 1) < 1e-3, "hmps: the mode that step_causes was given has the length ",
                  std::sqrt(squares), " instead of 1; give the result of stable_step");
  require_size(v, n, "velocities");
  require_positive(density, n, "density", "kg/m3");
  require_finite(x, "the position");
  require_finite(v, "the velocity");
  detail::require_spacing_of(x, settings.spacing, "step_causes", detail::most_compressed);
  std::vector<StepCause> causes;
  if (!detail::is_finite(found.limit)) return causes;
  const double dt = found.limit;
  const double length = settings.perturbation > 0 || !(found.perturbation > 0) ? detail::trial_displacement<T>(settings)
                                                                               : found.perturbation * settings.spacing;
  const auto ask = [&](const std::string& name, auto& force) {
    detail::require_force(force, "step_causes");
    detail::ProbedScene<T, D> scene("step_causes", force, x, v, density, length, Serial{});
    scene.scale_speed(dt);
    detail::Direction<D> mode(n);
    for (std::size_t i = 0; i < n; ++i)
      for (int c = 0; c < D; ++c) mode.y[i][c] = found.mode[i * D + static_cast<std::size_t>(c)];
    scene.probe(mode);
    const double k = scene.dot(mode.y, mode.stiffness), c = scene.dot(mode.y, mode.damping);
    causes.push_back({name, k, c, (dt * dt * k + 2 * dt * c) / 4});
  };
  (ask(parts.name, parts.force), ...);
  double sum = 0;
  for (const StepCause& cause : causes) sum += cause.share;
  constexpr double most = 1.5;  // far above the errors of differences
  detail::require(sum < most, "hmps: the shares of the ", causes.size(), " parts given to step_causes sum to ", sum,
                  " instead of 1; give each part of the force once, and the state and density that `stable_step` had");
  std::stable_sort(causes.begin(), causes.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  return causes;
}

/// How well its bonds support `particle`: the least eigenvalue of its A (\paper{12}) divided by that of a full
/// neighbourhood. 1 inside, 0.5 at a flat surface of a lattice, 0.28 at the corner of a cube, 0 without bonds. The
/// stiffness of a particle grows as its support falls.
template <class K, int D>
[[nodiscard]] double relative_support(const Blocks<K, D>& bonds, std::size_t particle) {
  detail::require(particle < bonds.size(), "hmps: the support of particle ", particle,
                  " was requested, but there are only ", bonds.size(), " particles");
  const Matrix<double, D> inverse = bonds.shape_inverse(particle).template cast<double>();
  const Eigen::SelfAdjointEigenSolver<Matrix<double, D>> solver(inverse, Eigen::EigenvaluesOnly);
  const double full = bonds.standard_lambda() * bonds.standard_density() / D;
  const double largest = solver.eigenvalues()[D - 1];
  return largest > 0 ? 1 / (largest * full) : 0;
}

/// One line of text with the largest stable step, the particle that limits it, and the causes.
[[nodiscard]] inline std::string describe(const StableStep& found, const std::vector<StepCause>& causes,
                                          double support = 1) {
  char step[32];
  std::snprintf(step, sizeof(step), "%.3g", found.step);
  std::string text = detail::message("at most ", step, " s, set by particle ", found.particle);
  if (support < 0.95)
    text += detail::message(support > 0.4 ? " at a surface" : " at an edge or a thin place", " (support ",
                            std::round(100 * support), " % of that inside)");
  const char* link = ": ";
  for (const StepCause& cause : causes) {
    text += detail::message(link, cause.name, " ", std::round(100 * cause.share), " %");
    link = ", ";
  }
  return text;
}

}  // namespace hmps::inline HMPS_ABI
