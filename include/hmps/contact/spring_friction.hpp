// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "hmps/contact/friction.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// Coulomb friction with a tangential spring per slave and wall, as in penalty contact of finite elements (Wriggers,
/// Computational Contact Mechanics, 2006, chapter 6) and in discrete elements (Cundall and Strack 1979). An extension:
/// the paper's law, like `CorrectedFriction`, takes only a share of the slip velocity; it resists a load only while
/// something slips, and therefore creeps. Here the elastic slip, the relative motion of slave and wall while they
/// stick, is stored and carries the load at rest.
///
/// The force is `spring_friction`, with the share of `CorrectedFriction` as damping, the largest that does not reverse
/// the slip within a step. The stiffness is the penalty coefficient k of the pair, so that with `LinearPenalty` the
/// elastic slip is at most mu times the penetration: walls yield as little tangentially as normally. The stiffness is
/// limited so that the spring does not take back more than the whole elastic slip within a step. Below twice that
/// limit, a mode that the damping stops in one step is stable at every step that is stable without contact.
///
/// Spring and damper share the limit, so that a slave that slows down comes to stick below the limit and not at it: at
/// the limit, friction follows the normal force, which feeds vibrations. Even so, a body without viscosity can keep
/// shaking and slide below the limit; see docs/theory.md.
///
/// Elastic slip follows the positions that contact receives, whatever moves them. It rotates with the masters. It is
/// lost where contact is lost, and by `refresh`. Evaluating the same state again keeps it, but a rotating wall then
/// seems to stand still, which changes the damping. For this, contact stores the positions of all particles of organs;
/// if no pair has friction, it stores none, and costs what contact with another law costs.
///
/// A program that is to be stopped and resumed must store `MetaballContact::history` with its state. Probing the force
/// at displaced positions, as `stable_step` and `step_causes` do, moves the elastic slip too: in the middle of a run,
/// restore the history afterwards.
struct SpringFriction : CorrectedFriction {
  static constexpr bool has_spring = true;
  /// Default of `ContactSettings::damping` for pairs with friction. Slaves at the friction limit can excite normal
  /// vibrations of a wall, because their friction follows the penetration; normal damping suppresses them.
  static constexpr double damping = 0.3;
};

namespace detail {

/// Whether contact stores the elastic slip of each slave and wall for `Law`.
template <class Law>
inline constexpr bool has_spring = requires {
  requires Law::has_spring;
};

/// The normal damping of `Law` as a fraction of critical, which applies if the settings specify none.
template <class Law>
[[nodiscard]] constexpr double damping_of() {
  if constexpr (requires { Law::damping; })
    return Law::damping;
  else
    return 0;
}

}  // namespace detail

/// Result of `spring_friction`.
template <class S, int D>
struct SpringForce {
  Vector<S, D> force;    ///< N/m3, on the slave.
  Vector<S, D> elastic;  ///< The remaining elastic slip in m.
  bool sticks;           ///< Whether the force is below the limit.
};

/// Friction by return mapping: a spring and a damper in parallel, in series with a slider. The spring has the elastic
/// slip `trial` (m, of the wall relative to the slave) and the stiffness `stiffness` (N/m4), the damper the slip
/// velocity `velocity` (m/s) and `damping` (N s/m4). If their force exceeds `limit` = mu |f_nor| (N/m3), the slider
/// moves: the force is cut to the limit, and the spring is shortened to what the damper leaves of the limit, but not
/// reversed. A slave that slows down thus sticks below the limit and not at it. Both vectors are tangential; without
/// stiffness no elastic slip remains.
template <class S, int D>
[[nodiscard]] SpringForce<S, D> spring_friction(const Vector<S, D>& trial, const Vector<S, D>& velocity, S stiffness,
                                                S damping, S limit) {
  SpringForce<S, D> result{Vector<S, D>::Zero(), trial, true};
  const S spring = stiffness * trial.norm();
  if (!(stiffness > S(0)))  // both ends are prescribed: nothing can slip back
    result.elastic.setZero();
  else if (spring > limit)
    result.elastic *= limit / spring;
  const Vector<S, D> viscous = damping * velocity;
  result.force = stiffness * result.elastic + viscous;
  const S size = result.force.norm();
  result.sticks = size <= limit;
  if (result.sticks) return result;
  result.force *= limit / size;
  if (const S held = stiffness * result.elastic.squaredNorm(); held > S(0)) {
    const S left = (result.force - viscous).dot(result.elastic) / held;
    result.elastic *= left > S(0) ? std::min(left, S(1)) : S(0);
  }
  return result;
}

}  // namespace hmps::inline HMPS_ABI
