// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "options.hpp"
#include "output/checkpoint.hpp"
#include "scene/cases.hpp"
#include "scene/fitted_organs.hpp"

namespace swallowing {

/// Everything on which the bits of a run depend, as text: options and case, the fitted particles (null: a lattice), the
/// friction coefficient, the first step (s) and the penalty (N/m4) that follow from them, and the contents of the files
/// in the folder `data`.
[[nodiscard]] RunSettings fingerprint(const Options& options, const Case& chosen, const FittedOrgans* fitted,
                                      const std::filesystem::path& data, double friction, double first_step,
                                      double penalty);

/// The settings that the cases of one run of the program share: results must agree in them to appear in one table.
[[nodiscard]] RunSettings shared_settings(const Options& options);

}  // namespace swallowing
