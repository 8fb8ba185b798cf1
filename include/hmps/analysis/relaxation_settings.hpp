// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `relax`.
struct Relaxation {
  /// Unbalanced forces divided by the load: the sum of |f| V over the particles that move, where V is l0^D or
  /// `RelaxationSettings::volume`, divided by `RelaxationSettings::load`.
  double residual = 0;
  double load = 0;      ///< in N: as given, or the force on the particles that do not move
  int iterations = 0;   ///< number of steps
  int peaks = 0;        ///< number of kinetic energy peaks at which the body was stopped
  double step = 0;      ///< the last step in s
  int evaluations = 0;  ///< number of force evaluations, including those of `stable_step`
};

/// Settings of `relax`.
struct RelaxationSettings {
  double spacing = 0;       ///< particle spacing l0 in m, positive
  double tolerance = 1e-3;  ///< residual at which the search ends; see `Relaxation::residual`
  /// The load in N (in two dimensions N/m) with which the unbalanced forces are compared, such as the weight of the
  /// body or the force that presses it. 0: the force on the particles that do not move, of which there must be some.
  double load = 0;
  int max_iterations = 100000;  ///< one force evaluation each
  double step = 0;              ///< in s; 0: that of `stable_step`, updated as the body deforms
  /// Whether particle i follows the forces; the others keep their positions. Empty: all particles follow.
  std::function<bool(std::size_t)> moves = {};
  /// Called after each force evaluation with the current result, for progress reports; may throw to stop the search.
  /// Empty: not called.
  std::function<void(const Relaxation&)> progress = {};
  /// Whether particle i follows the forces along the axis c, such as `[&](std::size_t i, int c) { return c != 0 ||
  /// !on_plane[i]; }` for a plane of symmetry across x; along the others it keeps its position. Empty: along all axes.
  std::function<bool(std::size_t, int)> moves_along = {};
  /// The volume V of particle i in m^D, for fitted particles that do not have the same. Empty: l0^D. Give them
  /// if the bonds and `Organ::volume` have them, and only then.
  std::function<double(std::size_t)> volume = {};
};

namespace detail {

inline void validate(const RelaxationSettings& s) {
  require(detail::is_finite(s.spacing) && s.spacing > 0, "hmps: the spacing of relax is ", s.spacing,
          " m; give the particle spacing l0, with which force densities become forces");
  require(detail::is_finite(s.tolerance) && s.tolerance > 0 && s.tolerance < 1, "hmps: the tolerance of relax is ",
          s.tolerance, "; it must lie between 0 and 1, for example 1e-3");
  require(detail::is_finite(s.load) && s.load >= 0, "hmps: the load of relax is ", s.load,
          " N; give the force that acts, or 0 for the force on the particles that do not move");
  require(s.max_iterations > 0, "hmps: relax may make ", s.max_iterations, " iterations; allow at least one");
  require(detail::is_finite(s.step) && s.step >= 0, "hmps: the step of relax is ", s.step,
          " s; it must be positive, or 0 for that of stable_step");
}

/// `whole`: what `FreeMotion::remark` says of the net force and moment.
[[noreturn]] inline void throw_flown(const Relaxation& result, double path, const std::string& whole) {
  throw StateError(message("hmps: after ", result.iterations, " iterations of relax, particles have flown ", path,
                           " m without stopping, ten times the size of the body: nothing holds it; ",
                           whole.empty() ? "does `moves` exclude the particles that are held, and does the load press "
                                           "it against something? If both are so, the load may exceed what the body "
                                           "can carry: give a smaller one, or increase it in parts"
                                         : whole + ": hold some particles, or subtract the mean force, and the moment, "
                                                   "from the forces"));
}

/// `stalled`: more iterations do not help. `whole` as for `throw_flown`, `drift` as `MotionAsAWhole::remark`.
[[noreturn]] inline void throw_not_at_rest(const Relaxation& result, const RelaxationSettings& settings, bool damped,
                                           bool stalled, const std::string& whole, const std::string& drift) {
  const std::string begin =
      message("hmps: relax made ", result.iterations, " iterations and the unbalanced forces are still ",
              result.residual, " of the load, ", result.load, " N; ");
  const std::string end = message(", or a larger tolerance than ", settings.tolerance);
  if (!whole.empty())
    throw StateError(message(begin, whole,
                             ": unless something else holds the body it cannot come to rest; hold some "
                             "particles, or subtract the mean force, and the moment, from the forces; otherwise allow "
                             "more max_iterations than ",
                             settings.max_iterations, end));
  if (!drift.empty())
    throw StateError(message(begin, drift,
                             ": if it is free to slide or turn, hold some particles along that direction by "
                             "`moves` or `moves_along`, or subtract the mean force, and the moment, from the forces: "
                             "even one below the tolerance moves a free body; otherwise allow more max_iterations "
                             "than ",
                             settings.max_iterations, end));
  throw StateError(message(
      begin,
      stalled
          ? "they no longer decrease, because they are rounding, or because a contact opens and closes: if bonds or "
            "positions are in float, use double"
          : "if bonds or positions are in float, use double; otherwise allow more max_iterations than ",
      stalled ? "" : std::to_string(settings.max_iterations), end,
      damped ? "; damping shortened its step: leave viscosity out, and give a contact with friction a longer "
               "dt, about the step of relax without friction"
             : "",
      settings.load > 0 ? ""
                        : "; that load is what the held particles carry: if nothing loads "
                          "the body, it is rounding, so give a `load` to compare with"));
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
