// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/penalty.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// Coulomb friction with a tangential spring per slave and wall, as in penalty contact of finite elements (Wriggers,
/// Computational Contact Mechanics, 2006, chapter 6) and of discrete elements (Cundall and Strack 1979), beyond the
/// paper. A law that takes a share of the slip velocity alone, such as the other two, holds a load only while
/// something slips, and so lets it creep. Here the elastic slip, what slave and wall have moved along each other while
/// they stuck, is remembered and bears the load at rest.
///
/// The force is `spring_friction` with the share of `CorrectedFriction` as the damping, the most that does not reverse
/// the slip within a step. The stiffness is the penalty coefficient k of the pair: the elastic slip is then at most mu
/// times the penetration, so that walls yield as little along themselves as they do across. It is cut where the spring
/// would take back more than the whole elastic slip within a step; below twice that, a mode that the share stops at
/// once is stable at each step that is stable without contact.
///
/// Elastic slip is that of the positions that contact sees, whoever moves them. It turns with the masters, and is
/// forgotten where contact is lost, by `refresh`, and so by a program that is stopped and resumed. Evaluating the same
/// state twice changes nothing. The positions of all particles of organs are kept for it.
struct SpringFriction : CorrectedFriction {
  static constexpr bool has_spring = true;
  /// Of `ContactSettings`, where that names none. Slaves at the limit of friction can shake a wall in the direction
  /// across, since their force follows the penetration; damping of that direction quiets them.
  static constexpr double damping = 0.3;
};

namespace detail {

/// Whether contact keeps the elastic slip of each slave and wall for `Law`.
template <class Law>
inline constexpr bool has_spring = requires {
  requires Law::has_spring;
};

/// The normal damping of `Law` as a fraction of critical, where the scene names none.
template <class Law>
[[nodiscard]] constexpr double damping_of() {
  if constexpr (requires { Law::damping; })
    return Law::damping;
  else
    return 0;
}

}  // namespace detail

/// What `spring_friction` returns.
template <class S, int D>
struct SpringForce {
  Vector<S, D> force;    ///< N/m3, on the slave.
  Vector<S, D> elastic;  ///< The elastic slip that is left, m.
  bool sticks;           ///< Whether the force is below the limit.
};

/// Friction by return mapping: the elastic slip `trial` (m, of the wall relative to the slave) is cut to what `limit` =
/// mu |f_nor| (N/m3) holds at `stiffness` (N/m4), and the rest has slid. The force is that of the spring and of a
/// damping (N s/m4) of the slip velocity `velocity` (m/s), and of `limit` at most. Both vectors are tangential, the
/// stiffness is positive.
template <class S, int D>
[[nodiscard]] SpringForce<S, D> spring_friction(const Vector<S, D>& trial, const Vector<S, D>& velocity, S stiffness,
                                                S damping, S limit) {
  SpringForce<S, D> result{Vector<S, D>::Zero(), trial, true};
  const S spring = stiffness * trial.norm();
  if (spring > limit) result.elastic *= limit / spring;
  result.force = stiffness * result.elastic + damping * velocity;
  const S size = result.force.norm();
  result.sticks = size <= limit;
  if (!result.sticks) result.force *= limit / size;
  return result;
}

}  // namespace hmps::inline HMPS_ABI
