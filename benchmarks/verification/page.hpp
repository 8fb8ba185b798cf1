// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/results.hpp"

/// The results as a page in Markdown and a picture.
namespace verification {

/// The text of the page, without the pictures.
[[nodiscard]] std::string page_of(const std::vector<Solved>& all);
/// The table of all problems.
[[nodiscard]] std::string summary(const std::vector<Solved>& all);
/// Draws, for each problem that converges, the error of the first quantity over the number of particles across.
void draw(const std::vector<Solved>& all, const std::filesystem::path& path);

}  // namespace verification
