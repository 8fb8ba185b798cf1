// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "hmps/contact/penalty.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// What a scene says about its contacts.
struct ContactSettings {
  double spacing;                                             ///< l0 in m.
  double density;                                             ///< rho in kg/m3.
  double friction = 0;                                        ///< mu_tan, \paper{23}; see also `PairSettings`.
  PenaltyStiffness stiffness = PenaltyStiffness::ratio(0.3);  ///< k, \paper{25}.
  /// Normal damping as a fraction of the critical 2 sqrt(k rho); beyond the paper, which has none. It
  /// is cut where it would reverse the closing velocity within a step. Where none is given, zero, or what the friction
  /// law brings (`SpringFriction::damping`).
  std::optional<double> damping = std::nullopt;
  double margin = 0.5;  ///< In spacings: how much motion the candidate lists bear before they are rebuilt.
};

/// What one evaluation of the contact met.
template <class S>
struct ContactReport {
  std::size_t contacts = 0;  ///< Slaves with p > 0, counted once per organ that they touch.
  std::size_t sticking = 0;  ///< Of those, the ones whose friction is below its limit.
  /// Slaves that their wall has lost: so deep that it no longer tells which way is out, or pushed to the other side
  /// since the call before. See `MetaballContact::check`. In walls of three layers and more that takes a penetration
  /// of about 1.75 spacings, in thinner ones the middle. A slave between two faces of one organ that both touch it
  /// looks like that too.
  std::size_t deep = 0;
  Index lost = 0;              ///< The deepest of them,
  std::size_t lost_in = 0;     ///< the organ whose wall has lost it,
  S lost_depth = 0;            ///< and its p in m, of an undeformed wall where that has no normal.
  S penetration = 0;           ///< The largest p in m.
  Index deepest = 0;           ///< Its slave.
  std::size_t candidates = 0;  ///< Slave-master pairs that were looked at.
  std::size_t rebuilds = 0;    ///< How often the grid search ran so far.
  /// How many checks of the lists so far found some strain or normal to have changed by more than they allow for,
  /// so that a touch could have been seen a few steps late. Zero or rare unless a run chatters.
  std::size_t late = 0;
};

/// One slave that touches a wall, and what the wall does to it.
template <int D>
struct Touch {
  std::size_t pair = 0;        ///< Number that `add_pair` gave.
  bool slave_is_first = true;  ///< Whether the slave belongs to the first organ of the pair, the wall to the second.
  Index slave = 0;
  double penetration = 0;      ///< p in m, \paper{38}.
  Vector<double, D> normal{};  ///< n_m, \paper{30}: from the wall to the slave.
  Vector<double, D> force{};   ///< In N, on the slave, \paper{39, 40}; the wall feels the opposite.
};

}  // namespace hmps::inline HMPS_ABI
