// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/contact.hpp"

namespace hmps {

/// One slave against one wall: \paper{28} to \paper{38}. True if it touches.
template <class S, int D, Metaball Ball, FrictionLaw Friction>
template <class X, class V, class G>
bool MetaballContact<S, D, Ball, Friction>::touch(std::size_t r, const X& x, const V& v, const G& F, bool& deep) {
  const auto& row = lists_.rows[r];
  const std::size_t end = lists_.rows[r + 1].begin;
  const S l0 = normal_density_.spacing(), radius = static_cast<S>(Ball::radius) * l0;
  const S over_radius_squared = S(1) / (radius * radius);
  const Point place = x[row.particle].template cast<S>();

  MasterSurface<S, D, Ball> surface;
  S compression = 0;
  for (std::size_t k = row.begin; k < end; ++k) {
    const Master& master = masters_[lists_.slot_of[k]];
    const S c = surface.reach(master.B, master.x - place, over_radius_squared);
    ball_[k] = c;
    if (c > 0) compression = std::max(compression, master.compression);
  }
  const auto centres = normal_density_.inverse(surface.density);
  if (!centres.reached) return false;
  RowState& state = state_[r];
  if (!surface.normal(radius, state.normal)) {
    deep = true;
    return false;
  }
  const S support = slave_support<S, D>(F[row.particle].template cast<S>(), state.normal, l0);
  // The stretch is at least 1 / compression: most slaves in reach need no second pass.
  if (!(centres.value - S(0.5) * l0 < support * compression)) return false;

  for (std::size_t k = row.begin; k < end; ++k)
    if (ball_[k] > 0) {
      const Index l = lists_.slot_of[k];
      surface.mean(ball_[k], masters_[l].B, v[lists_.slot_particle[l]].template cast<S>());
    }
  const S distance = surface_distance(surface.stretch(state.normal), centres.value, l0);
  state.penetration = penetration(support, distance);
  if (!(state.penetration > 0)) return false;
  deep = centres.deep;
  state.slip = surface.relative_velocity(v[row.particle].template cast<S>());
  state.over_density = S(1) / surface.density;
  for (std::size_t k = row.begin; k < end; ++k)
    if (ball_[k] > 0)
      // Several slaves may mark one master at once, all with the same value.
      std::atomic_ref<std::uint8_t>(slot_hit_[lists_.slot_of[k]]).store(1, std::memory_order_relaxed);
  return true;
}

/// Makes room for what the present lists name.
template <class S, int D, Metaball Ball, FrictionLaw Friction>
void MetaballContact<S, D, Ball, Friction>::resize() {
  const std::size_t row_count = lists_.rows.size() - 1, slot_count = lists_.slot_member.size();
  masters_.resize(slot_count);
  slot_hit_.resize(slot_count);
  ball_.resize(lists_.slot_of.size());
  state_.resize(row_count);
  row_hit_.resize(row_count);
  batch_rows_.resize(row_count);
  touching_.reserve(row_count);
  batches_.resize((std::max(row_count, slot_count) + batch - 1) / batch);
  load_.resize(lists_.touched.size());
}

/// F_j^-1 once per master. True if a master has moved further than the lists bear.
template <class S, int D, Metaball Ball, FrictionLaw Friction>
template <class X, class G, class E>
bool MetaballContact<S, D, Ball, Friction>::gather(const X& x, const G& F, const E& execute) {
  const std::size_t slot_count = masters_.size(), count = (slot_count + batch - 1) / batch;
  execute(count, [&](std::size_t q) {
    bool strayed = false;
    for (std::size_t l = q * batch; l < std::min(slot_count, (q + 1) * batch); ++l) {
      Master& master = masters_[l];
      const Index j = lists_.slot_particle[l];
      master.x = x[j].template cast<S>();
      // A master squashed flat is no wall: as this is not finite, every comparison with it fails.
      master.B = inverse<S, D>(F[j].template cast<S>());
      master.compression = detail::stretch_bound<S, D>(master.B);
      slot_hit_[l] = 0;
      strayed = strayed || lists_.strayed(l, master.x);
    }
    batches_[q].strayed = strayed;
  });
  for (std::size_t q = 0; q < count; ++q)
    if (batches_[q].strayed) return true;
  return false;
}

template <class S, int D, Metaball Ball, FrictionLaw Friction>
template <class X, class V, class G, class T, class E>
ContactReport<S> MetaballContact<S, D, Ball, Friction>::evaluate(const X& x, const V& v, const G& F, double dt,
                                                                 const T& f, const E& execute) {
  require(dt > 0 && std::isfinite(dt), "hmps: the step of a contact evaluation is ", dt, " s; give a positive number");
  require_size(v, x.size(), "velocities");
  require_size(f, x.size(), "contact forces");
  require(x.size() >= lists_.particles(), "hmps: an organ names particle ", lists_.particles() - 1,
          " but the views hold ", x.size(), " particles; indices count from 0 over all particles");
  const S l0 = normal_density_.spacing(), radius = static_cast<S>(Ball::radius) * l0;
  const S step = static_cast<S>(dt), skin = static_cast<S>(settings_.skin) * l0;
  if (lists_.update(x, v, F, step, radius, skin, execute)) resize();
  if (gather(x, F, execute)) {
    lists_.check(x, v, F, step, radius, skin, execute);
    resize();
    gather(x, F, execute);
  }
  const std::size_t row_count = lists_.rows.size() - 1;
  ContactReport<S> report;
  report.candidates = lists_.slot_of.size();
  report.rebuilds = lists_.rebuilds;
  report.late = lists_.late;
  touching_.clear();
  if (row_count == 0) return report;

  execute((row_count + batch - 1) / batch, [&](std::size_t q) {
    std::size_t count = 0, deep = 0;
    const std::size_t first = q * batch, last = std::min(row_count, first + batch);
    for (std::size_t r = first; r < last; ++r) {
      bool is_deep = false;
      row_hit_[r] = touch(r, x, v, F, is_deep);
      if (row_hit_[r]) batch_rows_[first + count++] = static_cast<Index>(r);
      deep += is_deep;
    }
    batches_[q] = {count, deep, false};
  });
  for (std::size_t q = 0; q < (row_count + batch - 1) / batch; ++q) {
    for (std::size_t k = 0; k < batches_[q].count; ++k) touching_.push_back(batch_rows_[q * batch + k]);
    report.deep += batches_[q].deep;
  }
  report.contacts = touching_.size();
  if (touching_.empty()) return report;

  const S k = static_cast<S>(settings_.stiffness.at(settings_.density, dt));
  const S mu = static_cast<S>(settings_.friction), rate = static_cast<S>(settings_.density / dt);
  const S damping = static_cast<S>(2 * settings_.damping) * std::sqrt(k * static_cast<S>(settings_.density));
  const bool needs_load = (Friction::needs_load && mu > 0) || damping > 0;
  if (needs_load)
    execute(lists_.touched.size(), [&](std::size_t t) {
      const auto& particle = lists_.touched[t];
      S load = 0;
      if (!(particle.flags & Lists::is_prescribed)) {
        for (std::size_t q = t == 0 ? 0 : lists_.touched[t - 1].rows; q < particle.rows; ++q)
          load += static_cast<S>(row_hit_[lists_.touched_rows[q]]);
        for (std::size_t q = t == 0 ? 0 : lists_.touched[t - 1].slots; q < particle.slots; ++q) {
          const Index l = lists_.touched_slots[q];
          if (!slot_hit_[l]) continue;
          for (std::size_t e = lists_.slot_begin[l]; e < lists_.slot_begin[l + 1]; ++e) {
            const auto& entry = lists_.slot_entries[e];
            if (row_hit_[entry.row]) load += ball_[entry.candidate] * state_[entry.row].over_density;
          }
        }
      }
      load_[t] = load;
    });

  execute(touching_.size(), [&](std::size_t q) {
    const Index r = touching_[q];
    RowState& state = state_[r];
    S load = 0;
    if (needs_load) {
      for (std::size_t c = lists_.rows[r].begin; c < lists_.rows[r + 1].begin; ++c)
        if (ball_[c] > 0) load += ball_[c] * load_[lists_.slot_touched[lists_.slot_of[c]]];
      load = load_[lists_.rows[r].touched] + load * state.over_density;
    }
    const S full = rate * CorrectedFriction::share(load);
    const S normal = normal_force(k, state.penetration, std::min(damping, full), state.slip.dot(state.normal));
    state.slip = tangential<S, D>(state.slip, state.normal);
    state.force = normal * state.normal;
    if (mu > 0) state.force += friction_force<S, D>(state.slip, rate * Friction::share(load), mu * normal);
    row_hit_[r] = mu > 0 && rate * Friction::share(load) * state.slip.norm() <= mu * normal ? 2 : 1;
  });
  for (const Index r : touching_) {
    if (state_[r].penetration > report.penetration) {
      report.penetration = state_[r].penetration;
      report.deepest = lists_.rows[r].particle;
    }
    report.sticking += row_hit_[r] == 2;
  }

  // Own forces as slave and reactions as master, each particle gathering its own.
  execute(lists_.touched.size(), [&](std::size_t t) {
    Point force = Point::Zero();
    bool hit = false;
    for (std::size_t q = t == 0 ? 0 : lists_.touched[t - 1].rows; q < lists_.touched[t].rows; ++q) {
      const Index r = lists_.touched_rows[q];
      if (!row_hit_[r]) continue;
      force += state_[r].force;
      hit = true;
    }
    for (std::size_t q = t == 0 ? 0 : lists_.touched[t - 1].slots; q < lists_.touched[t].slots; ++q) {
      const Index l = lists_.touched_slots[q];
      if (!slot_hit_[l]) continue;
      hit = true;
      for (std::size_t e = lists_.slot_begin[l]; e < lists_.slot_begin[l + 1]; ++e) {
        const auto& entry = lists_.slot_entries[e];
        if (row_hit_[entry.row])
          force -= (ball_[entry.candidate] * state_[entry.row].over_density) * state_[entry.row].force;
      }
    }
    if (hit) f.add(lists_.touched[t].particle, force);
  });
  return report;
}

}  // namespace hmps
