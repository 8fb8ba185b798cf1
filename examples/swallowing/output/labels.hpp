// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "../../common/canvas.hpp"
#include "output/panels.hpp"
#include "output/snapshots.hpp"

/// The letters of control regions in pictures.
namespace swallowing {

/// The letter of a control region, without the side: that of "D left" is "D".
[[nodiscard]] std::string letter_of(const std::string& region);

/// A control region in a panel, and where it is seen, in pixels.
struct Label {
  std::string letter;
  double x, y;
};

/// The control regions that a panel shows, each at the middle of what is not hidden behind other particles. A region of
/// which two or more parts are seen has a label at each part that is at least a quarter as large as the largest. Parts
/// smaller than two particles have none.
[[nodiscard]] std::vector<Label> visible_regions(const Snapshot& snapshot, const View& view, const Window& window);

/// Writes the letters of the visible regions over the particles.
void draw_labels(examples::Canvas& canvas, const Snapshot& snapshot, const View& view, const Window& window);

}  // namespace swallowing
