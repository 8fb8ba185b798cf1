// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/view.hpp"
#include "hmps/diagnostics/detail/recorded.hpp"

namespace hmps::inline HMPS_ABI {

/// The interval of det F within which section 4.1 of the paper regards volume as conserved.
struct JacobianInterval {
  double low = 0.98;
  double high = 1.02;
};

/// Statistics of det F, the volume ratio of the particles.
struct JacobianStatistics {
  std::size_t count = 0;  ///< number of particles counted
  double mean = 0;
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  double share_within = 0;   ///< fraction of the particles inside the interval, bounds included
  std::size_t smallest = 0;  ///< particle with the smallest det F; the first of equals
  std::size_t largest = 0;   ///< particle with the largest det F; the first of equals
};

/// Counts every particle.
struct EveryParticle {
  constexpr bool operator()(std::size_t) const { return true; }
};

/// Statistics of det F over the particles for which `counts(i)` holds, for example those outside the control regions,
/// as in section 4.1 of the paper. Throws `InputError` if there are none, for a set of another scene, for an interval
/// whose bounds are interchanged or per cent, and for an F of zeros, which means that nothing has written it. A NaN in
/// F gives a NaN mean; `check_state` finds the particle.
///
/// @param F  deformation gradients, \paper{11}
template <class T, int D, class Counts = EveryParticle, Executor E = Serial>
[[nodiscard]] JacobianStatistics jacobian_statistics(const MatrixView<T, D>& F, const JacobianInterval& interval = {},
                                                     Counts&& counts = {}, const E& execute = {}) {
  detail::require_recorded(F);
  detail::require(!detail::is_nan(interval.low) && !detail::is_nan(interval.high) && interval.low <= interval.high,
                  "hmps: the interval of det F reaches from ", interval.low, " to ", interval.high,
                  "; give its lower bound first");
  detail::require(interval.low < 10, "hmps: the interval of det F reaches from ", interval.low, " to ", interval.high,
                  ", which no tissue reaches; give ratios, 0.98 and 1.02 for 98 and 102 per cent");
  detail::require_scene(counts, F.size(), "to be counted");
  struct Sum : JacobianStatistics {
    std::size_t within = 0;
  };
  const auto one = [&](std::size_t i) {
    Sum s;
    if (!counts(i)) return s;
    const Matrix<double, D> gradient = F[i].template cast<double>();
    const double J = determinant(gradient);
    s.count = 1;
    s.mean = s.min = s.max = J;
    s.within = J >= interval.low && J <= interval.high ? 1 : 0;
    s.smallest = s.largest = i;
    return s;
  };
  // Particles come in order, so among equal values the one already in `a` is the first.
  const auto merge = [](Sum a, const Sum& b) {
    if (b.min < a.min) {
      a.min = b.min;
      a.smallest = b.smallest;
    }
    if (b.max > a.max) {
      a.max = b.max;
      a.largest = b.largest;
    }
    a.count += b.count;
    a.mean += b.mean;
    a.within += b.within;
    return a;
  };
  Sum all = reduce(F.size(), Sum{}, one, merge, execute);
  detail::require(all.count > 0,
                  "hmps: the statistics of det F were requested for no particle; `counts` must be true for some");
  all.mean /= static_cast<double>(all.count);
  all.share_within = static_cast<double>(all.within) / static_cast<double>(all.count);
  return all;
}

}  // namespace hmps::inline HMPS_ABI
