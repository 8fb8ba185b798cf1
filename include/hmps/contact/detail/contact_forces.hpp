// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/detail/contact_declaration.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/step.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/per_particle.hpp"

namespace hmps::inline HMPS_ABI {

/// k of `pair` in N/m4. Throws `InputError` if `S` cannot represent it or a result computed from it and, for
/// `LinearPenalty`, if it is below 1 N/m4 and thus meant as a ratio. A law of your own may use its coefficient in any
/// way.
template <class S, int D, class Kernel, class Friction, class Penalty>
S MetaballContact<S, D, Kernel, Friction, Penalty>::penalty(std::size_t pair, double dt) const {
  const PenaltyStiffness& own = stiffness(pair);
  const double k = is_linear ? own.at(settings_.density, dt) : own.coefficient(settings_.density, dt);
  detail::require(!is_linear || k >= 1, "hmps: the penalty coefficient k is ", k,
                  " N/m4, with which walls do not push; ",
                  own.is_ratio() ? "check the density, the step and the ratio k~, in SI units"
                                 : "to give the ratio k~, use PenaltyStiffness::ratio");
  const double largest = k * std::max({1., settings_.spacing, damping(friction(pair)) > 0 ? settings_.density : 0.});
  detail::require(k >= static_cast<double>(std::numeric_limits<S>::min()) &&
                      largest <= static_cast<double>(std::numeric_limits<S>::max()),
                  "hmps: the penalty coefficient k is ", k, " N/m4 at a step of ", dt,
                  " s, which is beyond the range of the ", 8 * sizeof(S),
                  "-bit numbers that contact computes with; check the step and the units, or use double");
  return static_cast<S>(k);
}

/// Throws `InputError` if a particle that the contact may move is too light for the penalty of its pair at step `dt`.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <PerParticle Rho>
void MetaballContact<S, D, Kernel, Friction, Penalty>::require_heavy(const Rho& rho, double dt) const {
  for (std::size_t p = 0; p < own_.size(); ++p) {
    const double k = static_cast<double>(is_linear ? penalty(p, dt) : laws_[p].largest);
    const double least = k * dt * dt;  // the density at which k~ = 1
    if constexpr (std::is_arithmetic_v<Rho>)
      if (static_cast<double>(rho) * lists_.organs().least_volume() > least) continue;
    for (const std::size_t o : {lists_.organs().pairs()[p].first, lists_.organs().pairs()[p].second})
      lists_.organs().for_each_movable(o, [&](const auto& member) {
        const double own = static_cast<double>(at_particle(rho, member.particle));
        detail::require(
            own * member.volume > least, "hmps: particle ", member.particle, " of '", lists_.organs().organs()[o].name,
            "' has the density ", own, " kg/m3 and the volume ", member.volume,
            " l0^D, which makes its penalty ratio k~ = k dt^2 / rho = ", least / (own * member.volume),
            "; it must be below 1, but the contact was set for ", settings_.density,
            " kg/m3: set `ContactSettings::density` to that of the lightest body, or give its pair a softer "
            "`PairSettings::stiffness`");
      });
  }
}

/// Computes the laws of each pair for the step `dt`.
template <class S, int D, class Kernel, class Friction, class Penalty>
void MetaballContact<S, D, Kernel, Friction, Penalty>::set_laws(double dt) {
  laws_.resize(own_.size());
  for (std::size_t p = 0; p < own_.size(); ++p) {
    const S k = penalty(p, dt), fraction = static_cast<S>(2 * damping(friction(p)));
    // Without damping, k rho may overflow.
    const S critical = fraction > S(0) ? std::sqrt(k * static_cast<S>(settings_.density)) : S(0);
    laws_[p] = {k, fraction * critical, static_cast<S>(detail::finite_friction(friction(p))), 0};
  }
}

/// Stores for each pair the largest stiffness of the law over the rows that touch. Throws `StateError` if it is
/// unstable at step `dt`, and `InputError` if the force contradicts it.
template <class S, int D, class Kernel, class Friction, class Penalty>
void MetaballContact<S, D, Kernel, Friction, Penalty>::require_stable(double dt) {
  const double l0 = settings_.spacing;
  for (const Index r : touching_) {
    const auto& row = lists_.active().rows()[r];
    const auto& side = lists_.organs().sides()[row.side];
    PairLaw& law = laws_[side.pair];
    const double k = static_cast<double>(law.stiffness), p = static_cast<double>(state_[r].penetration);
    const double stiffness = penalty_.largest_stiffness(k, p, l0), force = penalty_.force(k, p, l0);
    const double k_tilde = stiffness * dt * dt / settings_.density;
    if (!(k_tilde < 1))
      throw StateError(detail::message(
          "hmps: particle ", lists_.active().awake()[row.slave].particle, " of '",
          lists_.organs().organs()[side.slaves].name, "' is ", p, " m (", p / l0, " spacings) deep in the wall of '",
          lists_.organs().organs()[side.masters].name, "', where the penalty law has a stiffness of ", stiffness,
          " N/m4 and k~ = ", k_tilde, " at a step of ", dt,
          " s; it must be below 1: use a smaller penalty coefficient or, if that is fixed, a shorter step"));
    // A force that starts from zero is at most its largest slope times p, up to rounding.
    detail::require(force >= 0 && force <= (1 + 1e-6) * stiffness * p, "hmps: the penalty law gives a force of ", force,
                    " N/m3 at a penetration of ", p, " m; it must lie between 0 and ", stiffness * p,
                    ", which is `largest_stiffness` times the penetration");
    law.largest = std::max(law.largest, stiffness);
  }
}

/// Computes the N of `CorrectedFriction` for every awake particle.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <class E>
void MetaballContact<S, D, Kernel, Friction, Penalty>::weigh(const E& execute) {
  detail::guarded(execute)(load_.size(), [&](std::size_t t) {
    const auto &own = lists_.active().awake()[t], &next = lists_.active().awake()[t + 1];
    S load = 0;
    if (!(own.flags & detail::is_prescribed)) {
      for (std::size_t q = own.rows; q < next.rows; ++q)
        load += static_cast<S>(state_[lists_.active().slave_rows()[q]].penetration > S(0));
      for (std::size_t e = own.entries; e < next.entries; ++e) load += entry_weight_[e];
    }
    load_[t] = load * own.inverse_volume;
  });
}

/// Computes the forces \paper{39, 40} of the rows that touch. Returns how many of these rows stick.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <class E>
std::size_t MetaballContact<S, D, Kernel, Friction, Penalty>::push(double dt, const E& execute) {
  const S rate = static_cast<S>(settings_.density / dt), spacing = static_cast<S>(settings_.spacing);
  const bool needs_load = std::any_of(laws_.begin(), laws_.end(), [](const PairLaw& law) {
    return (Friction::needs_load && law.friction > S(0)) || law.damping > S(0);
  });
  if (needs_load) weigh(execute);
  const auto& active = lists_.active();
  const std::size_t count = (touching_.size() + batch - 1) / batch;
  detail::guarded(execute)(count, [&](std::size_t q) {
    Batch result;
    for (std::size_t c = q * batch; c < std::min(touching_.size(), (q + 1) * batch); ++c) {
      const Index r = touching_[c];
      const RowState& state = state_[r];
      const auto& row = active.rows()[r];
      const PairLaw& law = laws_[lists_.organs().sides()[row.side].pair];
      S load = 0;
      if (needs_load) {
        // Sums in four equal numbers and uses the first: the compiler would vectorise a scalar sum, and its rounding
        // would then depend on the number of candidates without weight in between.
        Quad of_masters{};
        for (std::size_t e = row.begin; e < active.rows()[r + 1].begin; ++e)
          of_masters += Quad{load_[active.master_of()[e]]} * weight_[e];
        load = of_masters[0] + load_[row.slave];
      }
      const S most = rate * CorrectedFriction::share(load), stick = rate * Friction::share(load);
      Point velocity = state.slip;
      if constexpr (has_spring)
        if (law.friction > S(0)) velocity += follow(r, dt);
      const S normal = normal_force(penalty_, law.stiffness, state.penetration, spacing, std::min(law.damping, most),
                                    velocity.dot(state.normal));
      Point force = normal * state.normal;
      if (law.friction > S(0)) {
        const Point slip = tangential<S, D>(velocity, state.normal);
        if constexpr (has_spring) {
          Point& elastic = history_.slip(row.slot).value;
          const auto found = spring_friction<S, D>(elastic, slip, std::min(law.stiffness, stick / static_cast<S>(dt)),
                                                   stick, law.friction * normal);
          elastic = found.elastic;
          force += found.force;
          result.count += found.sticks;
        } else {
          force += friction_force<S, D>(slip, stick, law.friction * normal);
          result.count += stick * slip.norm() <= law.friction * normal;
        }
      } else if constexpr (has_spring) {  // none acts once friction is switched on
        history_.slip(row.slot) = Slip{};
      }
      detail::set_quad<S>(force, force_[r]);
    }
    batches_[q] = result;
  });
  std::size_t sticking = 0;
  for (std::size_t q = 0; q < count; ++q) sticking += batches_[q].count;
  return sticking;
}

/// Updates the elastic slip of row `r` by the motion since the previous call. Returns the part of the wall's velocity
/// at the slave (m/s) that \paper{31} omits: the part due to the wall's rotation.
template <class S, int D, class Kernel, class Friction, class Penalty>
typename MetaballContact<S, D, Kernel, Friction, Penalty>::Point
MetaballContact<S, D, Kernel, Friction, Penalty>::follow(Index r, double dt) {
  const auto& row = lists_.active().rows()[r];
  Slip& slip = history_.slip(row.slot);
  if (slip.starts) {
    slip.starts = false;
    return Point::Zero();
  }
  const S spacing = static_cast<S>(settings_.spacing);
  const Quad own = motion_.moved(row.slave);
  detail::WallMotion<S, D> wall(spacing);
  for (std::size_t e = row.begin; e < lists_.active().rows()[r + 1].begin; ++e) {
    if (!(weight_[e] > S(0))) continue;
    const Index j = lists_.active().master_of()[e];
    Quad place;
    detail::set_quad<S>((motion_.between(row.slave, j) / spacing).eval(), place);
    Quad step = motion_.moved(j);
    step -= own;
    place -= step * (S(0.5) / spacing);
    wall.add(weight_[e], place, step);
  }
  wall.finish();
  const Point moved = wall.moved(), &n = state_[r].normal;
  slip.value = wall.across(wall.turned(slip.value), n) + tangential<S, D>(moved, n);
  return wall.by_turning() / static_cast<S>(dt);
}

/// \paper{43}: each particle gathers the forces on it as a slave and the reactions \paper{41, 42} on it as a master.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <class Take, class E>
void MetaballContact<S, D, Kernel, Friction, Penalty>::hand_out(const Take& take, const E& execute) const {
  detail::guarded(execute)(load_.size(), [&](std::size_t t) {
    const auto &own = lists_.active().awake()[t], &next = lists_.active().awake()[t + 1];
    // Rows that do not touch have zero force: adding it is cheaper than testing.
    Quad force{};
    for (std::size_t q = own.rows; q < next.rows; ++q) force += force_[lists_.active().slave_rows()[q]];
    for (std::size_t e = own.entries; e < next.entries; ++e)
      force -= force_[lists_.active().entry_rows()[e]] * entry_weight_[e];
    take(own, Point(own.inverse_volume * detail::first<D, S>(force)));
  });
}

template <class S, int D, class Kernel, class Friction, class Penalty>
Vector<double, D> MetaballContact<S, D, Kernel, Friction, Penalty>::force_on_first(std::size_t pair) const {
  detail::require(pair < lists_.organs().pairs().size(), "hmps: there is no pair ", pair, ", only ",
                  lists_.organs().pairs().size(), " pairs, counted from 0");
  Vector<double, D> sum = Vector<double, D>::Zero();
  for (const Index r : touching_) {
    const auto& side = lists_.organs().sides()[lists_.active().rows()[r].side];
    if (side.pair != pair) continue;
    const Vector<double, D> force = detail::first<D, S>(force_[r]).template cast<double>();
    sum += side.slaves == lists_.organs().pairs()[pair].first ? force : -force;
  }
  return sum * std::pow(settings_.spacing, D);
}

template <class S, int D, class Kernel, class Friction, class Penalty>
template <class Visit>
void MetaballContact<S, D, Kernel, Friction, Penalty>::for_each_touch(Visit&& visit) const {
  const double cell = std::pow(settings_.spacing, D);
  for (const Index r : touching_) {
    const auto& row = lists_.active().rows()[r];
    const auto& side = lists_.organs().sides()[row.side];
    const Vector<double, D> force = detail::first<D, S>(force_[r]).template cast<double>();
    visit(Touch<D>{side.pair, side.slaves == lists_.organs().pairs()[side.pair].first,
                   lists_.active().awake()[row.slave].particle, static_cast<double>(state_[r].penetration),
                   state_[r].normal.template cast<double>(), force * cell});
  }
}

}  // namespace hmps::inline HMPS_ABI
