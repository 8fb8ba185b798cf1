// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "options.hpp"
#include "output/checkpoint.hpp"
#include "scene/cases.hpp"

namespace swallowing {

/// All that the bits of a run depend on, as text: options and case, the friction coefficient, the first step (s) and
/// the penalty (N/m4) that follow from them, and what is in the files of the folder `data`.
[[nodiscard]] RunSettings fingerprint(const Options& options, const Case& chosen, const std::filesystem::path& data,
                                      double friction, double first_step, double penalty);

/// The settings that the cases of one run of the program share: what their results have to agree in to stand in one
/// table.
[[nodiscard]] RunSettings shared_settings(const Options& options);

}  // namespace swallowing
