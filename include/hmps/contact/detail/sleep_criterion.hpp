// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "hmps/contact/detail/check_schedule.hpp"
#include "hmps/contact/detail/facing.hpp"
#include "hmps/contact/detail/particle_bounds.hpp"
#include "hmps/contact/master_surface.hpp"
#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Judges whether a slave could touch a wall before the next check, from the drift of the particles and the bounds on
/// their deviation and strain. A slave touches where R_im is less than half a spacing plus r_0 s_i / s_m, with s_i its
/// stretch along the normal and s_m that of the wall, so both sides are bounded: R_im from below, s_i / s_m from above.
template <class S, int D, Metaball Kernel>
class SleepCriterion {
 public:
  using Point = Vector<S, D>;
  /// The data to judge by.
  struct Source {
    const ParticleBounds<S, D>& particles;
    const NormalDensity<S, D, Kernel>& normal_density;
    CheckInterval interval;  // since the previous check and until the next
  };
  struct Slave {
    Index number, slot;  // no two slaves share a slot, so that they are judged in parallel
    S radius;            // r_0 in m
  };
  struct Verdict {
    std::size_t kept;  // number of masters that could be within reach before the next check
    S compression;     // bound of |F_j^-1| of these
    S rest;  // share of its bound by which each particle may deviate before the slave could touch: 1, 1/2, 1/4 or 0
  };

  /// Starts anew with `slots` slaves.
  void resize(std::size_t slots) { facing_.assign(slots, Facing<S, D>()); }

  /// Judges a slave and the `masters` of one wall. Writes the masters kept to `kept`, which must have room for all.
  [[nodiscard]] Verdict judge(const Source& source, const Slave& slave, std::span<const Index> masters, Index* kept);

  /// Whether the slave at `slot`, when it was last judged, had a wall that had turned further than was allowed for.
  [[nodiscard]] bool is_late(std::size_t slot) const { return facing_[slot].is_late(); }

 private:
  static constexpr std::size_t levels = 3;  // of `Verdict::rest` above 0
  struct Survey {
    Verdict verdict;
    S density[levels];  // bound of C_im at each level of rest
  };
  [[nodiscard]] static Survey survey(const Source& source, Index slave, std::span<const Index> masters, Index* kept);
  [[nodiscard]] static S length_along(const Point& direction, const Matrix<S, D>& A) {
    return std::sqrt(direction.dot(A * direction));
  }
  [[nodiscard]] static S widest(const Source& source, Index slave, std::span<const Index> masters,
                                Facing<S, D>& facing);

  std::vector<Facing<S, D>> facing_;  // per slot
};

/// Selects the masters that could be within reach before the next check. Bounds C from above with every master as close
/// as it comes if both particles continue their motion, and closer by the deviation allowed to both. With B = F_j^-1
/// and a motion m, |B (r + m)| >= |B r| - |B| |m|.
template <class S, int D, Metaball Kernel>
typename SleepCriterion<S, D, Kernel>::Survey SleepCriterion<S, D, Kernel>::survey(const Source& source, Index slave,
                                                                                   std::span<const Index> masters,
                                                                                   Index* kept) {
  const ParticleBounds<S, D>& particles = source.particles;
  const Point place = particles.place()[slave];
  const S radius = particles.radius(), calls = static_cast<S>(source.interval.until);
  Survey found{{0, S(0), S(0)}, {}};
  for (const Index j : masters) {
    Point apart = particles.place()[j] - place;
    const S strain = S(1) + particles.strain()[j];
    const S furthest = strain * particles.reach()[j] + particles.travel()[slave] + particles.travel()[j];
    if (particles.compression()[j] < S(0) || !(apart.squaredNorm() <= furthest * furthest)) continue;
    const Point drift = calls * (particles.drift()[j] - particles.drift()[slave]);
    const Point along = particles.metric()[j] * drift;
    if (const S ahead = -apart.dot(along); ahead > S(0)) apart += std::min(S(1), ahead / drift.dot(along)) * drift;
    const S distance = length_along(apart, particles.metric()[j]) / (strain * radius);
    const S deviation = particles.deviation()[slave] + particles.deviation()[j];
    S nearer = strain * particles.compression()[j] / radius * deviation;
    if (distance - nearer >= S(1)) continue;
    kept[found.verdict.kept++] = j;
    found.verdict.compression = std::max(found.verdict.compression, strain * particles.compression()[j]);
    for (std::size_t q = 0; q < levels; ++q, nearer *= S(0.5)) {
      const S nearest = std::max(S(0), distance - nearer);
      found.density[q] += Kernel::value(std::min(S(1), nearest * nearest));
    }
  }
  return found;
}

/// An upper bound, until the next check, of |F_i^T n| max |F_j^-1 n| over the masters: the slave touches where R_im
/// less half a spacing is below r_0 times this. |F^T n| and |F^-1 n| follow from A = F^-T F^-1; a normal that turns by
/// t changes them by at most t times the largest stretch.
template <class S, int D, Metaball Kernel>
S SleepCriterion<S, D, Kernel>::widest(const Source& source, Index slave, std::span<const Index> masters,
                                       Facing<S, D>& facing) {
  const ParticleBounds<S, D>& particles = source.particles;
  const S radius = particles.radius();
  MasterSurface<S, D, Kernel> surface;
  for (const Index j : masters)
    surface.reach(particles.metric()[j], particles.place()[j] - particles.place()[slave], S(1) / (radius * radius));
  Point outward;
  if (!surface.normal(radius, outward)) {
    facing.forget();
    return std::numeric_limits<S>::max();
  }
  facing.update(outward, source.interval.template ratio<S>());
  S compression = 0;
  for (const Index j : masters) {
    const S most = particles.compression()[j];
    const S along = length_along(outward, particles.metric()[j]) + facing.turn() * most;
    compression = std::max(compression, (S(1) + particles.strain()[j]) * std::min(most, along));
  }
  const S most = particles.reach()[slave] / radius;
  const S along = length_along(outward, inverse<S, D>(particles.metric()[slave])) + facing.turn() * most;
  return (S(1) + particles.strain()[slave]) * std::min(most, along) * compression;
}

template <class S, int D, Metaball Kernel>
typename SleepCriterion<S, D, Kernel>::Verdict SleepCriterion<S, D, Kernel>::judge(const Source& source,
                                                                                   const Slave& slave,
                                                                                   std::span<const Index> masters,
                                                                                   Index* kept) {
  Survey found = survey(source, slave.number, masters, kept);
  Verdict& verdict = found.verdict;
  const S l0 = source.normal_density.spacing();
  const auto rests = [&](S touching) {
    verdict.rest = 1;
    for (std::size_t q = 0; q < levels; ++q, verdict.rest *= S(0.5)) {
      const S centres = source.normal_density.inverse(found.density[q]).value;
      if (!(surface_distance(S(1), centres, l0) < slave.radius * touching)) return true;
    }
    verdict.rest = 0;
    return false;
  };
  // Try the bound for stretches and rotations in any direction and, only if it is too large, that along the normal.
  const ParticleBounds<S, D>& particles = source.particles;
  const S stretch = (S(1) + particles.strain()[slave.number]) * particles.reach()[slave.number] / particles.radius();
  Facing<S, D>& facing = facing_[slave.slot];
  if (rests(stretch * verdict.compression))
    facing.forget();
  else
    facing.trust(rests(widest(source, slave.number, std::span<const Index>(kept, verdict.kept), facing)));
  return verdict;
}

}  // namespace hmps::inline HMPS_ABI::detail
