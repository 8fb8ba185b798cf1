// SPDX-License-Identifier: MIT
#pragma once

#include "../../common/canvas.hpp"
#include "output/carried_organs.hpp"
#include "output/panels.hpp"
#include "output/snapshots.hpp"

namespace swallowing {

/// Draws the surfaces of the organs as the particles of `snapshot` carry them, and those plates of region H that the
/// view shows as balls. What is cut at the midsagittal plane has the plain colours of the organs and a dark outline;
/// the rest is shaded, and fades with the distance behind the plane of the picture. Fills the clip of the canvas, whose
/// origin is the upper left corner of the window.
void draw_shaded(examples::Canvas& canvas, const CarriedOrgans& organs, const Snapshot& snapshot, const View& view,
                 const Window& window);

}  // namespace swallowing
