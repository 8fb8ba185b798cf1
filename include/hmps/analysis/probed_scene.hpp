// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/force_function.hpp"

namespace hmps::inline HMPS_ABI {

/// A force that `stable_step` and `relax` can evaluate. `force(x, v, f)` takes read-only views of positions (m) and
/// velocities (m/s) and writes force densities (N/m3) to `f`; since `f` is zero on entry, it may just add to it.
/// Models: the result of `internal_force`, a lambda that adds several forces.
template <class Force, class T, int D>
concept ProbedForce = requires(Force& force, const VectorView<const T, D>& x, const VectorView<T, D>& f) {
  force(x, x, f);
};

namespace detail {

/// Throws `InputError` if `force`, which was given to `what`, is a function without content, such as a `ForceFunction`
/// to which nothing was assigned.
template <class Force>
void require_force([[maybe_unused]] const Force& force, [[maybe_unused]] const char* what) {
  if constexpr (requires {
                  typename Force::result_type;
                  { force == nullptr } -> std::convertible_to<bool>;
                })
    require(!(force == nullptr), "hmps: the force given to ", what,
            " is an empty function; assign a force to it, such as the result of internal_force");
}

/// Pseudo-random number in (-1, 1), a function of `number` alone (splitmix64).
[[nodiscard]] inline double noise(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15u;
  number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9u;
  number = (number ^ (number >> 27)) * 0x94d049bb133111ebu;
  number ^= number >> 31;
  return (static_cast<double>(number >> 11) + 0.5) * 0x1.0p-52 - 1.0;
}

/// A direction in the space of displacements, weighted by the square root of the mass, and its images under stiffness
/// and damping.
template <int D>
struct Direction {
  std::vector<Vector<double, D>> y, stiffness, damping;
  explicit Direction(std::size_t n)
      : y(n, Vector<double, D>::Zero()),
        stiffness(n, Vector<double, D>::Zero()),
        damping(n, Vector<double, D>::Zero()) {}
};

/// The linearised force, with the vector algebra that the search for its largest eigenvalue needs. The type of the
/// force is erased, so that the search is compiled once for all forces.
template <class T, int D>
class ProbedScene {
 public:
  using Vectors = std::vector<Vector<double, D>>;

  /// `length`: of the trial displacements in m. `caller`: the function that errors name. Both it and the force must
  /// outlive the scene.
  template <class Force, class X, class V, class Rho>
  ProbedScene(const char* caller, Force& force, const VectorView<X, D>& x, const VectorView<V, D>& v,
              const Rho& density, double length, const AnyExecutor& execute)
      : caller_(caller),
        force_([&force](const auto&... views) { force(views...); }),
        execute_(execute),
        size_(x.size()),
        root_density_(size_),
        x_(size_),
        v_(size_),
        moved_(size_),
        plus_(size_),
        minus_(size_),
        length_(length),
        speed_(0) {
    double farthest = 0, fastest = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      x_[i] = x[i];
      farthest = std::max(farthest, static_cast<double>(x_[i].cwiseAbs().maxCoeff()));
      for (int c = 0; c < D; ++c) v_[i][c] = static_cast<T>(v(i, c));
      fastest = std::max(fastest, static_cast<double>(v_[i].cwiseAbs().maxCoeff()));
      root_density_[i] = std::sqrt(static_cast<double>(at_particle(density, i)));
    }
    speed_ = std::max(length, 0.01 * fastest);
    require(length >= 8 * static_cast<double>(std::numeric_limits<T>::epsilon()) * farthest,
            "hmps: the trial displacements of ", caller, " are ", length, " m, which vanishes in the rounding of ",
            8 * sizeof(T), "-bit positions of up to ", farthest,
            " m; give the spacing in metres, a larger perturbation, or positions in double closer to the origin");
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool damped() const { return damped_; }
  /// The number of force evaluations so far.
  [[nodiscard]] int evaluations() const { return evaluations_; }
  /// The length of the trial displacements in m.
  [[nodiscard]] double length() const { return length_; }
  /// Scales trial velocities so that they have the same effect as the trial displacements at the step `dt`.
  void scale_speed(double dt) {
    if (detail::is_finite(dt)) speed_ = length_ / dt;
  }

  /// Computes the images of `direction.y` under stiffness and damping by central differences of the force.
  void probe(Direction<D>& direction) {
    probe_stiffness(direction);
    if (damped_) probe_damping(direction);
  }
  void probe_stiffness(Direction<D>& direction) { displace(direction.y, length_, direction.stiffness); }
  void probe_damping(Direction<D>& direction) {
    difference(direction.y, v_, speed_, direction.damping, [&](const auto& trial, auto& f) { call(x_, trial, f); });
  }
  /// Lengthens the trial displacements, to at most `longest`, until the rounding of the force hardly matters: a force
  /// may compute in fewer digits than the positions have. Afterwards, `direction.stiffness` is the image of
  /// `direction.y`.
  void resolve(Direction<D>& direction, double longest) {
    for (;; length_ *= 10) {
      probe_stiffness(direction);
      if (10 * length_ > longest || resolves(direction)) return;
    }
  }
  /// From now on, skips the velocities if the force did not respond to those of `direction`.
  void forget_damping_if_none(const Direction<D>& direction) {
    damped_ = dot(direction.damping, direction.damping) > 0;
  }

