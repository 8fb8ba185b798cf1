// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"
#include "output/summary.hpp"
#include "scene/cases.hpp"
#include "scene/fitted_organs.hpp"

namespace swallowing {

/// Runs one case as the options ask and writes its results into a folder of its own below
/// `options.out`. What goes wrong while running ends up in `Summary::failure`; all that was computed
/// until then stays. `fitted`: the particles where the options ask for fitted ones. Throws `hmps::InputError` for what
/// cannot be run at all.
Summary run_case(const Options& options, const Case& chosen, const FittedOrgans* fitted = nullptr);

}  // namespace swallowing
