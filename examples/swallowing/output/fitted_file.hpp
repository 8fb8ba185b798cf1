// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "scene/fitted_organs.hpp"

namespace swallowing {

/// Writes the fitted particles to the output folder, which must exist, so that `--resume` need not fit them again.
void write_fitted(const std::filesystem::path& out, const FittedOrgans& fitted, double spacing);

/// The fitted particles in the output folder; nothing if there are none. Throws `InputError` if they have another
/// spacing (m), or if the file is damaged.
[[nodiscard]] std::optional<FittedOrgans> read_fitted(const std::filesystem::path& out, double spacing);

}  // namespace swallowing
