// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "scenes/body.hpp"

namespace stability {

using Vector = hmps::Vector<double, 3>;

/// The paper's soft tissue at its spacing.
inline constexpr double spacing = 1.2e-3, density = 1000, young = 20e3, d1 = 1e6;
inline const hmps::MooneyRivlin<> tissue = hmps::MooneyRivlin<>::from_young(young, d1);

template <class S>
[[nodiscard]] std::string name_of() {
  return std::is_same_v<S, float> ? "float" : "double";
}

/// nx x ny x nz particles of a cubic lattice, z fastest, the first at `corner` (m).
[[nodiscard]] inline std::vector<Vector> lattice(int nx, int ny, int nz, double l0, const Vector& corner) {
  std::vector<Vector> points;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) points.push_back(corner + l0 * Vector(i, j, k));
  return points;
}

template <class S>
using Body = scenes::Body<3, S>;

/// The end of a run.
struct Ending {
  bool alive = true;
  double time = 0;       ///< s
  std::string why = {};  ///< reason why the run did not go on
  double fastest = 0;    ///< m/s, largest speed of a particle during the run
};

/// Runs `body` for `duration` in steps `dt` under `force(x, v, f)`, with compensated drift. `prescribe(t)` sets the
/// velocities of particles with prescribed motion, after the kick. Stops at a NaN, at a speed beyond `speed_limit` and,
/// unless `may_invert`, at det F <= 0.
template <class S, class Force, class Prescribe>
Ending run(Body<S>& body, Force& force, double rho, double dt, double duration, double speed_limit, bool may_invert,
           Prescribe&& prescribe) {
  Ending ending;
  const auto steps = static_cast<long>(duration / dt + 0.5);
  for (long step = 1; step <= steps; ++step) {
    force(body.x(), body.v(), body.f());
    hmps::kick(body.v(), body.f(), rho, dt);
    ending.time = static_cast<double>(step) * dt;
    prescribe(ending.time);
    hmps::drift(body.x(), body.v(), hmps::vectors(body.carry), dt);
    if (step % 5 != 0 && step != steps) continue;
    const hmps::StateLimits limits{.speed_limit = speed_limit};
    const auto fault = may_invert ? hmps::find_fault(body.x(), body.v(), limits)
                                  : hmps::find_fault(body.x(), body.v(), body.F(), limits);
    for (const auto& v : body.velocity) ending.fastest = std::max(ending.fastest, static_cast<double>(v.norm()));
    if (!fault) continue;
    ending.alive = false;
    ending.why = fault->kind == hmps::FaultKind::not_finite ? "NaN"
                 : fault->kind == hmps::FaultKind::inverted ? "J <= 0"
                                                            : "speed";
    break;
  }
  return ending;
}
template <class S, class Force>
Ending run(Body<S>& body, Force& force, double rho, double dt, double duration, double speed_limit, bool may_invert) {
  return run(body, force, rho, dt, duration, speed_limit, may_invert, [](double) {});
}

/// The smallest det F in a body.
template <class S>
[[nodiscard]] double least_jacobian(const Body<S>& body) {
  double least = 1e300;
  for (const auto& F : body.gradient) least = std::min(least, static_cast<double>(F.determinant()));
  return least;
}

/// The recommended step at rest for a force on a body.
template <class S, class Force>
[[nodiscard]] double stable(Body<S>& body, Force& force, double rho) {
  return hmps::stable_step(force, body.x(), body.v(), rho, {.spacing = body.spacing}).step;
}

}  // namespace stability
