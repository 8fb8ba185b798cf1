// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"
#include "output/summary.hpp"
#include "scene/cases.hpp"

namespace swallowing {

/// Runs one case as the options ask and writes its results into a folder of its own below
/// `options.out`. What goes wrong while running ends up in `Summary::failure`; all that was computed
/// until then stays. Throws `hmps::InputError` for what cannot be run at all.
Summary run_case(const Options& options, const Case& chosen);

}  // namespace swallowing
