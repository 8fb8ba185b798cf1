// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI {

struct StableStep;

/// Settings of `stable_step`.
struct StableStepSettings {
  double spacing = 0;        ///< particle spacing l0 in m, positive: the scale of the trial displacements
  double margin = 0.03;      ///< relative distance that the step keeps from the estimated limit
  double tolerance = 0.02;   ///< residual of the eigenvector, relative to the eigenvalue, at which the search stops
  int max_iterations = 300;  ///< one or two pairs of force evaluations each
  /// Trial displacement over the spacing. 0: 1e-2 if positions are float, otherwise 1e-5, or as much more, up to 1e-2,
  /// as the force needs because it computes in float.
  double perturbation = 0;
  std::uint64_t seed = 1;  ///< seed of the noise from which the search starts
  /// The `mode` of an earlier result for the same particles, to start from instead of noise; see `stable_step`.
  std::vector<double> start = {};
  int refresh_iterations = 4;  ///< minimum number of iterations with a `start`
  /// Whether particle i follows the forces, as opposed to a forced displacement. Empty: all particles follow.
  std::function<bool(std::size_t)> moves = {};
  /// Called after each iteration with the current result (limit, residual, iterations), for progress reports; may throw
  /// to stop the search. Empty: not called.
  std::function<void(const StableStep&)> progress = {};
};

/// The largest stable step of a scene, and the mode that limits it.
struct StableStep {
  double step = 0;           ///< step to use in s: below the limit by `margin` and the residual
  double limit = 0;          ///< estimated limit of stability in s; infinite without any stiffness
  double omega = 0;          ///< angular frequency of the limiting mode in rad/s
  double damping = 0;        ///< damping c of the limiting mode in 1/s
  std::size_t particle = 0;  ///< particle with the largest amplitude in the limiting mode
  double share = 0;          ///< fraction of the mode's kinetic energy in that particle
  double participation = 0;  ///< approximate number of particles that take part; 1 for a single weakly supported one
  double residual = 0;       ///< relative residual reached
  bool converged = false;    ///< if false, raise max_iterations or tolerance; the step is still conservative
  int iterations = 0;        ///< number of iterations
  int evaluations = 0;       ///< number of force evaluations
  double perturbation = 0;   ///< trial displacement used, over the spacing
  /// The limiting mode: displacements times the square root of density, D numbers per particle, of unit length. Input
  /// of `StableStepSettings::start` and `step_causes`.
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

/// Factor by which the spacing of deformed particles may differ from l0; more means another unit.
inline constexpr double most_compressed = 100;

/// The longest trial displacement over the spacing that is chosen without being asked for.
inline constexpr double longest_perturbation = 1e-2;

/// Length in m of the trial displacements for positions of type `T`, with which the search begins.
template <class T>
[[nodiscard]] double trial_displacement(const StableStepSettings& s) {
  return s.spacing * (s.perturbation > 0 ? s.perturbation : sizeof(T) > 4 ? 1e-5 : longest_perturbation);
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
