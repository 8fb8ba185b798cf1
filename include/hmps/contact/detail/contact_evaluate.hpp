// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/detail/contact_declaration.hpp"
#include "hmps/contact/detail/contact_forces.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/step.hpp"
#include "hmps/core/executor.hpp"

namespace hmps::inline HMPS_ABI {

/// Resizes the arrays to fit the current lists.
template <class S, int D, class Kernel, class Friction, class Penalty>
void MetaballContact<S, D, Kernel, Friction, Penalty>::resize() {
  const std::size_t row_count = lists_.active().rows().size() - 1, awake_count = lists_.active().awake().size() - 1;
  masters_.resize(awake_count);
  moving_.resize(awake_count);
  load_.resize(awake_count);
  weight_.resize(lists_.active().master_of().size());
  entry_weight_.assign(lists_.active().master_of().size(), S(0));
  state_.assign(row_count, RowState{});
  force_.resize(row_count);
  batch_rows_.resize(row_count);
  touching_.reserve(row_count);
  batches_.resize((row_count + batch - 1) / batch);
  history_.resize(lists_.organs().slots());
  if constexpr (has_spring) motion_.choose(lists_.organs().particle(), lists_.active().awake());
}

/// Collects the position and velocity of each awake particle and computes its F_j^-1, one block of lanes at a time.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <class X, class V, class G, class E>
void MetaballContact<S, D, Kernel, Friction, Penalty>::gather(const X& x, const V& v, const G& F, const E& execute) {
  constexpr std::size_t width = static_cast<std::size_t>(Lanes<S>::width);
  static_assert(gather_batch % width == 0);
  suspect_.assign((masters_.size() + gather_batch - 1) / gather_batch, detail::no_index);
  detail::guarded(execute)(suspect_.size(), [&](std::size_t q) {
    const std::size_t end = std::min(masters_.size(), (q + 1) * gather_batch);
    for (std::size_t begin = q * gather_batch; begin < end; begin += width) {
      const auto B = inverse<Lanes<S>, D>(detail::gather_gradients<S, D>(
          F, [&](std::size_t l) { return lists_.active().awake()[std::min(begin + l, end - 1)].particle; }));
      const auto A = right_cauchy_green<Lanes<S>, D>(B);
      for (std::size_t l = 0; l < width && begin + l < end; ++l) {
        const Index j = lists_.active().awake()[begin + l].particle;
        auto& master = masters_[begin + l];
        auto& moving = moving_[begin + l];
        const Point place = lists_.place_of(x, j), velocity = v[j].template cast<S>();
        S size = 0;
        for (int r = 0; r < D; ++r) {
          master.x[r] = place[r];
          moving.v[r] = velocity[r];
          size += A(r, r).lane[l];
          for (int c = 0; c < D; ++c) {
            master.A[c][r] = A(r, c).lane[l];
            moving.B[c][r] = B(r, c).lane[l];
          }
        }
        if (!detail::is_finite(size + place.sum() + velocity.sum()))
          suspect_[q] = std::min(suspect_[q], static_cast<Index>(begin + l));
        // A flattened master forms no wall: it is moved out of reach.
        if (!detail::is_finite(size)) {
          for (int r = 0; r < D; ++r) {
            master.x[r] = S(1e6);
            for (int c = 0; c < D; ++c) master.A[c][r] = moving.B[c][r] = static_cast<S>(r == c);
          }
        }
      }
    }
  });
  check_suspects(x, v, F);
}

/// Throws for the first particle with an invalid position, velocity or deformation gradient.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <class X, class V, class G>
void MetaballContact<S, D, Kernel, Friction, Penalty>::check_suspects(const X& x, const V& v, const G& F) const {
  for (std::size_t q = 0; q < suspect_.size(); ++q) {
    if (suspect_[q] == detail::no_index) continue;
    for (std::size_t t = suspect_[q]; t < std::min(masters_.size(), (q + 1) * gather_batch); ++t) {
      const Index i = lists_.active().awake()[t].particle;
      detail::require_motion<D>(x[i].template cast<double>(), v[i].template cast<double>(), i);
      detail::require_gradient<D>(F[i].template cast<double>(), i);
    }
  }
}

/// Evaluates row `r`. Returns whether its slave touches, and if so, sets its weights of \paper{41, 42}. Sets `depth` if
/// the wall has lost the slave.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <class X, class V, class G>
bool MetaballContact<S, D, Kernel, Friction, Penalty>::touch(std::size_t r, const X& x, const V& v, const G& F,
                                                             S& depth) {
  const auto& row = lists_.active().rows()[r];
  const std::size_t begin = row.begin, size = lists_.active().rows()[r + 1].begin - begin;
  const Index slave = lists_.active().awake()[row.slave].particle;
  S *weight = weight_.data() + begin, *entry_weight = entry_weight_.data();
  const Index* entry = lists_.active().entry_of().data() + begin;
  RowState& state = state_[r];
  Quad place;
  detail::set_quad<S>(lists_.place_of(x, slave), place);

  const detail::SlaveContact<S, D> contact = detail::slave_contact<S, D, Kernel>(
      lists_.normal_density(), place,
      {masters_.data(), moving_.data(), lists_.active().master_of().data() + begin, size},
      static_cast<S>(lists_.organs().slave_radius(row.side, row.slot)), row.compression,
      [&] { return F[slave].template cast<S>().eval(); }, [&] { return v[slave].template cast<S>().eval(); },
      state.normal, weight);
  const bool touches = contact.penetration > S(0);
  const bool turned = touches && history_.turned_round(row.slot, contact.outward, contact.inside);
  if (contact.lost || turned) depth = contact.depth;
  if (!touches) {
    if (state.penetration > S(0))  // in the previous call
      for (std::size_t k = 0; k < size; ++k) entry_weight[entry[k]] = 0;
    return false;
  }
  state.penetration = contact.penetration;
  state.slip = contact.slip;
  for (std::size_t k = 0; k < size; ++k) entry_weight[entry[k]] = weight[k] *= contact.over_density;
  return true;
}

template <class S, int D, class Kernel, class Friction, class Penalty>
void MetaballContact<S, D, Kernel, Friction, Penalty>::fail(const ContactReport<S>& report, double time) const {
  detail::require(report.lost_in < lists_.organs().organs().size(), "hmps: the report given to check names organ ",
                  report.lost_in, ", but this contact has ", lists_.organs().organs().size(),
                  " organs; give the report of its own latest call");
  throw StateError(detail::message(
      "hmps: ", detail::is_nan(time) ? "" : detail::message("at t = ", time, " s "), "the wall of '",
      lists_.organs().organs()[report.lost_in].name, "' has lost particle ", report.lost_slave, ", which is ",
      report.lost_depth, " m (", report.lost_depth / static_cast<S>(settings_.spacing),
      " spacings) deep in it or has passed through it",
      report.lost > 1 ? detail::message("; walls have lost ", report.lost - 1, " more") : "",
      "; try a smaller time step, a stiffer penalty, more layers of masters, or a slower motion, and give all "
      "organs the spacing of the contact"));
}

/// Evaluates all rows, lists those that touch, and reports slaves that walls have lost.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <class X, class V, class G, class E>
void MetaballContact<S, D, Kernel, Friction, Penalty>::find(const X& x, const V& v, const G& F,
                                                            ContactReport<S>& report, const E& execute) {
  const std::size_t row_count = lists_.active().rows().size() - 1, count = (row_count + batch - 1) / batch;
  detail::guarded(execute)(count, [&](std::size_t q) {
    Batch result;
    for (std::size_t r = q * batch; r < std::min(row_count, (q + 1) * batch); ++r) {
      S depth = 0;
      if (touch(r, x, v, F, depth))
        batch_rows_[q * batch + result.count++] = static_cast<Index>(r);
      else {
        state_[r].penetration = 0;
        force_[r] = Quad{};
      }
      if (!(depth > S(0))) continue;
      ++result.lost;
      if (depth > result.depth) result.depth = depth, result.deepest = static_cast<Index>(r);
    }
    batches_[q] = result;
  });
  for (std::size_t q = 0; q < count; ++q) {
    const auto first = batch_rows_.begin() + static_cast<std::ptrdiff_t>(q * batch);
    touching_.insert(touching_.end(), first, first + static_cast<std::ptrdiff_t>(batches_[q].count));
    report.lost += batches_[q].lost;
    if (!(batches_[q].depth > report.lost_depth)) continue;
    const auto& row = lists_.active().rows()[batches_[q].deepest];
    report.lost_depth = batches_[q].depth;
    report.lost_slave = lists_.active().awake()[row.slave].particle;
    report.lost_in = lists_.organs().sides()[row.side].masters;
  }
}

/// Checks each organ once, in the first call after it was added.
template <class S, int D, class Kernel, class Friction, class Penalty>
template <class X>
void MetaballContact<S, D, Kernel, Friction, Penalty>::require_plausible_organs(const X& x) {
  constexpr std::size_t fewest = 16, most_samples = 64;  // for fewer, distances say little
  const detail::OrganPairs& organs = lists_.organs();
  detail::require(organs.organs().size() < 2 || !organs.pairs().empty(), "hmps: contact has ", organs.organs().size(),
                  " organs but no pair of them may touch; declare pairs with add_pair");
  for (; seen_organs_ < organs.organs().size(); ++seen_organs_) {
    const auto& organ = organs.organs()[seen_organs_];
    const std::size_t n = organ.end - organ.begin, samples = std::min(n, most_samples);
    const double reach = Kernel::radius * settings_.spacing;
    std::size_t alone = 0;
    for (std::size_t k = 0; n >= fewest && k < samples; ++k) {
      const std::size_t at = k * n / samples;
      const auto is_close = [&](std::size_t j) {  // or not finite, which `gather` reports
        const Point apart =
            (x[organs.members()[organ.begin + j].particle] - x[organs.members()[organ.begin + at].particle])
                .template cast<S>();
        return j != at && !(static_cast<double>(apart.squaredNorm()) > reach * reach);
      };
      std::size_t j = 0;
      while (j < n && !is_close(j)) ++j;
      alone += j == n ? 1 : 0;
    }
    detail::require(n < fewest || 10 * alone < 9 * samples, "hmps: ", alone, " of ", samples, " sampled particles of '",
                    organ.name, "' have no other particle within ", Kernel::radius, " spacings of ", settings_.spacing,
                    " m and thus form no wall; give contact the particles' spacing, in the unit of the positions");
  }
}

template <class S, int D, class Kernel, class Friction, class Penalty>
template <class X, class V, class G, class E>
ContactReport<S> MetaballContact<S, D, Kernel, Friction, Penalty>::survey(const X& x, const V& v, const G& F, double dt,
                                                                          const E& execute) {
  detail::require_step(dt);
  require_size(x, x.size(), "positions");
  require_size(v, x.size(), "velocities");
  lists_.organs().require_particles(x.size());
  require_plausible_organs(x);
  set_laws(dt);
  if (lists_.update(x, F, execute)) resize();
  const std::size_t row_count = lists_.active().rows().size() - 1;
  ContactReport<S> report;
  report.candidates = lists_.active().master_of().size();
  report.rebuilds = lists_.rebuilds();
  report.late = lists_.late();
  touching_.clear();
  if (row_count == 0) {
    history_.next_call();
    return report;
  }
  gather(x, v, F, execute);  // throws for an invalid state, which must not cost the history
  if constexpr (has_spring) {
    if (std::any_of(laws_.begin(), laws_.end(), [](const PairLaw& law) { return law.friction > S(0); }))
      motion_.update(x, lists_.organs().particle(), execute);
    else
      motion_.forget();
  }
  history_.next_call();
  try {
    find(x, v, F, report, execute);
    report.contacts = touching_.size();
    if (touching_.empty()) return report;
    if constexpr (!is_linear) require_stable(dt);
    report.sticking = push(dt, execute);
  } catch (...) {
    history_.take_back_call();
    throw;
  }
  for (const Index r : touching_)
    if (state_[r].penetration > report.penetration) {
      report.penetration = state_[r].penetration;
      report.deepest = lists_.active().awake()[lists_.active().rows()[r].slave].particle;
    }
  return report;
}

}  // namespace hmps::inline HMPS_ABI
