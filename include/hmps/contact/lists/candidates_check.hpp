// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/lists/candidates.hpp"
#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Numbers the particles of all organs once each, and divides the members into chunks.
template <class S, int D, Metaball Kernel>
void Candidates<S, D, Kernel>::number() {
  organs_.number_particles();
  const std::size_t count = particle().size();
  place_.assign(count, Point::Zero());
  drift_.assign(count, Point::Zero());
  metric_.assign(count, Matrix<S, D>::Identity());
  reach_.assign(count, S(0));
  compression_.assign(count, S(-1));
  bound_.assign(count, S(0));
  travel_.assign(count, S(0));
  strain_.assign(count, S(0));
  allowance_.assign(count, S(0));
  exceeding_.resize(count);
  watches_.resize((count + chunk - 1) / chunk);
  const auto& organs = organs_.organs();
  motion_.assign(organs.size(), OrganMotion{Point::Zero(), 0, 0});
  for (std::size_t o = 0; o < organs.size(); ++o)
    for (std::size_t m = organs[o].begin; m < organs[o].end; m += chunk)
      parts_.push_back({o, m, std::min(m + chunk, organs[o].end), 0, 0, Point::Zero()});
}

/// Builds the broad-phase list from the positions and reaches of the latest check.
template <class S, int D, Metaball Kernel>
template <class E>
void Candidates<S, D, Kernel>::build(const E& execute) {
  built_place_ = place_;
  built_reach_ = reach_;
  motion_.assign(motion_.size(), OrganMotion{Point::Zero(), 0, 0});
  broad_.build({organs_, place_, reach_, compression_, radius_, margin_},
               [&](std::size_t n, const std::function<void(std::size_t)>& body) { execute(n, body); });
  kept_master_.resize(broad_.masters().size());
  built_ = true;
  ++rebuilds_;
}

template <class S, int D, Metaball Kernel>
template <class X, class Gradients, class E>
bool Candidates<S, D, Kernel>::update(const X& x, const Gradients& F, const E& execute) {
  active_work_ += newly_active_;
  const std::size_t active_before = newly_active_;
  if (!built_ || ++age_ >= interval_ || active_work_ > cost_of_check() || !watch(x, execute)) {
    check(x, F, execute);
    return true;
  }
  if (newly_active_ == active_before) return false;
  select();
  return true;
}

template <class S, int D, Metaball Kernel>
template <class X, class Gradients, class E>
void Candidates<S, D, Kernel>::check(const X& x, const Gradients& F, const E& execute) {
  if (parts_.empty()) {
    number();
    built_ = false;
  }
  if (!built_) facing_.assign(organs_.slots(), {Point::Zero(), first_turn, false, false});
  // Sharper lists are worth about a tenth of the cost of evaluating them.
  interval_ = std::clamp<std::size_t>(8 * cost_of_check() / (active_.master_of().size() + 1), shortest_interval,
                                      longest_interval);
  bool is_late = measure(x, F, execute);
  measure_organs(execute);
  ++checks_;
  for (std::size_t s = 0; built_ && s < sides().size(); ++s)
    if (!(used(s) + S(0.4) * margin_ < broad_.limit(s))) built_ = false;
  if (!built_) {
    choose_origin(x);
    build(execute);
  }
  // Two particles may approach by twice the bound; the rest is for the growth of reaches.
  S most = std::numeric_limits<S>::max();
  for (std::size_t s = 0; s < sides().size(); ++s) most = std::min(most, S(0.4) * (broad_.limit(s) - used(s)));
  const S most_drift = S(0.5) * most;
  S fastest = 0;
  for (const Point& drift : drift_) fastest = std::max(fastest, drift.norm());
  if (static_cast<S>(interval_) * fastest > most_drift)
    interval_ = std::max(shortest_interval, static_cast<std::size_t>(most_drift / fastest));
  for (std::size_t i = 0; i < bound_.size(); ++i) {
    const S drift = static_cast<S>(interval_) * drift_[i].norm();
    if (drift > most_drift) drift_[i] *= most_drift / drift;
    bound_[i] = std::min(bound_[i], most - std::min(drift, most_drift));
    travel_[i] = bound_[i] + std::min(drift, most_drift);
    allowance_[i] = bound_[i] * bound_[i];
  }
  const std::size_t count = broad_.rows().size() - 1;
  constexpr std::size_t batch = 64;
  execute((count + batch - 1) / batch, [&](std::size_t q) {
    for (std::size_t r = q * batch; r < std::min(count, (q + 1) * batch); ++r) put_to_sleep(r);
  });
  for (std::size_t r = 0; r < count; ++r) {
    const Row& row = broad_.rows()[r];
    is_late = is_late || facing_[row.slot].late;
    if (!(row.rest > S(0) && row.rest < S(1))) continue;
    const auto limit = [&](Index i) {
      const S motion = row.rest * bound_[i];
      allowance_[i] = std::min(allowance_[i], motion * motion);
    };
    limit(row.slave);
    for (Index k = row.begin; k < row.kept; ++k) limit(kept_master_[k]);
  }
  late_ += is_late;
  age_ = newly_active_ = active_work_ = 0;
  select();
}

