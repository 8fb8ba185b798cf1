// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "report/table.hpp"
#include "report/text.hpp"

namespace stability {

using report::digits, report::places, report::Table;

// The groups of runs. `quick` leaves out most of a group, and keeps the checks that must hold.

/// The estimate of `stable_step` over the limit found by bisection, for the picture.
struct Ratio {
  std::string scene;
  double step, limit;
};
[[nodiscard]] Table courant(bool quick, std::vector<Ratio>& ratios);  ///< largest step against its estimate
[[nodiscard]] Table refresh(bool quick);                              ///< cost and safety of refreshing the estimate
[[nodiscard]] Table inversion(bool quick);                            ///< det F below zero, and recovery
[[nodiscard]] Table deformation(bool quick);                          ///< squeeze, twist, bend
[[nodiscard]] Table impact(bool quick);                               ///< speed at which a body passes through a wall
[[nodiscard]] Table partners(bool quick);                             ///< ratios of mass and stiffness, friction
[[nodiscard]] Table endurance(bool quick);                            ///< a million steps
[[nodiscard]] Table rejected_input();                                 ///< rejected input, and the messages

}  // namespace stability
