// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "hmps/analysis/probed_scene.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"

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

/// Iterations after which a Krylov method started from noise in `dimension` dimensions has a quotient
/// below the largest eigenvalue by less than `margin` of its root, but for one start in a
/// thousand: the bound of Kuczynski and Wozniakowski (1992), P <= 1.648 sqrt(n) exp(-sqrt(e) (2 m - 1)).
[[nodiscard]] inline int least_iterations(std::size_t dimension, double margin) {
  const double error = 1 - (1 - margin) * (1 - margin);
  const double exponent = std::log(1.648 * std::sqrt(static_cast<double>(dimension)) / 1e-3);
  return error > 0 ? static_cast<int>(std::min(std::ceil((exponent / std::sqrt(error) + 1) / 2), 1e6)) : 1;
}

/// The share of noise in a search that starts from an earlier mode: what a new mode can grow from.
inline constexpr double fresh_noise = 0.1;

/// The step at which dt^2 k + 2 dt c reaches 4, infinite if it never does.
[[nodiscard]] inline double step_limit(double k, double c) {
  const double discriminant = c * c + 4 * k;
  const double denominator = c + std::sqrt(std::max(discriminant, 0.0));
  return discriminant >= 0 && denominator > 0 ? 4 / denominator : std::numeric_limits<double>::infinity();
}

}  // namespace detail

