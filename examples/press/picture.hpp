// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <hmps/shapes/surface_patch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "../common/canvas.hpp"

namespace press {

/// A surface with a number at each vertex, seen from the front and a little above: as it was at first on the left, as
/// it was drawn last on the right.
class Picture {
  using V = hmps::Vector<double, 3>;
  using Place = std::pair<double, double>;

 public:
  /// Of what lies in `box`; colours run from 0 to `most`.
  Picture(const hmps::Box<double, 3>& box, double most)
      : middle_((box.lower + box.upper) / 2), most_(most), canvas_(2 * width, height + 60) {
    const V size = box.upper - box.lower;
    const V seen(size[0], 0, std::sin(tilt) * size[1] + std::cos(tilt) * size[2]);
    scale_ = std::min((width - 20) / seen[0], (height - 50) / seen[2]);
  }

  /// Draws the surface, and the underside of the plate, which has come down by `depth`.
  void draw(const std::vector<V>& vertices, const std::vector<std::array<hmps::Index, 3>>& triangles,
            const std::vector<double>& values, const hmps::Box<double, 3>& plate, double depth) {
    if (!first_) canvas_.rectangle(width, 0, width, height, {1, 1, 1});
    std::vector<Face> faces = seen_faces(vertices, triangles, values);
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.depth > b.depth; });
    for (const Face& face : faces) polygon(face.corners, face.colour, face.colour, 0.7);
    const double z = plate.lower[2] - depth;
    const std::array<Place, 4> corners{
        place({plate.lower[0], plate.lower[1], z}), place({plate.upper[0], plate.lower[1], z}),
        place({plate.upper[0], plate.upper[1], z}), place({plate.lower[0], plate.upper[1], z})};
    const auto steel = examples::Colour::hex(0x708090);
    polygon(corners, steel.opacity(0.2), steel, 1.2);
    char title[64];
    std::snprintf(title, sizeof title, "plate down by %.2f mm", 1e3 * depth);
    canvas_.text(left() + width / 2., 26, title, 16, {0.2, 0.2, 0.2}, examples::Anchor::middle);
    first_ = false;
  }

  /// Writes the picture as PNG.
  void save(const std::string& path) {
    for (int k = 0; k < 200; ++k) canvas_.rectangle(width - 100 + k, height + 10, 1.5, 14, colour_of(most_ * k / 200));
    char text[64];
    std::snprintf(text, sizeof text, "von Mises stress: 0 to %.3g kPa", most_ / 1e3);
    canvas_.text(width, height + 44, text, 14, {0.2, 0.2, 0.2}, examples::Anchor::middle);
    canvas_.save(path);
  }

 private:
  static constexpr int width = 460, height = 360;
  static constexpr double tilt = 0.35;  // of the view, downward
  struct Face {
    double depth;
    std::array<Place, 3> corners;
    examples::Colour colour;
  };

  /// x to the right, y into the picture, z up.
  [[nodiscard]] static V turned(const V& r) {
    const double c = std::cos(tilt), s = std::sin(tilt);
    return {r[0], c * r[1] - s * r[2], s * r[1] + c * r[2]};
  }
  [[nodiscard]] double left() const { return first_ ? 0 : width; }
  [[nodiscard]] Place place(const V& r) const {
    const V seen = scale_ * turned(r - middle_);
    return {left() + width / 2. + seen[0], height / 2. + 20 - seen[2]};
  }
  [[nodiscard]] examples::Colour colour_of(double value) const {
    const double t = std::clamp(value / most_, 0.0, 1.0);
    const auto low = examples::Colour::hex(0x3a6ea5), half = examples::Colour::hex(0xf0e6c8),
               high = examples::Colour::hex(0xb5322a);
    return t < 0.5 ? low.mixed(half, 2 * t) : half.mixed(high, 2 * t - 1);
  }
  /// The triangles that are seen from the front, shaded.
  [[nodiscard]] std::vector<Face> seen_faces(const std::vector<V>& vertices,
                                             const std::vector<std::array<hmps::Index, 3>>& triangles,
                                             const std::vector<double>& values) const {
    const V light = V(-0.4, -0.6, 0.7).normalized();
    std::vector<Face> faces;
    for (const auto& t : triangles) {
      const V across = hmps::area_vector(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
      if (turned(across)[1] >= 0) continue;
      const double value = (values[t[0]] + values[t[1]] + values[t[2]]) / 3;
      const double shade = 0.45 * (1 - std::max(0.0, across.normalized().dot(light)));
      Face face{0, {}, colour_of(value).mixed({0, 0, 0}, shade)};
      for (std::size_t k = 0; k < 3; ++k) {
        face.corners[k] = place(vertices[t[k]]);
        face.depth += turned(vertices[t[k]])[1];
      }
      faces.push_back(face);
    }
    return faces;
  }
  template <std::size_t N>
  void polygon(const std::array<Place, N>& corners, const examples::Colour& fill, const examples::Colour& edge,
               double thickness) {
    cairo_t* c = canvas_.cairo();
    cairo_new_path(c);
    for (const auto& [x, y] : corners) cairo_line_to(c, x, y);
    cairo_close_path(c);
    cairo_set_source_rgba(c, fill.r, fill.g, fill.b, fill.a);
    cairo_fill_preserve(c);
    cairo_set_source_rgba(c, edge.r, edge.g, edge.b, edge.a);
    cairo_set_line_width(c, thickness);
    cairo_stroke(c);
  }

  V middle_;
  double scale_ = 1, most_;
  bool first_ = true;
  examples::Canvas canvas_;
};

}  // namespace press
