// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "output/carried_organs.hpp"
#include "output/snapshots.hpp"

/// The pictures of a case, from its snapshots, beside those of the paper. A `title` is written above each.
namespace swallowing {

/// The right half of the particles, seen from the midsagittal plane, as in the paper's Figs 13, 15 and 16.
void draw_sheet(const std::filesystem::path& path, const Snapshots& snapshots, const std::string& title);

/// The same moments, with the smooth surfaces of the organs in place of the particles.
void draw_surfaces(const std::filesystem::path& path, const Snapshots& snapshots, const CarriedOrgans& organs,
                   const std::string& title);

/// The leaf from behind and from the left, without the posterior and the left wall of the pharynx, as in the paper's
/// Fig. 14.
void draw_rear(const std::filesystem::path& path, const Snapshots& snapshots, const std::string& title);

/// Horizontal sections at three heights before, during and after the constriction of the pharynx, as in the paper's
/// Fig. 11.
void draw_sections(const std::filesystem::path& path, const Snapshots& snapshots, const std::string& title);

/// A case and the folder of its snapshots.
struct NamedSnapshots {
  std::string name;
  std::filesystem::path folder;
};
/// The outlines of the leaves of two cases over each other in the midsagittal plane at 1.700 s, as in the paper's
/// Fig. 17: the first red, the second yellow, among the other organs of the first. Draws nothing if one of them has no
/// snapshot of that time.
void draw_outlines(const std::filesystem::path& path, const std::array<NamedSnapshots, 2>& both);

}  // namespace swallowing
