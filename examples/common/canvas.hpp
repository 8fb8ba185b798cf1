// SPDX-License-Identifier: MIT
#pragma once

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <hmps/output/file_replacement.hpp>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "error.hpp"
#include "files.hpp"

namespace examples {

/// Red, green and blue within 0 to 1, and opacity.
struct Colour {
  double r = 0, g = 0, b = 0, a = 1;

  /// From 0xrrggbb.
  [[nodiscard]] static constexpr Colour hex(unsigned value) {
    return {((value >> 16) & 255) / 255., ((value >> 8) & 255) / 255., (value & 255) / 255.};
  }
  /// This colour with the share `t` of `other` in it.
  [[nodiscard]] constexpr Colour mixed(const Colour& other, double t) const {
    return {r + (other.r - r) * t, g + (other.g - g) * t, b + (other.b - b) * t, a + (other.a - a) * t};
  }
  [[nodiscard]] constexpr Colour opacity(double value) const { return {r, g, b, value}; }
};

/// The place of the point given to `Canvas::text` in the text: the left end, middle or right end of its base line.
enum class Anchor { left, middle, right };

/// An image in pixels, y downward, white at first. A thin wrapper of cairo.
class Canvas {
 public:
  Canvas(int width, int height) : width_(width), height_(height) {
    surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    require(cairo_surface_status(surface_) == CAIRO_STATUS_SUCCESS, "no memory for a picture of ", width, " by ",
            height, " pixels");
    context_ = cairo_create(surface_);
    rectangle(0, 0, width, height, {1, 1, 1});
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
  }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas() {
    cairo_destroy(context_);
    cairo_surface_destroy(surface_);
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// The cairo context, for operations that `Canvas` does not provide.
  [[nodiscard]] cairo_t* cairo() const { return context_; }

  void rectangle(double x, double y, double w, double h, const Colour& fill) {
    set(fill);
    cairo_rectangle(context_, x, y, w, h);
    cairo_fill(context_);
  }
  void frame(double x, double y, double w, double h, const Colour& colour, double thickness = 1) {
    set(colour);
    cairo_set_line_width(context_, thickness);
    cairo_rectangle(context_, x, y, w, h);
    cairo_stroke(context_);
  }
  void disc(double x, double y, double radius, const Colour& fill) {
    set(fill);
    cairo_arc(context_, x, y, radius, 0, 2 * std::numbers::pi);
    cairo_fill(context_);
  }
  /// A line through `points`; with `dashes`, their lengths and those of the gaps in turn.
  void line(std::span<const std::pair<double, double>> points, const Colour& colour, double thickness,
            std::vector<double> dashes = {}) {
    if (points.empty()) return;
    set(colour);
    cairo_set_line_width(context_, thickness);
    cairo_set_dash(context_, dashes.data(), static_cast<int>(dashes.size()), 0);
    cairo_move_to(context_, points[0].first, points[0].second);
    for (const auto& [x, y] : points.subspan(1)) cairo_line_to(context_, x, y);
    cairo_stroke(context_);
    cairo_set_dash(context_, nullptr, 0, 0);
  }
  void line(double x0, double y0, double x1, double y1, const Colour& colour, double thickness,
            std::vector<double> dashes = {}) {
    const std::pair<double, double> points[] = {{x0, y0}, {x1, y1}};
    line(points, colour, thickness, std::move(dashes));
  }
  void text(double x, double y, const std::string& words, double size, const Colour& colour,
            Anchor anchor = Anchor::left, bool bold = false) {
    set(colour);
    select(size, bold);
    const double shift = anchor == Anchor::left ? 0 : anchor == Anchor::middle ? 0.5 : 1;
    cairo_move_to(context_, x - shift * advance(words), y);
    cairo_show_text(context_, words.c_str());
  }
  /// The same, but legible on any background: with a border of `halo` around the letters.
  void text_with_halo(double x, double y, const std::string& words, double size, const Colour& colour,
                      const Colour& halo, Anchor anchor = Anchor::left, bool bold = false) {
    set(halo);
    select(size, bold);
    const double shift = anchor == Anchor::left ? 0 : anchor == Anchor::middle ? 0.5 : 1;
    cairo_move_to(context_, x - shift * advance(words), y);
    cairo_text_path(context_, words.c_str());
    cairo_set_line_width(context_, size / 4);
    cairo_stroke(context_);
    text(x, y, words, size, colour, anchor, bold);
  }
  /// A text that runs upward, its middle at the given point.
  void text_upward(double x, double y, const std::string& words, double size, const Colour& colour) {
    cairo_save(context_);
    cairo_translate(context_, x, y);
    cairo_rotate(context_, -std::numbers::pi / 2);
    text(0, 0, words, size, colour, Anchor::middle);
    cairo_restore(context_);
  }
  [[nodiscard]] double text_width(const std::string& words, double size, bool bold = false) {
    select(size, bold);
    return advance(words);
  }

  /// Writes the picture as PNG, atomically.
  void save(const fs::path& path) const {
    std::string bytes;
    const auto append = [](void* target, const unsigned char* data, unsigned size) {
      static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(data), size);
      return CAIRO_STATUS_SUCCESS;
    };
    const bool made = cairo_surface_write_to_png_stream(surface_, append, &bytes) == CAIRO_STATUS_SUCCESS;
    require(made, "cannot make the picture ", path.string());
    hmps::replace_file(path, bytes);
  }

 private:
  void set(const Colour& c) { cairo_set_source_rgba(context_, c.r, c.g, c.b, c.a); }
  void select(double size, bool bold) {
    cairo_select_font_face(context_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_, size);
  }
  [[nodiscard]] double advance(const std::string& words) {
    cairo_text_extents_t extents;
    cairo_text_extents(context_, words.c_str(), &extents);
    return extents.x_advance;
  }

  int width_, height_;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* context_ = nullptr;
};

}  // namespace examples
