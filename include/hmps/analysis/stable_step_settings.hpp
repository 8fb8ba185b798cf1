// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/finite.hpp"

namespace hmps::inline HMPS_ABI {

struct StableStep;

/// How `stable_step` looks for the largest stable step.
struct StableStepSettings {
  double spacing = 0;        ///< particle spacing l0 in m, positive: the scale of the trial displacements
  double margin = 0.03;      ///< what the step stays below the estimated limit, as a share of it
  double tolerance = 0.02;   ///< residual of the eigenvector, relative to the eigenvalue, at which the search stops
  int max_iterations = 300;  ///< of one or two pairs of force evaluations each
  double perturbation = 0;   ///< trial displacement over the spacing; 0: 1e-2 for float, 1e-5 for double
  std::uint64_t seed = 1;    ///< of the noise that the search starts from
  /// The `mode` of an earlier result for the same particles, to start from instead of noise alone; see `stable_step`.
  std::span<const double> start = {};
  int refresh_iterations = 4;  ///< made at least when there is a `start`
  /// Whether particle i follows the forces; those with a forced displacement do not. Empty: all do.
  std::function<bool(std::size_t)> moves = {};
  /// Called after each iteration with what is known by then (limit, residual, iterations), to show that something
  /// happens, or to throw where it takes too long. Empty: nothing is called.
  std::function<void(const StableStep&)> progress = {};
};

/// The largest stable step of a scene and what limits it.
struct StableStep {
  double step = 0;           ///< the step to use in s, `margin` and the residual below the limit
  double limit = 0;          ///< the estimated limit of stability itself in s; infinite without any stiffness
  double omega = 0;          ///< circular frequency of the limiting mode in rad/s
  double damping = 0;        ///< its damping c in 1/s, the rate at which it would lose speed without stiffness
  std::size_t particle = 0;  ///< the particle that moves most in it
  double share = 0;          ///< that particle's share of the mode's kinetic energy
  double participation = 0;  ///< about how many particles take part: 1 for a single weakly held one
  double residual = 0;       ///< relative residual reached
  bool converged = false;    ///< false: raise max_iterations or tolerance; the step is still a cautious one
  int iterations = 0;        ///< made
  int evaluations = 0;       ///< of the force
  /// The limiting mode: displacements times the root of density, D numbers per particle, of unit length. What
  /// `StableStepSettings::start` and `step_causes` take.
  std::vector<double> mode = {};
};

namespace detail {

inline void validate(const StableStepSettings& s) {
  require(detail::is_finite(s.spacing) && s.spacing > 0, "hmps: the spacing of stable_step is ", s.spacing,
          " m; give the particle spacing l0, which sets the size of its trial displacements");
  require(detail::is_finite(s.margin) && s.margin >= 0 && s.margin < 1, "hmps: the margin of stable_step is ", s.margin,
          "; it must lie in [0, 1)");
  require(detail::is_finite(s.tolerance) && s.tolerance > 0 && s.tolerance < 1,
          "hmps: the tolerance of stable_step is ", s.tolerance, "; it must lie between 0 and 1, for example 0.02");
  require(s.max_iterations > 0, "hmps: stable_step may make ", s.max_iterations, " iterations; allow at least one");
  require(s.refresh_iterations > 0, "hmps: a refresh of stable_step makes ", s.refresh_iterations,
          " iterations; allow at least one");
  require(detail::is_finite(s.perturbation) && s.perturbation >= 0 && s.perturbation < 0.1,
          "hmps: the perturbation of stable_step is ", s.perturbation, " spacings; it must lie in [0, 0.1)");
}

/// The length in m of trial displacements of positions in `T`.
template <class T>
[[nodiscard]] double trial_displacement(const StableStepSettings& s) {
  return s.spacing * (s.perturbation > 0 ? s.perturbation : sizeof(T) > 4 ? 1e-5 : 1e-2);
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
