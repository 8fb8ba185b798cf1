// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/results.hpp"

/// The results as a page in Markdown and a picture.
namespace verification {

/// All of the page, pictures aside.
[[nodiscard]] std::string page_of(const std::vector<Solved>& all);
/// The table of all problems.
[[nodiscard]] std::string summary(const std::vector<Solved>& all);
/// Draws the error of the first quantity of each problem that converges over the number of particles across.
void draw(const std::vector<Solved>& all, const std::filesystem::path& path);

}  // namespace verification
