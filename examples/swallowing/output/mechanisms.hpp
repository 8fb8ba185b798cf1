// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>

#include "output/comparison.hpp"

namespace swallowing {

/// Writes mechanisms.md to `path`: what turned the epiglottis in each case, according to its contacts.csv, by the
/// mechanisms alpha to delta of section 3.5 of the paper, and the areas and heights that section 4.2 discusses.
void write_mechanisms(const std::filesystem::path& path, const std::array<CaseResult, 4>& results);

}  // namespace swallowing
