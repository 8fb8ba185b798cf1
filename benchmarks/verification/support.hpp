// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "verification/method.hpp"

namespace verification {

/// The paper's soft tissue, here called the seed law: kappa / mu = 300.
inline const hmps::MooneyRivlin<> tissue{5000.0 / 3, 5000.0 / 3, 1e6};

/// A pseudo-random number in [-1, 1] that depends only on the arguments.
[[nodiscard]] inline double noise(std::size_t i, int c) {
  return std::sin(12.9898 * static_cast<double>(i) + 78.233 * (c + 1));
}

/// The particle of `body` nearest to `point` in the reference configuration.
template <int D>
[[nodiscard]] std::size_t nearest(const Body<D>& body, const hmps::Vector<double, D>& point) {
  std::size_t found = 0;
  for (std::size_t i = 1; i < body.size(); ++i)
    if ((body.reference[i] - point).squaredNorm() < (body.reference[found] - point).squaredNorm()) found = i;
  return found;
}

/// The displacement at `point` of a box of `n` cells whose corner is the origin: linear between the two nearest layers
/// along each axis and extrapolated beyond them, because the outermost particles lie half a spacing inside the faces.
template <int D>
[[nodiscard]] hmps::Vector<double, D> displacement_at(const Body<D>& body, const std::array<int, D>& n,
                                                      const hmps::Vector<double, D>& point) {
  hmps::Vector<double, D> sum = hmps::Vector<double, D>::Zero();
  for (int corner = 0; corner < 1 << D; ++corner) {
    double weight = 1;
    hmps::Vector<double, D> place;
    for (int c = 0; c < D; ++c) {
      const double layer = point[c] / body.spacing - 0.5;
      const double first = std::clamp(std::floor(layer), 0.0, static_cast<double>(n[static_cast<std::size_t>(c)]) - 2);
      const int other = corner >> c & 1;
      weight *= other ? layer - first : 1 - (layer - first);
      place[c] = (first + other + 0.5) * body.spacing;
    }
    sum += weight * body.displacement(nearest(body, place));
  }
  return sum;
}

/// Advances `body` by symplectic Euler at 0.75 of the stable step until `watch(t)` returns false. Particles for which
/// `moves(i)` is false stay in place. Throws `StateError` if the run breaks down.
template <int D, class Force, class Moves, class Watch>
void march(Body<D>& body, Force&& force, double density, Moves&& moves, Watch&& watch) {
  const double dt =
      0.75 * hmps::stable_step(force, body.x(), body.v(), density, {.spacing = body.spacing, .moves = moves}).limit;
  for (long step = 1;; ++step) {
    force(body.x(), body.v(), body.f());
    hmps::kick(body.v(), body.f(), density, dt);
    for (std::size_t i = 0; i < body.size(); ++i)
      if (!moves(i)) body.velocity[i].setZero();
    hmps::drift(body.x(), body.v(), dt);
    const double time = static_cast<double>(step) * dt;
    if (step % 64 == 0) hmps::check_state(body.x(), body.v(), body.F(), {.time = time});
    if (!watch(time)) return;
  }
}

/// The times at which a coordinate passes zero, interpolated between steps.
class Crossings {
 public:
  /// Adds a value; returns false as soon as the values have passed zero `wanted` times.
  bool add(double time, double value, std::size_t wanted) {
    if (last_time_ > 0 && (value > 0) != (last_ > 0))
      times_.push_back(time - (time - last_time_) * value / (value - last_));
    last_ = value;
    last_time_ = time;
    return times_.size() < wanted;
  }
  /// The time from the first passage to the last.
  [[nodiscard]] double span() const { return times_.back() - times_.front(); }

 private:
  std::vector<double> times_;
  double last_ = 0, last_time_ = 0;
};

/// Frequency in Hz of a small vibration, started from the reference configuration with the velocities `shape`, over the
/// period between the first and the third time at which the body's displacement along `shape` passes zero.
template <int D, class Force, class Moves>
[[nodiscard]] double frequency(Body<D>& body, Force&& force, double density, Moves&& moves,
                               const std::vector<hmps::Vector<double, D>>& shape) {
  body.position = body.reference;
  body.velocity = shape;
  Crossings crossings;
  march(body, force, density, moves, [&](double time) {
    double along = 0;
    for (std::size_t i = 0; i < body.size(); ++i) along += shape[i].dot(body.displacement(i));
    return crossings.add(time, along, 3);
  });
  return 1 / crossings.span();
}

inline constexpr auto all_move = [](std::size_t) { return true; };

}  // namespace verification
