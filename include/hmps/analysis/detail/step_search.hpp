// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hmps/analysis/probed_scene.hpp"
#include "hmps/analysis/stable_step_settings.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The number of iterations after which a Krylov method started from noise in `dimension` dimensions has found the
/// square root of the largest eigenvalue to within `margin`, except for one start in a thousand. From the bound of
/// Kuczynski and Wozniakowski (1992), P <= 1.648 sqrt(n) exp(-sqrt(e) (2 m - 1)).
[[nodiscard]] inline int least_iterations(std::size_t dimension, double margin) {
  const double error = 1 - (1 - margin) * (1 - margin);
  const double exponent = std::log(1.648 * std::sqrt(static_cast<double>(dimension)) / 1e-3);
  return error > 0 ? static_cast<int>(std::min(std::ceil((exponent / std::sqrt(error) + 1) / 2), 1e6)) : 1;
}

/// Amount of noise in a search that starts from an earlier mode; a new mode can grow from the noise.
inline constexpr double fresh_noise = 0.1;

/// The step at which dt^2 k + 2 dt c reaches 4; infinite if it never does.
[[nodiscard]] inline double step_limit(double k, double c) {
  const double discriminant = c * c + 4 * k;
  const double denominator = c + std::sqrt(std::max(discriminant, 0.0));
  return discriminant >= 0 && denominator > 0 ? 4 / denominator : std::numeric_limits<double>::infinity();
}

/// The eigenvector of the largest eigenvalue of a symmetric matrix.
template <class S>
[[nodiscard]] Vector<S, 3> largest_mode(const Matrix<S, 3>& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Matrix<S, 3>>(symmetric).eigenvectors().col(2);
}

/// The search of `stable_step`: conjugate gradients on the Rayleigh quotient of dt^2 K + 2 dt C, with dt updated in
/// each iteration.
template <class T, int D>
class StepSearch {
 public:
  /// Starts from noise, and from the mode in `settings` if there is one.
  StepSearch(ProbedScene<T, D>& scene, const StableStepSettings& settings, const AnyExecutor& execute)
      : settings_(settings),
        execute_(execute),
        n_(scene.size()),
        scene_(scene),
        best_(n_),
        descent_(n_),
        previous_(n_) {
    start_from_noise();
    if (!settings.start.empty()) start_from_mode();
    require(scene_.normalise(best_, 1.0), "hmps: no particle of stable_step moves; `moves` must be true for some");
    begin();
  }

  [[nodiscard]] StableStep run() {
    constexpr double exact = 1e-7;  // below this the residual is rounding, from which nothing can grow
    const int cold = least_iterations(n_ * D, settings_.margin);
    const int least = settings_.start.empty() ? cold : std::min(cold, settings_.refresh_iterations);
    StableStep result;
    for (result.iterations = 1;; ++result.iterations) {
      k_ = scene_.dot(best_.y, best_.stiffness);
      c_ = scene_.damped() ? scene_.dot(best_.y, best_.damping) : 0.0;
      const double dt = result.limit = step_limit(k_, c_);
      if (!is_finite(dt)) {
        // Neither stiffness nor damping responds to noise: nothing limits the step.
        result.converged = true;
        result.residual = 0;
        break;
      }
      scene_.scale_speed(dt);
      // B = dt^2 K + 2 dt C has the quotient 4 at `best_`; the residual is the direction of ascent.
      for_each_in_chunks(n_, execute_, [&](std::size_t i) {
        const Vector<double, D> image = dt * dt * best_.stiffness[i] + 2 * dt * best_.damping[i];
        descent_.y[i] = image - 4.0 * best_.y[i];
      });
      result.residual = std::sqrt(scene_.dot(descent_.y, descent_.y)) / 4;
      if (settings_.progress) settings_.progress(result);
      const bool settled =
          result.residual < settings_.tolerance && (result.iterations >= least || result.residual < exact);
      if (settled || result.iterations >= settings_.max_iterations) {
        result.converged = settled;
        if (fresh_ || !result.converged) break;
        // The images were combined linearly for some iterations: evaluate them anew before the final answer.
        probe(best_);
        fresh_ = true;
        continue;
      }
      result.converged = result.residual < settings_.tolerance;
      if (!ascend(dt)) break;
    }
    conclude(result);
    return result;
  }

 private:
  [[nodiscard]] bool moves(std::size_t i) const { return !settings_.moves || settings_.moves(i); }

