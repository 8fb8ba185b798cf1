// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/view.hpp"
#include "hmps/diagnostics/detail/recorded.hpp"

namespace hmps::inline HMPS_ABI {

/// Input of `find_fault` and `check_state` besides the state.
struct StateLimits {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< time in s, for the message
  double speed_limit =
      std::numeric_limits<double>::infinity();              ///< in m/s; for example `sound_speed` of the stiffest law
  std::function<std::string(std::size_t)> organ_name = {};  ///< organ of a particle, for the message
};

/// Kinds of invalid states.
enum class FaultKind {
  not_finite,  ///< NaN or infinity in x, v or F
  inverted,    ///< det F <= 0, where the law is undefined
  too_fast,    ///< faster than the speed limit
};

/// The first fault of a state.
struct Fault {
  FaultKind kind;
  std::size_t particle;
  double value;         ///< the non-finite component, det F, or the speed in m/s
  std::string message;  ///< time, particle, organ, value, and remedy
};

namespace detail {

/// Result of one pass over the particles; partial results are merged in particle order.
struct StateSurvey {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t not_finite = none;
  std::size_t most_crushed = none, fastest = none;
  double jacobian = std::numeric_limits<double>::infinity();
  double squared_speed = -1;

  [[nodiscard]] static StateSurvey merge(StateSurvey a, const StateSurvey& b) {
    if (a.not_finite == none) a.not_finite = b.not_finite;
    if (b.jacobian < a.jacobian) {
      a.jacobian = b.jacobian;
      a.most_crushed = b.most_crushed;
    }
    if (b.squared_speed > a.squared_speed) {
      a.squared_speed = b.squared_speed;
      a.fastest = b.fastest;
    }
    return a;
  }
};

/// Name and value of the first component of particle `i` that is not finite.
template <class T, int N>
[[nodiscard]] bool name_not_finite(const View<T, N>& view, std::size_t i, const char* name, std::string& found,
                                   double& value) {
  for (int c = 0; c < N; ++c) {
    value = static_cast<double>(view(i, c));
    if (!is_finite(value)) {
      found = message("component ", c, " of its ", name, " is ", value);
      return true;
    }
  }
  return false;
}

[[nodiscard]] inline std::string fault_place(const StateLimits& limits, std::size_t particle) {
  std::string place = "hmps: ";
  if (!is_nan(limits.time)) place += message("at t = ", limits.time, " s ");
  place += message("particle ", particle);
  if (limits.organ_name) place += " of " + limits.organ_name(particle);
  return place + ": ";
}

template <class X, class V, class FView, int D, class E>
[[nodiscard]] std::optional<Fault> find_fault(const VectorView<X, D>& x, const VectorView<V, D>& v, const FView* F,
                                              const StateLimits& limits, const E& execute) {
  require_view(x, "positions");
  require_size(v, x.size(), "velocities");
  require(!is_nan(limits.speed_limit) && limits.speed_limit >= 0, "hmps: the speed limit is ", limits.speed_limit,
          " m/s; give a positive number");
  if (F != nullptr) require_size(*F, x.size(), "deformation gradients");
  const auto survey = [&](std::size_t i) {
    StateSurvey s;
    const double sum = x[i].template cast<double>().sum(), speed = v[i].template cast<double>().squaredNorm();
    bool finite = is_finite(sum) && is_finite(speed);
    if (F != nullptr) {
      const Matrix<double, D> gradient = (*F)[i].template cast<double>();
      s.jacobian = determinant(gradient);
      finite = finite && is_finite(gradient.sum()) && is_finite(s.jacobian);
      s.most_crushed = i;
    }
    s.squared_speed = speed;
    s.fastest = i;
    if (!finite) s.not_finite = i;
    return s;
  };
  const StateSurvey found = reduce(x.size(), StateSurvey{}, survey, StateSurvey::merge, execute);

  if (found.not_finite != StateSurvey::none) {
    const std::size_t i = found.not_finite;
    std::string what = "its state overflows";
    double value = std::numeric_limits<double>::quiet_NaN();
    if (!name_not_finite(x, i, "position", what, value) && !name_not_finite(v, i, "velocity", what, value) &&
        F != nullptr)
      (void)name_not_finite(*F, i, "deformation gradient", what, value);
    return Fault{FaultKind::not_finite, i, value,
                 fault_place(limits, i) + what +
                     "; check more often to see where it began, and try a smaller time step (stable_step)"};
  }
  if (F != nullptr && found.jacobian <= 0) {
    const std::size_t i = found.most_crushed;
    if ((*F)[i].isZero(0)) require_recorded(*F);
    return Fault{FaultKind::inverted, i, found.jacobian,
                 fault_place(limits, i) + message("det F is ", found.jacobian, ", so it is turned inside out") +
                     "; try a smaller time step, a slower motion of what squeezes it, a softer contact, more "
                     "particles through the wall, or the law as Continued{law}"};
  }
  if (found.squared_speed > limits.speed_limit * limits.speed_limit) {
    const std::size_t i = found.fastest;
    const double speed = std::sqrt(found.squared_speed);
    return Fault{FaultKind::too_fast, i, speed,
                 fault_place(limits, i) +
                     message("its speed is ", speed, " m/s, above the limit of ", limits.speed_limit,
                             " m/s, the speed of sound if you gave that") +
                     "; try a smaller time step (stable_step), a smaller contact penalty, or a slower motion"};
  }
  return std::nullopt;
}

}  // namespace detail

/// Checks a state for signs of a failed simulation, in this order: NaN or infinity (reports the first such particle),
/// det F <= 0 (the particle with the smallest), a speed above `limits.speed_limit` (the fastest particle). Returns an
/// empty result for a valid state. The result does not depend on the executor. Throws `InputError` for an F of zeros,
/// which means that nothing has written it.
///
/// @param x  positions in m
/// @param v  velocities in m/s
/// @param F  deformation gradients, \paper{11}
template <class X, class V, class T, int D, Executor E = Serial>
[[nodiscard]] std::optional<Fault> find_fault(const VectorView<X, D>& x, const VectorView<V, D>& v,
                                              const MatrixView<T, D>& F, const StateLimits& limits,
                                              const E& execute = {}) {
  return detail::find_fault(x, v, &F, limits, execute);
}
/// The same for particles that have no deformation gradient.
template <class X, class V, int D, Executor E = Serial>
[[nodiscard]] std::optional<Fault> find_fault(const VectorView<X, D>& x, const VectorView<V, D>& v,
                                              const StateLimits& limits, const E& execute = {}) {
  return detail::find_fault(x, v, static_cast<const MatrixView<const double, D>*>(nullptr), limits, execute);
}

/// Throws a `StateError` with the message of `find_fault`: time, particle, organ, value and remedy.
template <class X, class V, class T, int D, Executor E = Serial>
void check_state(const VectorView<X, D>& x, const VectorView<V, D>& v, const MatrixView<T, D>& F,
                 const StateLimits& limits, const E& execute = {}) {
  if (const auto fault = find_fault(x, v, F, limits, execute)) throw StateError(fault->message);
}
/// The same for particles that have no deformation gradient.
template <class X, class V, int D, Executor E = Serial>
void check_state(const VectorView<X, D>& x, const VectorView<V, D>& v, const StateLimits& limits,
                 const E& execute = {}) {
  if (const auto fault = find_fault(x, v, limits, execute)) throw StateError(fault->message);
}

}  // namespace hmps::inline HMPS_ABI
