// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "stability/body.hpp"
#include "stability/groups.hpp"

namespace stability {
namespace endurance_detail {
namespace {

/// The drift of conserved quantities in a long run.
struct Drift {
  double energy, momentum, angular;  ///< each relative to the quantity of the body
};

/// A small bar that spins and vibrates for `steps` steps, with internal forces computed in `K`, positions in `P`, and
/// velocities and forces in `S`.
template <class K, class P, class S>
Drift endure(long steps, double rate, bool compensated) {
  const auto reference = lattice(3, 3, 8, spacing, Vector::Constant(0.1));
  const std::size_t n = reference.size();
  const hmps::LatticeBonds<K, 3> bonds(hmps::vectors(reference), {.spacing = spacing});
  std::vector<hmps::Vector<P, 3>> position, carry(n, hmps::Vector<P, 3>::Zero());
  std::vector<hmps::Vector<S, 3>> velocity, load(n, hmps::Vector<S, 3>::Zero());
  std::vector<hmps::Matrix<double, 3>> gradient(n);
  Vector centre = Vector::Zero();
  for (const Vector& X : reference) centre += X / static_cast<double>(n);
  for (const Vector& X : reference) {
    const Vector arm = X - centre;
    position.push_back(X.cast<P>());
    // A spin about x, and a stretching motion along z with 0.2 m/s at the ends.
    velocity.push_back((Vector(0, -rate * arm[2], rate * arm[1]) + 0.2 * Vector(0, 0, arm[2] / 4.2e-3)).cast<S>());
  }
  const auto x = hmps::vectors(position);
  const auto v = hmps::vectors(velocity), f = hmps::vectors(load);
  auto force = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(young / 2));
  // The velocity at the time of the positions is the mean of the velocities half a step before and after.
  std::vector<Vector> middle(n);
  // The diagnostics use double, whatever the scalar type of the forces.
  const hmps::BondList<double, 3> exact(hmps::vectors(reference), {.spacing = spacing});
  const double volume = spacing * spacing * spacing, mass = density * volume;
  const auto energy = [&] {
    hmps::deformation_gradient(exact, x, hmps::matrices(gradient));
    return hmps::kinetic_energy(hmps::vectors(middle), density, volume) +
           hmps::strain_energy(hmps::matrices(gradient), tissue, volume) +
           hmps::artificial_energy(exact, x, hmps::matrices(gradient), young / 2, volume);
  };
  const Vector spin = hmps::angular_momentum(x, v, density, volume, centre);
  const double scale = mass * static_cast<double>(n) * 0.2;
  double early = 0, late = 0;
  const long part = steps / 20;
  long early_count = 0, late_count = 0;
  const double dt = 1e-5;
  for (long step = 0; step < steps; ++step) {
    force(x, v, f);
    if (step % 53 == 0) {
      for (std::size_t i = 0; i < n; ++i)
        middle[i] = velocity[i].template cast<double>() + load[i].template cast<double>() * (0.5 * dt / density);
      if (step < part) early += energy(), ++early_count;
      if (step >= steps - part) late += energy(), ++late_count;
    }
    hmps::kick(v, f, density, dt);
    if (compensated)
      hmps::drift(x, v, hmps::vectors(carry), dt);
    else
      hmps::drift(x, v, dt);
  }
  early /= static_cast<double>(early_count);
  late /= static_cast<double>(late_count);
  const Vector momentum = hmps::linear_momentum(v, density, volume);
  const Vector now = hmps::angular_momentum(x, v, density, volume, centre);
  return {late / early - 1, momentum.norm() / scale, (now - spin).norm() / spin.norm()};
}

}  // namespace
}  // namespace endurance_detail

Table endurance(bool quick) {
  using namespace endurance_detail;
  const long steps = quick ? 10000 : 1000000;
  Table table{"endurance",
              {"Kernels", "Positions", "Velocities", "Drift", "Steps", "Revolutions", "Energy", "Momentum",
               "Angular momentum"}};
  const auto add = [&](const char* kernels, const char* positions, const char* velocities, const char* drift,
                       const Drift& lost, double rate) {
    table.rows.push_back({kernels, positions, velocities, drift, std::to_string(steps),
                          places(rate * 1e-5 * static_cast<double>(steps) / (2 * std::numbers::pi), 0),
                          digits(lost.energy, 2), digits(lost.momentum, 2), digits(lost.angular, 2)});
    return lost;
  };
  const double slow = 40, fast = 628.5;  // rad/s; the latter is a thousand revolutions in a million steps
  const Drift best =
      add("double", "double", "double", "plain", endure<double, double, double>(steps, slow, false), slow);
  table.check(std::abs(best.energy) < 1e-3, "the energy drifts in double");
  table.check(best.angular < 1e-9, "the angular momentum drifts in double");
  add("float", "double", "double", "plain", endure<float, double, double>(steps, slow, false), slow);
  add("float", "double", "float", "plain", endure<float, double, float>(steps, slow, false), slow);
  add("float", "float", "float", "plain", endure<float, float, float>(steps, slow, false), slow);
  add("float", "float", "float", "compensated", endure<float, float, float>(steps, slow, true), slow);
  if (!quick) {
    add("double", "double", "double", "plain", endure<double, double, double>(steps, fast, false), fast);
    add("float", "double", "float", "plain", endure<float, double, float>(steps, fast, false), fast);
    add("float", "float", "float", "compensated", endure<float, float, float>(steps, fast, true), fast);
  }
  return table;
}

}  // namespace stability