  void start_from_noise() {
    for (std::size_t i = 0; i < n_; ++i) {
      for (int c = 0; c < D; ++c)
        best_.y[i][c] = noise(settings_.seed * 0x100000001b3u + std::uint64_t{i} * D + static_cast<std::uint64_t>(c));
      if (!moves(i)) best_.y[i].setZero();
    }
  }
  /// Starts from the mode in the settings, with a tenth of noise.
  void start_from_mode() {
    require(settings_.start.size() == n_ * D, "hmps: the mode that stable_step starts from has ",
            settings_.start.size(), " numbers, but ", n_, " particles in ", D, " dimensions need ", n_ * D,
            "; give the mode of an earlier result for the same particles");
    for (std::size_t k = 0; k < settings_.start.size(); ++k)
      require(is_finite(settings_.start[k]) && std::abs(settings_.start[k]) < 1e100, "hmps: number ", k,
              " of the mode that stable_step starts from is ", settings_.start[k],
              "; give the mode of an earlier result, which has the length 1");
    const double share = fresh_noise / std::max(std::sqrt(scene_.dot(best_.y, best_.y)), 1e-300);
    for (std::size_t i = 0; i < n_; ++i)
      for (int c = 0; c < D; ++c)
        best_.y[i][c] = moves(i) ? settings_.start[i * D + static_cast<std::size_t>(c)] + share * best_.y[i][c] : 0.0;
  }
  /// Computes the images of the start, with trial displacements and velocities of the right size.
  void begin() {
    if (settings_.perturbation > 0)
      scene_.probe_stiffness(best_);
    else
      scene_.resolve(best_, longest_perturbation * settings_.spacing);
    const double undamped = step_limit(scene_.dot(best_.y, best_.stiffness), 0.0);
    scene_.scale_speed(undamped);
    scene_.probe_damping(best_);
    scene_.forget_damping_if_none(best_);
    if (scene_.damped() && !is_finite(undamped)) {  // only now is there a step
      scene_.scale_speed(step_limit(0.0, scene_.dot(best_.y, best_.damping)));
      scene_.probe_damping(best_);
    }
    keep_prescribed(best_);
  }
  void probe(Direction<D>& direction) {
    scene_.probe(direction);
    keep_prescribed(direction);
  }
  /// Particles that do not follow the forces have no images.
  void keep_prescribed(Direction<D>& direction) const {
    for (std::size_t i = 0; settings_.moves && i < n_; ++i)
      if (!moves(i)) direction.stiffness[i] = direction.damping[i] = Vector<double, D>::Zero();
  }

  /// Moves to the largest quotient in the span of `best_`, `descent_` and the previous direction. Returns false if no
  /// direction is left.
  [[nodiscard]] bool ascend(double dt) {
    if (have_previous_) {
      scene_.project_out(previous_, best_);
      have_previous_ = scene_.normalise(previous_, 1.0);
    }
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough, once may not be
      scene_.project_out(descent_, best_);
      if (have_previous_) scene_.project_out(descent_, previous_);
    }
    if (!scene_.normalise(descent_, 1.0)) return false;
    probe(descent_);
    const Vector<double, 3> weight = largest_mode<double>(projected(dt));
    scene_.blend(previous_, have_previous_ ? weight[2] : 0.0, descent_, weight[1]);
    scene_.blend(best_, weight[0], previous_, 1.0);
    have_previous_ = true;
    fresh_ = false;
    return scene_.normalise(best_, 1.0);
  }
  /// dt^2 K + 2 dt C projected onto the three directions (Rayleigh-Ritz), symmetrised.
  [[nodiscard]] Matrix<double, 3> projected(double dt) const {
    const std::array<const Direction<D>*, 3> basis{&best_, &descent_, &previous_};
    const int dimension = have_previous_ ? 3 : 2;
    const auto entry = [&](const Direction<D>& p, const Direction<D>& q) {
      return dt * dt * scene_.dot(p.y, q.stiffness) + (scene_.damped() ? 2 * dt * scene_.dot(p.y, q.damping) : 0.0);
    };
    Matrix<double, 3> B = Matrix<double, 3>::Zero();
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b <= a && a < dimension; ++b) {
        const auto& left = *basis[static_cast<std::size_t>(a)];
        const auto& right = *basis[static_cast<std::size_t>(b)];
        B(a, b) = B(b, a) = (entry(left, right) + entry(right, left)) / 2;
      }
      if (a >= dimension) B(a, a) = -(std::abs(B(0, 0)) + std::abs(B(1, 1)));  // never the largest
    }
    return B;
  }

  /// The result that `best_` implies.
  void conclude(StableStep& result) const {
    result.omega = std::sqrt(std::max(k_, 0.0));
    result.damping = std::max(c_, 0.0);
    result.step = (1 - settings_.margin) * result.limit / std::sqrt(1 + result.residual);
    result.evaluations = scene_.evaluations();
    result.perturbation = scene_.length() / settings_.spacing;
    result.mode.reserve(n_ * D);
    for (const auto& y : best_.y) result.mode.insert(result.mode.end(), y.data(), y.data() + D);
    double sum = 0, squares = 0, largest = -1;
    for (std::size_t i = 0; i < n_; ++i) {
      const double energy = best_.y[i].squaredNorm();
      sum += energy;
      squares += energy * energy;
      if (energy > largest) {
        largest = energy;
        result.particle = i;
      }
    }
    result.share = largest / sum;
    result.participation = sum * sum / squares;
  }

  const StableStepSettings& settings_;
  const AnyExecutor& execute_;
  std::size_t n_;
  ProbedScene<T, D>& scene_;
  Direction<D> best_, descent_, previous_;
  double k_ = 0, c_ = 0;  // quotients of `best_`
  bool have_previous_ = false, fresh_ = true;
};

}  // namespace hmps::inline HMPS_ABI::detail
