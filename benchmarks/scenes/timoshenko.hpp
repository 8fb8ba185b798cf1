// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <numbers>

/// The beam theory with which benchmarks of bending are compared.
namespace scenes {

/// A prismatic beam of square section and isotropic elastic material. SI units.
struct SquareBeam {
  double length, height, young, poisson, density;

  [[nodiscard]] double area() const { return height * height; }
  [[nodiscard]] double second_moment() const { return height * height * height * height / 12; }
};

/// How a beam is held at its first end; the other is free.
enum class End { clamped, free };

/// The wave number times the length for the first mode of an Euler-Bernoulli beam: the first roots of cos(b) cosh(b) =
/// -1 (clamped) and = 1 (free).
inline constexpr double clamped_root = 1.8751040687119611, free_root = 4.7300407448627040;

/// The first mode of a clamped beam at the point at which the wave number times the distance from the clamp is `phase`;
/// 1 at the free end.
[[nodiscard]] inline double clamped_mode(double phase) {
  return (std::cosh(phase) - std::cos(phase) - 0.7340955137589128 * (std::sinh(phase) - std::sin(phase))) / 2;
}
/// The mode of a free beam whose wave number times its length is `root`; 1 at its ends.
[[nodiscard]] inline double free_mode(double root, double phase) {
  const double ratio = (std::cosh(root) - std::cos(root)) / (std::sinh(root) - std::sin(root));
  return (std::cosh(phase) + std::cos(phase) - ratio * (std::sinh(phase) + std::sin(phase))) / 2;
}

/// The first bending frequency in Hz by Euler-Bernoulli theory: b^2 sqrt(E I / (rho A)) / L^2, over 2 pi.
[[nodiscard]] inline double euler_bernoulli_frequency(const SquareBeam& b, End end) {
  const double root = end == End::clamped ? clamped_root : free_root;
  return root * root * std::sqrt(b.young * b.second_moment() / (b.density * b.area())) /
         (2 * std::numbers::pi * b.length * b.length);
}

/// The same frequency by Timoshenko's theory, with shear (Cowper's coefficient of a square) and rotary inertia: the
/// least omega for which the integration of
///
///     M' = -Q - omega^2 rho I psi,   psi' = M / (E I),   Q' = -omega^2 rho A w,   w' = psi + Q / (kappa G A)
///
/// leads from w = psi = 0 (clamped) or M = Q = 0 (free) to M = Q = 0 at the other end. It is integrated by a
/// Runge-Kutta method and found by bisection. For beams whose length is at least five heights.
[[nodiscard]] inline double timoshenko_frequency(const SquareBeam& b, End held) {
  const double shear = b.young / (2 * (1 + b.poisson));
  const double kappa = 10 * (1 + b.poisson) / (12 + 11 * b.poisson);
  const double bending = b.young * b.second_moment(), shearing = kappa * shear * b.area();
  using State = std::array<double, 4>;  // w, psi, M, Q
  const auto determinant = [&](double omega) {
    const double inertia = omega * omega * b.density;
    const auto slope = [&](const State& y) {
      return State{y[1] + y[3] / shearing, y[2] / bending, -y[3] - inertia * b.second_moment() * y[1],
                   -inertia * b.area() * y[0]};
    };
    const auto along = [](const State& y, double h, const State& k) {
      return State{y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2], y[3] + h * k[3]};
    };
    const auto end = [&](State y) {
      constexpr int intervals = 400;
      const double h = b.length / intervals;
      for (int i = 0; i < intervals; ++i) {
        const State a = slope(y), c = slope(along(y, h / 2, a)), d = slope(along(y, h / 2, c));
        const State e = slope(along(y, h, d));
        for (std::size_t n = 0; n < 4; ++n) y[n] += h / 6 * (a[n] + 2 * c[n] + 2 * d[n] + e[n]);
      }
      return y;
    };
    const bool clamped = held == End::clamped;
    const State one = end(clamped ? State{0, 0, 1, 0} : State{1, 0, 0, 0});
    const State other = end(clamped ? State{0, 0, 0, 1} : State{0, 1, 0, 0});
    return one[2] * other[3] - one[3] * other[2];
  };
  // Shear and rotary inertia only lower the first root. A free beam also has a double root at 0.
  double high = 2 * std::numbers::pi * euler_bernoulli_frequency(b, held) * 1.0001, low = high / 2;
  const bool sign = determinant(low) > 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((determinant(middle) > 0) == sign ? low : high) = middle;
  }
  return low / (2 * std::numbers::pi);
}

}  // namespace scenes
