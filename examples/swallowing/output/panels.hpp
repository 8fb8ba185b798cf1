// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "../../common/canvas.hpp"
#include "output/snapshots.hpp"

/// Pictures of particles, several in a grid.
namespace swallowing {

inline constexpr examples::Colour ink = examples::Colour::hex(0x1d2430);
inline constexpr examples::Colour faint = examples::Colour::hex(0x6b7480);
inline constexpr examples::Colour ground = examples::Colour::hex(0xf4f6f9);
inline constexpr examples::Colour mark = examples::Colour::hex(0xc01c28);
inline constexpr examples::Colour plate_colour = examples::Colour::hex(0x9aa1ab);

/// The colour of the organ of that name.
[[nodiscard]] examples::Colour colour_of(const std::string& organ);

/// The part of the plane of a picture that a panel shows, in m, and its scale in pixels per m.
struct Window {
  double left, bottom, right, top, scale;

  /// The window with these sides that is `width` pixels wide.
  [[nodiscard]] static Window of_width(double width, double left, double bottom, double right, double top) {
    return {left, bottom, right, top, width / (right - left)};
  }
  /// The window of `width` by `height` pixels that shows what lies between the corners, as large as fits beside a
  /// margin of 4 mm, in its middle.
  [[nodiscard]] static Window holding(double width, double height, const std::array<double, 2>& lower,
                                      const std::array<double, 2>& upper);
  [[nodiscard]] double px(double across) const { return (across - left) * scale; }
  [[nodiscard]] double py(double up) const { return (top - up) * scale; }
  [[nodiscard]] double height() const { return (top - bottom) * scale; }
};

/// How a picture looks at the particles.
struct View {
  /// Where a particle lies: across and up in the plane of the picture, and behind that plane, in m. Particles fade with
  /// the distance behind it.
  std::function<std::array<double, 3>(const std::array<float, 3>&)> project;
  std::function<bool(const Snapshot&, std::size_t)> shows;
  bool cuts = true;     ///< whether the plane cuts the body: then the particles at the plane stand out
  bool darkens = true;  ///< whether control regions are dark; otherwise they have the colour of their organ
};

/// The right half, y >= 0, seen from the midsagittal plane. The viewer stands on the left: x, posterior, runs to the
/// right.
[[nodiscard]] View from_midsagittal_plane();

/// The projection of a `View` towards `middle` (m) from behind, turned to the left and above by angles in degrees.
/// Particles do not fade until they are `in_front` metres in front of the middle.
[[nodiscard]] std::function<std::array<double, 3>(const std::array<float, 3>&)> seen_from(
    double left, double above, const std::array<double, 3>& middle, double in_front);

/// A particle in the plane of a picture, as `View::project` places it.
struct Ball {
  std::array<double, 3> at;
  std::size_t particle;
  /// In spacings: balls of neighbours overlap a little, so that nothing shows between them.
  static constexpr double radius = 0.56;
};

/// The particles that the view shows, those furthest behind the plane of the picture first.
[[nodiscard]] std::vector<Ball> shown_balls(const Snapshot& snapshot, const View& view);

/// Draws the particles as balls, those furthest behind the plane of the picture first.
void draw_particles(examples::Canvas& canvas, const Snapshot& snapshot, const View& view, const Window& window);

/// Lists, from `x`, `y` downward, the colours of the organs and roles that the snapshot holds. Of organs all of whose
/// particles are dark, the colours are listed only with `dark_organs`. Returns the y below.
double draw_legend(examples::Canvas& canvas, double x, double y, const Snapshot& snapshot, bool dark_organs = false);

/// A bar of 20 mm in the lower left corner of a panel.
void draw_scale(examples::Canvas& canvas, const Window& window);

struct Panel {
  std::string words, value = {};  ///< above it, left and right
  /// Draws it, clipped, with the origin in its upper left corner; empty if its time was not reached.
  std::function<void(examples::Canvas&)> draw = {};
};

/// A grid of panels of `width` by `height` pixels, lettered as in the paper, with room for `more` columns on the right.
struct Grid {
  std::string title;
  int columns = 1, more = 0;
  double width = 0, height = 0;
  std::vector<Panel> panels = {};

  static constexpr double gap = 18, top = 66, strip = 40;  ///< pixels: between panels, for the title, above a panel
  /// The upper left corner of a panel.
  [[nodiscard]] std::array<double, 2> corner(std::size_t panel) const;
  /// Draws all, then calls `besides(canvas)`, and writes the picture.
  void draw(const std::filesystem::path& path, const std::function<void(examples::Canvas&)>& besides) const;
};

}  // namespace swallowing