  [[nodiscard]] double dot(const Vectors& a, const Vectors& b) const {
    return reduce(
        size_, 0.0, [&](std::size_t i) { return a[i].dot(b[i]); }, std::plus<>{}, execute_);
  }
  /// a <- alpha a + beta b.
  void blend(Direction<D>& a, double alpha, const Direction<D>& b, double beta) const {
    for_each_in_chunks(size_, execute_, [&](std::size_t i) {
      a.y[i] = alpha * a.y[i] + beta * b.y[i];
      a.stiffness[i] = alpha * a.stiffness[i] + beta * b.stiffness[i];
      a.damping[i] = alpha * a.damping[i] + beta * b.damping[i];
    });
  }
  /// Makes `a` orthogonal to the unit vector `b`.
  void project_out(Direction<D>& a, const Direction<D>& b) const { blend(a, 1.0, b, -dot(a.y, b.y)); }
  /// Scales `a` to unit length. Returns false if it has (nearly) vanished compared with `scale`.
  [[nodiscard]] bool normalise(Direction<D>& a, double scale) const {
    const double norm = std::sqrt(dot(a.y, a.y));
    if (!(norm > 1e-10 * scale)) return false;
    blend(a, 1.0 / norm, a, 0.0);
    return true;
  }

 private:
  using State = std::vector<Vector<T, D>>;

  /// Whether rounding, which contributes the more the shorter the displacements are, hardly changes the image of
  /// displacements a hundred times shorter. Where it changes although two such images agree, the force has a kink.
  [[nodiscard]] bool resolves(const Direction<D>& direction) {
    constexpr double shorter = 0.01, agreement = 0.1;
    const auto apart = [&](const Vectors& a, const Vectors& b) {
      return reduce(
          size_, 0.0, [&](std::size_t i) { return (a[i] - b[i]).squaredNorm(); }, std::plus<>{}, execute_);
    };
    const double most = agreement * agreement * dot(direction.stiffness, direction.stiffness);
    if (!(most > 0)) return false;  // all of the motion may have been lost
    Vectors image(size_), other(size_);
    // A force with a memory, such as friction with a spring, also answers the way from the last state: the second time,
    // that way is as short.
    for (int time = 0; time < 2; ++time) {
      displace(direction.y, shorter * length_, image);
      if (apart(image, direction.stiffness) <= most) return true;
    }
    displace(direction.y, 1.1 * shorter * length_, other);
    return apart(image, other) <= most && dot(image, image) > most;
  }
  void displace(const Vectors& y, double length, Vectors& image) {
    difference(y, x_, length, image, [&](const auto& trial, auto& f) { call(trial, v_, f); });
  }

  void call(const State& x, const State& v, State& f) {
    for_each_in_chunks(size_, execute_, [&](std::size_t i) { f[i].setZero(); });
    ++evaluations_;
    force_(vectors(x), vectors(v), vectors(f));
  }

  /// image <- - rho^(-1/2) (df/dstate) rho^(-1/2) y.
  template <class Call>
  void difference(const Vectors& y, const State& state, double size, Vectors& image, Call&& evaluate) {
    const double largest = reduce(
        size_, 0.0, [&](std::size_t i) { return y[i].norm() / root_density_[i]; },
        [](double a, double b) { return std::max(a, b); }, execute_);
    const double h = size / largest;
    for (const double sign : {1.0, -1.0}) {
      for_each_in_chunks(size_, execute_, [&](std::size_t i) {
        moved_[i] = state[i] + (y[i] * (sign * h / root_density_[i])).template cast<T>();
      });
      evaluate(moved_, sign > 0 ? plus_ : minus_);
    }
    for_each_in_chunks(size_, execute_, [&](std::size_t i) {
      image[i] = (minus_[i].template cast<double>() - plus_[i].template cast<double>()) / (2 * h * root_density_[i]);
    });
    if (detail::is_finite(dot(image, image))) return;
    for (std::size_t i = 0; i < size_; ++i) {
      for (const State* force : {&plus_, &minus_})
        if (!all_finite((*force)[i]))
          throw StateError(message("hmps: ", caller_, " finds a force on particle ", i, " that is not finite, ",
                                   (*force)[i], " N/m3; check its det F, x, v and the parameters of its law"));
      require(is_finite(image[i].squaredNorm()), "hmps: ", caller_, " finds a stiffness at particle ", i,
              ", whose density is ", root_density_[i] * root_density_[i], " kg/m3 and whose force is ", plus_[i],
              " N/m3, that is too large for a number; check the density and the force");
    }
    throw_input_error({"hmps: ", caller_,
                       " finds a stiffness whose squares sum to more than a number can hold; check "
                       "the densities and the force"});
  }

  const char* caller_;
  ForceFunction<T, D> force_;
  AnyExecutor execute_;
  std::size_t size_;
  std::vector<double> root_density_;
  State x_, v_, moved_, plus_, minus_;
  double length_, speed_;
  bool damped_ = true;
  int evaluations_ = 0;
};

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