/// Estimates the largest stable step of symplectic Euler (\paper{2, 3, 4}) for the composed `force`
/// in the state `x`, `v`, without a matrix, by the force alone.
///
/// Let the force answer to a displacement u by the acceleration -K u and to a velocity w by -C w. The
/// scheme, with the force at the old velocity, is stable while the largest eigenvalue of
/// dt^2 K + 2 dt C is below 4: dt < 2 / omega without damping, dt < 2 / c without stiffness,
/// dt < 4 / (c + sqrt(c^2 + 4 omega^2)) for a mode with both. (For one mode the step has the trace
/// 2 - c dt - omega^2 dt^2 and the determinant 1 - c dt; each eigenvector of many modes obeys
/// the same with its own quotients for omega^2 and c.) That eigenvector is found by conjugate
/// gradients on the Rayleigh quotient, weighted by mass, from seeded noise, with dt brought up to date on the way.
/// An iteration takes one pair of force evaluations, two where the force depends on v.
///
/// The quotient approaches the eigenvalue from below, so that `limit` approaches from above; `step`
/// therefore lies below it by the residual, no further than which there is an eigenvalue, and by
/// `margin`. A small residual may still be that of a smaller eigenvalue, while a single weakly held
/// particle has not yet risen out of the noise: so the search goes on for at least the
/// iterations (about 25) after which all but one noise in a thousand have seen every eigenvalue
/// that matters for the margin. A margin of 0 leaves that out.
///
/// To refresh the result during a run give its `mode` as `start`, and another `seed`. The search then starts from that
/// mode with a tenth of noise and may stop after `refresh_iterations`. It follows a limiting mode that changes; one
/// that appears elsewhere has so few iterations to rise in that it may take some refreshes until it is seen. A search
/// without `start`, now and then, is the certain way.
///
/// It holds for the state given; stretch and new contacts change it. A contact that is not touched does not count, one
/// whose penetration is less than the trial displacement counts by about half: set `perturbation` well below the
/// penetrations, in spacings. The derivatives of contact are not symmetric; in the scenes of docs/stability.md the
/// limit was that of the true, unsymmetric motion within half a per cent nevertheless.
///
/// @param density  in kg/m3, a number or a `ScalarView`
/// The views are not changed. The result does not depend on the executor if the force does not.
/// Throws `InputError` for bad settings or views or a `start` of other particles, `StateError` if the force of a
/// particle is not finite.
template <class Force, class X, class V, int D, PerParticle Rho, Executor E = Serial>
[[nodiscard]] StableStep stable_step(Force&& force, const VectorView<X, D>& x, const VectorView<V, D>& v,
                                     const Rho& density, const StableStepSettings& settings, const E& execute = {}) {
  using T = typename VectorView<X, D>::Scalar;
  static_assert(ProbedForce<Force, T, D>,
                "hmps: stable_step calls force(x, v, f) with VectorView<const T, D>, VectorView<const T, D> and "
                "VectorView<T, D> of the scalar of the positions");
  const std::size_t n = x.size();
  detail::validate(settings);
  require(n > 0, "hmps: stable_step was given no particle");
  require_size(v, n, "velocities");
  require_positive(density, n, "density", "kg/m3");
  require_finite(x, "the position");
  require_finite(v, "the velocity");
  const auto moves = [&](std::size_t i) { return !settings.moves || settings.moves(i); };

  detail::ProbedScene<std::remove_reference_t<Force>, T, D, Rho, E> scene(
      force, x, v, density, detail::trial_displacement<T>(settings), execute);
  detail::Direction<D> best(n), descent(n), previous(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (int c = 0; c < D; ++c)
      best.y[i][c] =
          detail::noise(settings.seed * 0x100000001b3u + std::uint64_t{i} * D + static_cast<std::uint64_t>(c));
    if (!moves(i)) best.y[i].setZero();
  }
  if (!settings.start.empty()) {
    require(settings.start.size() == n * D, "hmps: the mode that stable_step starts from has ", settings.start.size(),
            " numbers, but ", n, " particles in ", D, " dimensions need ", n * D,
            "; give the mode of an earlier result for the same particles");
    const double noise = detail::fresh_noise / std::max(std::sqrt(scene.dot(best.y, best.y)), 1e-300);
    for (std::size_t i = 0; i < n; ++i)
      for (int c = 0; c < D; ++c)
        best.y[i][c] = moves(i) ? settings.start[i * D + static_cast<std::size_t>(c)] + noise * best.y[i][c] : 0.0;
  }
  StableStep result;
  require(scene.normalise(best, 1.0), "hmps: no particle of stable_step moves; `moves` must hold for some");
  const auto probe = [&](detail::Direction<D>& direction) {
    scene.probe(direction);
    for (std::size_t i = 0; settings.moves && i < n; ++i)
      if (!moves(i)) direction.stiffness[i] = direction.damping[i] = Vector<double, D>::Zero();
  };
  probe(best);
  scene.forget_damping_if_none(best);

  constexpr double exact = 1e-7;  // what is left of the residual is rounding: nothing can grow out of it
  const int cold = detail::least_iterations(n * D, settings.margin);
  const int least = settings.start.empty() ? cold : std::min(cold, settings.refresh_iterations);
  double k = 0, c = 0;
  bool have_previous = false, fresh = true;
  for (result.iterations = 1;; ++result.iterations) {
    k = scene.dot(best.y, best.stiffness);
    c = scene.damped() ? scene.dot(best.y, best.damping) : 0.0;
    const double dt = detail::step_limit(k, c);
    result.limit = dt;
    if (!detail::is_finite(dt)) {
      // Neither stiffness nor damping answers to noise: nothing limits the step.
      result.converged = true;
      result.residual = 0;
      break;
    }
    scene.scale_speed(dt);
    // B = dt^2 K + 2 dt C has the quotient 4 at `best`, whose residual is the direction of ascent.
    const auto image = [&](const detail::Direction<D>& a, std::size_t i) -> Vector<double, D> {
      return dt * dt * a.stiffness[i] + 2 * dt * a.damping[i];
    };
    execute(n, [&](std::size_t i) { descent.y[i] = image(best, i) - 4.0 * best.y[i]; });
    result.residual = std::sqrt(scene.dot(descent.y, descent.y)) / 4;
    if (settings.progress) settings.progress(result);
    const bool settled =
        result.residual < settings.tolerance && (result.iterations >= least || result.residual < exact);
    if (settled || result.iterations >= settings.max_iterations) {
      result.converged = settled;
      if (fresh || !result.converged) break;
      // The images were combined, not evaluated, for some iterations: make sure of the last word.
      probe(best);
      fresh = true;
      continue;
    }
    if (have_previous) {
      scene.project_out(previous, best);
      have_previous = scene.normalise(previous, 1.0);
    }
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough, once may not be
      scene.project_out(descent, best);
      if (have_previous) scene.project_out(descent, previous);
    }
    result.converged = result.residual < settings.tolerance;
    if (!scene.normalise(descent, 1.0)) break;
    probe(descent);

    // Rayleigh-Ritz in the span of the three.
    std::array<const detail::Direction<D>*, 3> basis{&best, &descent, &previous};
    const int dimension = have_previous ? 3 : 2;
    Matrix<double, 3> projected = Matrix<double, 3>::Zero();
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b <= a && a < dimension; ++b) {
        const auto& left = *basis[static_cast<std::size_t>(a)];
        const auto& right = *basis[static_cast<std::size_t>(b)];
        const auto entry = [&](const auto& p, const auto& q) {
          return dt * dt * scene.dot(p.y, q.stiffness) + (scene.damped() ? 2 * dt * scene.dot(p.y, q.damping) : 0.0);
        };
        projected(a, b) = projected(b, a) = (entry(left, right) + entry(right, left)) / 2;
      }
      if (a >= dimension)
        projected(a, a) = -(std::abs(projected(0, 0)) + std::abs(projected(1, 1)));  // never the largest
    }
    const Eigen::SelfAdjointEigenSolver<Matrix<double, 3>> solver(projected);
    const Vector<double, 3> weight = solver.eigenvectors().col(2);
    scene.blend(previous, have_previous ? weight[2] : 0.0, descent, weight[1]);
    scene.blend(best, weight[0], previous, 1.0);
    have_previous = true;
    fresh = false;
    if (!scene.normalise(best, 1.0)) break;
  }

  result.omega = std::sqrt(std::max(k, 0.0));
  result.damping = std::max(c, 0.0);
  result.step = (1 - settings.margin) * result.limit / std::sqrt(1 + result.residual);
  result.evaluations = scene.evaluations();
  result.mode.reserve(n * D);
  for (const auto& y : best.y) result.mode.insert(result.mode.end(), y.data(), y.data() + D);
  double sum = 0, squares = 0, largest = -1;
  for (std::size_t i = 0; i < n; ++i) {
    const double energy = best.y[i].squaredNorm();
    sum += energy;
    squares += energy * energy;
    if (energy > largest) {
      largest = energy;
      result.particle = i;
    }
  }
  result.share = largest / sum;
  result.participation = sum * sum / squares;
  return result;
}

}  // namespace hmps::inline HMPS_ABI
