// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// v_im,tan in m/s, \paper{24}.
template <class S, int D>
[[nodiscard]] Vector<S, D> tangential(const Vector<S, D>& velocity, const Vector<S, D>& n) {
  return velocity - velocity.dot(n) * n;
}

/// Friction force density in N/m3, \paper{23, 40}, along the tangential velocity `v` of the wall relative to the slave,
/// so that it drags the slave along: `stick` v, where `stick` is a share of rho / dt, but at most `limit` = mu |f_nor|.
/// Zero where nothing slides.
template <class S, int D>
[[nodiscard]] Vector<S, D> friction_force(const Vector<S, D>& v, S stick, S limit) {
  const S speed = v.norm();
  if (!(speed > S(0)) || stick * speed <= limit) return stick * v;
  return (limit / speed) * v;
}

/// The fraction of rho v_tan / dt that a sticking slave takes in one step. `needs_load`: whether contact must first sum
/// how strongly each particle is acted upon. `share(load)` takes the sum described at `CorrectedFriction` and returns
/// the fraction. A law may also have `has_spring` and `damping`: see `SpringFriction`.
template <class Law>
concept FrictionLaw = requires(double load) {
  { Law::needs_load } -> std::convertible_to<bool>;
  { Law::share(load) } -> std::convertible_to<double>;
};

namespace detail {
template <class Law>
struct IsFrictionLaw : std::bool_constant<FrictionLaw<Law>> {};
/// Fails to compile unless `Law` is a `FrictionLaw`; the first line of the message names `Law`.
template <class Law>
struct RequireFrictionLaw {
  static_assert(IsFrictionLaw<Law>::value,
                "hmps: a friction law needs the constant needs_load, and share(load), static, the share of the "
                "relative velocity that a sticking slave takes in one step");
  static constexpr bool value = true;
};
}  // namespace detail

/// The cap of \paper{40} as printed: the slave takes all of the relative velocity. Together with the
/// reactions \paper{41, 42} and both roles of \paper{43} this over-corrects: a sticking pair of free
/// particles has its relative tangential velocity multiplied by -3 in each step.
struct PaperFriction {
  static constexpr bool needs_load = false;
  template <class S>
  [[nodiscard]] static constexpr S share(S) {
    return S(1);
  }
};

/// The cap of \paper{40} divided by the sum of all passes and reactions of one step, so that sticking brings the
/// relative tangential velocity to zero and never reverses it.
///
/// With w_il = c_il / C_i the weights of \paper{41, 42}, let N_p count how strongly particle p is acted upon: 1 for
/// each contact in which p is the slave, plus w_kp for each slave k that p is a master of; N_p = 0 if p is prescribed
/// (infinitely heavy). The share of contact i is 1 / (N_i + sum_l w_il N_l): the inverse absolute row sum of the matrix
/// that maps tangential impulses to relative velocities. That matrix is symmetric and non-negative, so a step with
/// these shares multiplies each of its modes by a factor between 0 and 1; if all contacts of a sheet slide alike, the
/// factor is 0. For two particles in both roles the share is a quarter if both are free, and a half if one is
/// prescribed; in a single role it is twice that.
struct CorrectedFriction {
  static constexpr bool needs_load = true;
  template <class S>
  [[nodiscard]] static constexpr S share(S load) {
    return load > S(0) ? S(1) / load : S(0);
  }
};

}  // namespace hmps::inline HMPS_ABI
