// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "hmps/contact/penalty.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// Settings of `MetaballContact`.
struct ContactSettings {
  double spacing;  ///< l0 in m.
  double density;  ///< rho in kg/m3; that of the lightest particle where organs differ.
  /// mu_tan, \paper{23}; `PairSettings` may override it. With infinity, or 100 and more, every contact sticks.
  double friction = 0;
  PenaltyStiffness stiffness = PenaltyStiffness::ratio(0.3);  ///< k, \paper{25}.
  /// Normal damping as a fraction of critical, 2 sqrt(k rho), whatever the penalty law; an extension: the paper has
  /// none. It is limited so that it does not reverse the closing velocity within a step. If it is not set, it is that
  /// of the friction law, 0.3 with `SpringFriction`, for pairs with friction, and zero for pairs without.
  std::optional<double> damping = std::nullopt;
  double margin = 0.5;  ///< Margin of the Verlet lists in spacings: the motion that they tolerate.
};

namespace detail {

/// Throws `InputError` unless `mu` is a friction coefficient. Where bodies slide, it is a few at most, so a value from
/// 10 to 100 is taken to be a percentage.
inline void require_friction(double mu) {
  require(!is_nan(mu) && mu >= 0, "hmps: the friction coefficient is ", mu, "; give zero or a positive number");
  require(!(mu >= 10 && mu < 100), "hmps: the friction coefficient is ", mu, "; give ", mu / 100, " to mean ", mu,
          " per cent, or infinity to make every contact stick");
}
/// Throws `InputError` for settings that are not finite or out of range. `damping` is the value in force.
inline void validate(const ContactSettings& settings, double damping) {
  require(is_finite(settings.density) && settings.density > 0, "hmps: the density for contact is ", settings.density,
          " kg/m3; give a positive number");
  require_friction(settings.friction);
  require(is_finite(damping) && damping >= 0 && damping < 10, "hmps: the contact damping is ", damping,
          "; give zero or a positive fraction of critical, 0.3 for 30 per cent");
  require(is_finite(settings.margin) && settings.margin > 0 && settings.margin <= 10,
          "hmps: the margin of the contact lists is ", settings.margin,
          " spacings; give a positive number of spacings of at most 10, such as 0.5");
}
/// `mu` as a finite number: infinite friction holds a million times the normal force.
[[nodiscard]] inline double finite_friction(double mu) { return is_finite(mu) ? mu : 1e6; }

}  // namespace detail

/// Report of one evaluation.
template <class S>
struct ContactReport {
  std::size_t contacts = 0;  ///< Slaves with p > 0, counted once per organ they touch.
  std::size_t sticking = 0;  ///< Of these, the ones with friction below its limit.
  /// Slaves that a wall has lost: so deep that the outward direction is undefined, or pushed to the other side since
  /// the previous call. See `MetaballContact::check`. In walls of three or more layers this takes a penetration of
  /// about 1.75 spacings, in thinner ones of half the wall. A slave between two faces of one organ that both touch it
  /// is counted too.
  std::size_t lost = 0;
  Index lost_slave = 0;        ///< The deepest of these slaves.
  std::size_t lost_in = 0;     ///< The organ that has lost it.
  S lost_depth = 0;            ///< Its p in m; without a normal, that in an undeformed wall.
  S penetration = 0;           ///< The largest p in m.
  Index deepest = 0;           ///< The slave with this p.
  std::size_t candidates = 0;  ///< Slave-master pairs evaluated.
  std::size_t rebuilds = 0;    ///< Number of grid searches so far.
  /// Number of list checks so far that found a strain or normal to have changed by more than was allowed for, so that a
  /// contact may have been detected a few steps late. Zero, or rarely more, unless bodies chatter.
  std::size_t late = 0;
};

/// One slave that touches a wall, and the force of the wall.
template <int D>
struct Touch {
  std::size_t pair = 0;        ///< As returned by `add_pair`.
  bool slave_is_first = true;  ///< Whether the slave belongs to the first organ of the pair.
  Index slave = 0;
  double penetration = 0;      ///< p in m, \paper{38}.
  Vector<double, D> normal{};  ///< n_m, \paper{30}: from the wall to the slave.
  Vector<double, D> force{};   ///< In N, on the slave, \paper{39, 40}; that on the wall is opposite.
};

}  // namespace hmps::inline HMPS_ABI