/// How much of its limit a side has used since the broad-phase list was built.
template <class S, int D, Metaball Kernel>
S Candidates<S, D, Kernel>::used(std::size_t side) const {
  const OrganMotion &a = motion_[sides()[side].slaves], &b = motion_[sides()[side].masters];
  return a.motion + b.motion + (a.moved - b.moved).norm() + b.growth;
}

/// Measures position, reach and strain of every particle. Returns whether some strain has changed by more than was
/// allowed for.
template <class S, int D, Metaball Kernel>
template <class X, class Gradients, class E>
bool Candidates<S, D, Kernel>::measure(const X& x, const Gradients& F, const E& execute) {
  constexpr std::size_t width = static_cast<std::size_t>(Lanes<S>::width);
  static_assert(chunk % width == 0);
  execute(watches_.size(), [&](std::size_t q) {
    bool late_here = false;
    Index flat = none;
    const std::size_t end = std::min(particle().size(), (q + 1) * chunk);
    for (std::size_t begin = q * chunk; begin < end; begin += width) {
      const auto deformation =
          gather_gradients<S, D>(F, [&](std::size_t l) { return particle()[std::min(begin + l, end - 1)]; });
      const auto B = inverse<Lanes<S>, D>(deformation);
      const auto A = right_cauchy_green<Lanes<S>, D>(B);
      const Lanes<S> stretch = stretch_bound<Lanes<S>, D>(deformation), compression = stretch_bound<Lanes<S>, D>(B);
      for (std::size_t l = 0; l < width && begin + l < end; ++l) {
        const std::size_t i = begin + l;
        const Point place = place_of(x, particle()[i]);
        bound_[i] = std::numeric_limits<S>::max();
        if (built_)
          bound_[i] = least_motion * normal_density_.spacing() + S(2) * longer() * (place - expected(i)).norm();
        drift_[i].setZero();
        if (built_) drift_[i] = (place - place_[i]) / static_cast<S>(std::max<std::size_t>(age_, 1));
        place_[i] = place;
        // |B r| = sqrt(r . A r) changes by half of |dA| over the smallest eigenvalue of A, as a share.
        S change = 0;
        for (int c = 0; c < D * D; ++c) {
          S& old = metric_[i](c % D, c / D);
          const S now = A(c % D, c / D).lane[l];
          change += (now - old) * (now - old);
          old = now;
        }
        change = S(0.5) * std::sqrt(change) * stretch.lane[l] * stretch.lane[l];
        late_here =
            late_here || (built_ && broad_.rows_of_begin(i) < broad_.rows_of_begin(i + 1) && change > strain_[i]);
        strain_[i] = built_ ? std::max({least_strain, S(4) * longer() * change, S(0.5) * strain_[i]}) : first_strain;
        const S reach = radius_ * stretch.lane[l];
        reach_[i] = reach;
        // A flattened master forms no wall.
        const bool is_wall = is_finite(compression.lane[l]) && is_finite(reach);
        if (!is_wall) flat = std::min(flat, static_cast<Index>(i));
        compression_[i] = is_wall ? compression.lane[l] : S(-1);
      }
    }
    watches_[q].late = late_here;
    watches_[q].flat = flat;
  });
  check_flat(F);
  bool any = false;
  for (const Watch& part : watches_) any = any || part.late;
  return any;
}

