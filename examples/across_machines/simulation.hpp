// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include <hmps/bonds/lattice_bonds.hpp>
#include <hmps/force/internal_force.hpp>
#include <hmps/laws/mooney_rivlin.hpp>
#include <hmps/motion/control_region.hpp>
#include <hmps/motion/rigid_motion.hpp>
#include <hmps/terms/artificial.hpp>
#include <hmps/terms/elastic.hpp>
#include <hmps/terms/record.hpp>
#include <hmps/terms/viscous.hpp>
#include <hmps/time/symplectic_euler.hpp>

#include "../common/error.hpp"
#include "contact_of_rank.hpp"
#include "messages.hpp"
#include "partition.hpp"
#include "scene.hpp"

namespace across_machines {

/// Positions (m) and velocities (m/s).
struct State {
  std::vector<Vector> x, v;
};

/// Where the time of a rank went, in s; waiting for other ranks is in `messages`.
struct Times {
  double force = 0, contact = 0, surveys = 0, messages = 0;
};

using Bonds = hmps::LatticeBonds<float, 3>;
using Region = hmps::ControlRegion<double, 3>;

[[nodiscard]] inline auto force_of(const Bonds& bonds, std::vector<Gradient>& F) {
  return hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(20e3, 1e6)), hmps::artificial(10e3),
                              hmps::viscous(rho, 2e-3), hmps::record(hmps::matrices(F)));
}
using Force = decltype(force_of(std::declval<const Bonds&>(), std::declval<std::vector<Gradient>&>()));

/// The control regions among the particles `number(0)` to `number(X.size() - 1)` of the scene. `X` are their reference
/// positions. A region without a particle here is none.
template <class Number>
[[nodiscard]] std::vector<Region> regions_of(const Scene& scene, std::span<const Vector> X, Number&& number) {
  const std::array tracks{
      hmps::Keyframes<3>{{.time = 0, .value = Vector::Zero()}, {.time = 0.1, .value = Vector(0.04, 0, 0)}},
      hmps::Keyframes<3>{{.time = 0, .value = Vector::Zero()}, {.time = 0.01, .value = Vector(0, 0, -1.5e-3)}}};
  std::vector<Region> regions;
  for (std::size_t b = 0; b < tracks.size(); ++b) {
    std::vector<Index> particles;
    for (std::size_t k = 0; k < X.size(); ++k)
      if (scene.prescribed(number(k)) && scene.body(number(k)) == static_cast<int>(b))
        particles.push_back(static_cast<Index>(k));
    if (!particles.empty()) regions.emplace_back(particles, hmps::vectors(X), hmps::Translation<3>{tracks[b]});
  }
  return regions;
}

/// The run of one rank: its part of the scene, composed as on one machine, with messages in between.
class Simulation {
 public:
  /// Every rank knows the rank of every particle in `part_of`, and the state at time 0 or of a checkpoint.
  Simulation(const Scene& scene, const Ranks& ranks, const std::vector<int>& part_of, const Part& part, double dt,
             const State& state)
      : ranks_(ranks),
        part_(part),
        dt_(dt),
        X_(references(scene, part)),
        F_(part.particles.size(), Gradient::Identity()),
        f_(part.particles.size(), Vector::Zero()),
        bonds_(hmps::vectors(std::as_const(X_)), settings(scene),
               [&](std::size_t i, std::size_t j) {
                 return i < part.held && scene.body(part.particles[i]) == scene.body(part.particles[j]);
               }),
        force_(force_of(bonds_, F_)),
        contact_(scene, ranks, part_of, part) {
    const std::size_t own = part.own;
    for (std::size_t k = 0; k < part.particles.size(); ++k) {
      state_.x.push_back(state.x[part.particles[k]]);
      // Those of the second layer count for nothing.
      state_.v.push_back(k < part.held ? state.v[part.particles[k]] : Vector(Vector::Zero()));
    }
    force_.restrict_to([own](std::size_t i) { return i < own; });
    regions_ = regions_of(scene, std::span(X_).first(own), [&](std::size_t k) { return part.particles[k]; });

    // Particle i of the scene is in the middle of the order of the sweeps over the whole: `Blocks` subtracts its
    // displacement on one machine.
    middle_ = static_cast<Index>(scene.size() / 2);
    middle_rank_ = part_of[middle_];
    if (middle_rank_ == ranks.rank) middle_place_ = part.place_of(middle_);
    std::vector<Wanted> first, second;
    for (std::size_t k = own; k < part.particles.size(); ++k)
      (k < part.held ? first : second).push_back({part.particles[k], static_cast<Index>(k)});
    peers_ = introduce(
        ranks, first, second, [&](Index i) { return part_of[i]; }, [&](Index i) { return part.place_of(i); });
  }

