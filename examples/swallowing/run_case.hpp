// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"
#include "output/carried_organs.hpp"
#include "output/summary.hpp"
#include "scene/cases.hpp"
#include "scene/fitted_organs.hpp"

namespace swallowing {

/// Runs one case according to the options and writes its results to its own folder below `options.out`. A failure
/// during the run is reported in `Summary::failure`; the results computed until then remain. `fitted`: the particles if
/// the options ask for fitted ones. `surfaces`: those of the organs, which all cases share; without them, no surfaces
/// are drawn. Throws `hmps::InputError` for a case that cannot be run at all.
Summary run_case(const Options& options, const Case& chosen, const FittedOrgans* fitted = nullptr,
                 SharedOrgans* surfaces = nullptr);

}  // namespace swallowing
