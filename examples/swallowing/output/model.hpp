// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "output/snapshots.hpp"

namespace swallowing {

/// The body at rest, as in the paper's Figs 7 to 10: all organs, and tongue, soft palate, larynx with epiglottis, and
/// pharynx alone, with the letters of their control regions. A `title` is written above. Returns the letters, each
/// once.
std::set<std::string> draw_model(const std::filesystem::path& path, const Snapshot& at_rest, const std::string& title);

}  // namespace swallowing
