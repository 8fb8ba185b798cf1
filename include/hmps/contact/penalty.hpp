// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// The penalty coefficient k in N/m4 (force density per penetration). `ratio` is the paper's choice, \paper{25}:
/// halving the step makes the wall four times stiffer, and increases its chatter. `fixed` is a property of the scene
/// and does not depend on the step; `ratio(0.3)` at step dt0 equals `fixed(0.3 * density / (dt0 * dt0))`. Either way,
/// k~ = k dt^2 / rho must be below 1. If the stable step is dt_c without contact, contact lowers it to about dt_c
/// sqrt(1 - k~), and a tenth less for k~ near 0.75; `stable_step` computes it. With a `PenaltyLaw` of your own, the
/// stiffness of the law takes the place of k in this limit.
class PenaltyStiffness {
 public:
  /// k = k~ rho / dt^2. Throws `InputError` unless 0 < k~ < 1.
  [[nodiscard]] static PenaltyStiffness ratio(double k_tilde) {
    detail::require(k_tilde > 0 && k_tilde < 1, "hmps: the penalty ratio k~ is ", k_tilde,
                    "; it must lie between 0 and 1 (contact is unstable at 1 and above); the paper uses 0.3");
    return {k_tilde, true};
  }
  /// k in N/m4. Throws `InputError` unless positive and finite.
  [[nodiscard]] static PenaltyStiffness fixed(double k) {
    detail::require(detail::is_finite(k) && k > 0, "hmps: the penalty coefficient k is ", k,
                    " N/m4; give a positive number");
    return {k, false};
  }

  /// Fails to compile: a number may be either.
  template <class N>
  requires std::is_arithmetic_v<N> PenaltyStiffness(N) : PenaltyStiffness(0, false) {
    static_assert(!std::is_arithmetic_v<N>,
                  "hmps: a penalty stiffness is not a plain number: write hmps::PenaltyStiffness::ratio(k_tilde), "
                  "without unit, or hmps::PenaltyStiffness::fixed(k), in N/m4");
  }

  /// k in N/m4 for density (kg/m3) and step (s), whatever k~ is.
  [[nodiscard]] double coefficient(double density, double dt) const {
    return is_ratio_ ? value_ * density / (dt * dt) : value_;
  }
  /// The same, but throws `InputError` if a fixed k is so stiff that k~ reaches 1.
  [[nodiscard]] double at(double density, double dt) const {
    if (is_ratio_) return coefficient(density, dt);
    detail::require(value_ * dt * dt < density, "hmps: a penalty of ", value_,
                    " N/m4 makes k~ = ", value_ * dt * dt / density, " at a step of ", dt,
                    " s; it must be below 1: shorten the step below ", std::sqrt(density / value_),
                    " s or soften the penalty");
    return value_;
  }

  /// Whether it was given as k~, so that k depends on density and step.
  [[nodiscard]] bool is_ratio() const { return is_ratio_; }

 private:
  PenaltyStiffness(double value, bool is_ratio) : value_(value), is_ratio_(is_ratio) {}
  double value_;
  bool is_ratio_;
};

/// How the wall pushes: the normal force density as a function of the penetration. A law has two functions of the
/// penalty coefficient k (N/m4), the penetration p > 0 (m) and the spacing l0 (m):
/// - `law.force(k, p, l0)`: the force density in N/m3, which starts from zero at p = 0 and is never negative;
/// - `law.largest_stiffness(k, p, l0)`: the largest slope of the force up to p, in N/m4. It takes the place of k in the
///   condition k~ < 1, which is checked at each penetration that occurs.
///
/// Both must be const or static and must not depend on anything that changes, because any thread may call them. They
/// are called with `double`, whatever the scalar of the contact. `PenaltyStiffness::ratio` is meaningful only for laws
/// that are proportional to k. Model: `LinearPenalty`.
template <class Law>
concept PenaltyLaw = requires(const Law& law, double k, double p, double l0) {
  { law.force(k, p, l0) } -> std::convertible_to<double>;
  { law.largest_stiffness(k, p, l0) } -> std::convertible_to<double>;
};

/// The law of the paper, \paper{22, 39}: k p.
struct LinearPenalty {
  [[nodiscard]] static constexpr double force(double k, double p, double) { return k * p; }
  [[nodiscard]] static constexpr double largest_stiffness(double k, double, double) { return k; }
};

namespace detail {
/// A trait, because clang names the type if a trait fails, but not if a concept does.
template <class Law>
struct IsPenaltyLaw : std::bool_constant<PenaltyLaw<Law>> {};
/// Fails to compile unless `Law` is a `PenaltyLaw`; the first line of the message names `Law`.
template <class Law>
struct RequirePenaltyLaw {
  static_assert(IsPenaltyLaw<Law>::value,
                "hmps: a penalty law needs force(k, p, l0) in N/m3 and largest_stiffness(k, p, l0) in N/m4, const or "
                "static, where k is the penalty coefficient, p the penetration and l0 the spacing");
  static constexpr bool value = true;
};
}  // namespace detail

/// Normal force density in N/m3, \paper{22, 39}, along n_m: k p plus, as an extension, `damping` (N s/m4) times the
/// speed `closing` (m/s) at which wall and slave approach. Never attractive.
template <class S>
[[nodiscard]] S normal_force(S k, S penetration, S damping, S closing) {
  const S f = k * penetration + damping * closing;
  return f > S(0) ? f : S(0);
}

/// The same with the force of a `PenaltyLaw` instead of k p, at the spacing `l0` (m).
template <class Law, class S>
[[nodiscard]] S normal_force(const Law& law, S k, S penetration, S l0, S damping, S closing) {
  if constexpr (std::is_same_v<Law, LinearPenalty>) {  // in one expression, which some compilers round as a whole
    return normal_force(k, penetration, damping, closing);
  } else {
    const double force = law.force(static_cast<double>(k), static_cast<double>(penetration), static_cast<double>(l0));
    const S f = static_cast<S>(force) + damping * closing;
    return f > S(0) ? f : S(0);
  }
}

}  // namespace hmps::inline HMPS_ABI
