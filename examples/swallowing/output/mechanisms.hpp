// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>

#include "output/comparison.hpp"

namespace swallowing {

/// Writes mechanisms.md at `path`: what turned the epiglottis of each case, by its contacts.csv, after the mechanisms
/// alpha to delta of section 3.5 of the paper, and what section 4.2 says of areas and heights.
void write_mechanisms(const std::filesystem::path& path, const std::array<CaseResult, 4>& results);

}  // namespace swallowing