  /// From t - dt to t. Every rank has to call it.
  void advance(double t) {
    const auto x = own(state_.x), v = own(state_.v), f = own(f_);
    double mark = MPI_Wtime();
    const auto lap = [&mark](double& sum) {
      const double now = MPI_Wtime();
      sum += now - mark;
      mark = now;
    };
    Vector common = Vector::Zero();
    if (middle_rank_ == ranks_.rank) common = state_.x[middle_place_] - X_[middle_place_];
    MPI_Bcast(common.data(), 3, MPI_DOUBLE, middle_rank_, ranks_.comm);
    bonds_.subtract_displacement(common);
    lap(times_.messages);
    force_(hmps::vectors(std::as_const(state_.x)), hmps::vectors(std::as_const(state_.v)), hmps::vectors(f_));
    hmps::kick(v, f, rho, dt_);
    for (const Region& region : regions_) region.prescribe(x, v, t, dt_);
    std::array<double, 2> change = contact_.change(state_.x, F_);
    require_finite(t);
    contact_.require_slow(t, dt_, state_.v);
    lap(times_.force);
    largest(ranks_, change);
    lap(times_.messages);
    if (ContactOfRank::due(change)) contact_.survey(state_.x, F_);
    lap(times_.surveys);
    contact_.gather(state_.x, state_.v, F_);
    lap(times_.messages);
    hmps::set_zero(hmps::vectors(f_));
    contact_.add(f_, t, dt_);
    lap(times_.contact);
    for (const Region& region : regions_) region.unload(f);
    hmps::kick(v, f, rho, dt_);
    hmps::drift(x, v, dt_);
    lap(times_.force);
    update();
    lap(times_.messages);
  }

  [[nodiscard]] const State& state() const { return state_; }  ///< the own particles come first
  [[nodiscard]] const ContactOfRank& contact() const { return contact_; }
  [[nodiscard]] const Times& times() const { return times_; }

 private:
  [[nodiscard]] static std::vector<Vector> references(const Scene& scene, const Part& part) {
    std::vector<Vector> X;
    for (const Index i : part.particles) X.push_back(scene.reference(i));
    return X;
  }
  [[nodiscard]] static hmps::BondSettings settings(const Scene& scene) {
    return {.spacing = l0, .unbonded = true, .axes = scene.axes()};
  }
  [[nodiscard]] hmps::VectorView<double, 3> own(std::vector<Vector>& all) const {
    return hmps::vectors<3>(all.data()->data(), part_.own);
  }

  /// Asks the other ranks for the state of the particles that are theirs: positions of both layers, velocities of the
  /// first.
  void update() {
    constexpr std::size_t vector = sizeof(Vector);
    exchange(
        ranks_, peers_, 2 * vector, vector,
        [&](Index i, char* bytes, bool first) {
          std::memcpy(bytes, state_.x[i].data(), vector);
          if (first) std::memcpy(bytes + vector, state_.v[i].data(), vector);
        },
        [&](Index i, const char* bytes, bool first) {
          std::memcpy(state_.x[i].data(), bytes, vector);
          if (first) std::memcpy(state_.v[i].data(), bytes + vector, vector);
        });
  }

  void require_finite(double t) const {
    for (std::size_t k = 0; k < part_.own; ++k)
      if (!state_.x[k].allFinite() || !state_.v[k].allFinite())
        throw hmps::StateError(examples::message(
            "hmps: at t = ", t, " s, particle ", part_.particles[k], " of the scene is at (", state_.x[k].transpose(),
            ") m with (", state_.v[k].transpose(), ") m/s; the run has become unstable: try a smaller time step"));
  }

  const Ranks& ranks_;
  const Part& part_;
  double dt_;
  std::vector<Vector> X_;
  State state_;
  std::vector<Gradient> F_;
  std::vector<Vector> f_;
  Bonds bonds_;
  Force force_;
  std::vector<Region> regions_;
  ContactOfRank contact_;
  Index middle_ = 0, middle_place_ = 0;
  int middle_rank_ = 0;
  std::vector<Peer> peers_;
  Times times_;
};

/// The same run as a program on one machine has it, without a message or a part: what all ranks together have to equal.
inline void run_plainly(const Scene& scene, double dt, std::size_t first, std::size_t last, State& state) {
  std::vector<Vector> X;
  for (std::size_t i = 0; i < scene.size(); ++i) X.push_back(scene.reference(i));
  std::vector<Gradient> F(X.size(), Gradient::Identity());
  std::vector<Vector> load(X.size(), Vector::Zero());
  const auto x = hmps::vectors(state.x), v = hmps::vectors(state.v), f = hmps::vectors(load);
  const Bonds bonds(hmps::vectors(std::as_const(X)), {.spacing = l0},
                    [&](std::size_t i, std::size_t j) { return scene.body(i) == scene.body(j); });
  Force force = force_of(bonds, F);
  const auto regions = regions_of(scene, X, [](std::size_t k) { return k; });
  Contact contact(contact_settings);
  const std::vector<SurfaceParticle> surface = scene.surface();
  declare(
      contact, surface, [&](std::size_t k) { return surface[k].slave; },
      [&](std::size_t k) { return surface[k].particle; }, [&](Index i) { return scene.prescribed(i); });
  for (std::size_t step = first + 1; step <= last; ++step) {
    const double t = static_cast<double>(step) * dt;
    force(x, v, f);
    hmps::kick(v, f, rho, dt);
    for (const Region& region : regions) region.prescribe(x, v, t, dt);
    hmps::set_zero(f);
    contact.check(contact.add(x, v, hmps::matrices(F), f, dt), t);
    for (const Region& region : regions) region.unload(f);
    hmps::kick(v, f, rho, dt);
    hmps::drift(x, v, dt);
  }
}

}  // namespace across_machines