/// Moves the origin to the centre of the particles if they are so far from it that `S` resolves their distances only to
/// 1e-4 spacings or worse, which for float is beyond about a thousand spacings. Only before lists are built, and never
/// if `S` is as wide as the scalar type of `x`.
template <class S, int D, Metaball Kernel>
template <class X>
void Candidates<S, D, Kernel>::choose_origin(const X& x) {
  if constexpr (sizeof(typename X::Scalar) > sizeof(S)) {
    const double reach = static_cast<double>(normal_density_.spacing()) * 1.25e-4 /
                         static_cast<double>(std::numeric_limits<S>::epsilon());
    Point low = Point::Constant(std::numeric_limits<S>::max()), high = -low;
    for (const Point& place : place_) {
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
    const Vector<double, D> middle = 0.5 * (low.template cast<double>() + high.template cast<double>());
    if (place_.empty() || middle.cwiseAbs().maxCoeff() <= reach) return;
    origin_ += middle;
    for (std::size_t i = 0; i < place_.size(); ++i) place_[i] = place_of(x, particle()[i]);
  }
}

/// Throws if F has no inverse although its particle is not flattened: a `StateError` or, if nothing has written it, an
/// `InputError`.
template <class S, int D, Metaball Kernel>
template <class Gradients>
void Candidates<S, D, Kernel>::check_flat(const Gradients& F) const {
  for (std::size_t q = 0; q < watches_.size(); ++q) {
    if (watches_[q].flat == none) continue;
    for (std::size_t i = watches_[q].flat; i < std::min(particle().size(), (q + 1) * chunk); ++i)
      require_gradient<D>(F[particle()[i]].template cast<double>(), particle()[i]);
  }
}

/// Measures how far the organs have moved since the broad-phase list was built.
template <class S, int D, Metaball Kernel>
template <class E>
void Candidates<S, D, Kernel>::measure_organs(const E& execute) {
  execute(parts_.size(), [&](std::size_t q) {
    Part& part = parts_[q];
    const Point shift = motion_[part.organ].moved;
    part.motion = part.growth = 0;
    part.sum.setZero();
    for (std::size_t m = part.begin; m < part.end; ++m) {
      const Index i = members()[m].number;
      const Point u = built_ ? Point(place_[i] - built_place_[i]) : place_[i];
      part.sum += u;
      part.motion = std::max(part.motion, (u - shift).squaredNorm());
      if (built_ && (members()[m].flags & is_master)) part.growth = std::max(part.growth, reach_[i] - built_reach_[i]);
    }
  });
  std::vector<Point> shift(motion_.size());
  for (std::size_t o = 0; o < motion_.size(); ++o) {
    shift[o] = motion_[o].moved;
    motion_[o] = {Point::Zero(), 0, 0};
  }
  for (const Part& part : parts_) {
    OrganMotion& organ = motion_[part.organ];
    organ.motion = std::max(organ.motion, part.motion);
    organ.growth = std::max(organ.growth, part.growth);
    organ.moved += part.sum;
  }
  for (std::size_t o = 0; o < motion_.size(); ++o) {
    OrganMotion& organ = motion_[o];
    const auto& range = organs_.organs()[o];
    // A NaN slips through the maxima but not through the sum.
    if (!all_finite(organ.moved)) fail(range);
    // `motion` is relative to the mean of the previous check, which serves as well as the present one.
    const Point mean = organ.moved / static_cast<S>(range.end - range.begin);
    organ.motion = std::sqrt(organ.motion) + (mean - shift[o]).norm();
    organ.moved = mean;
  }
}

template <class S, int D, Metaball Kernel>
void Candidates<S, D, Kernel>::fail(const OrganPairs::OrganRange& organ) const {
  for (std::size_t m = organ.begin; m < organ.end; ++m)
    for (int c = 0; c < D; ++c)
      if (const S place = place_[members()[m].number][c]; !is_finite(place))
        throw StateError(message("hmps: contact found component ", c, " of the position of particle ",
                                 members()[m].particle, " of '", organ.name, "' to be ", place,
                                 "; the run has become unstable: try a shorter step or a softer penalty"));
  throw StateError(message("hmps: contact found the positions of '", organ.name,
                           "' to overflow; the run has become unstable: try a shorter step or a softer penalty"));
}

/// Builds the list of active rows.
template <class S, int D, Metaball Kernel>
void Candidates<S, D, Kernel>::select() {
  active_.clear();
  for (const Row& row : broad_.rows()) {
    if (row.rest > S(0) || row.kept <= row.begin) continue;
    active_.add(row.slave, row.side, row.slot, row.compression, kept_master_.data() + row.begin,
                kept_master_.data() + row.kept);
  }
  active_.finish(organs_);
}

}  // namespace hmps::inline HMPS_ABI::detail
