// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/canvas.hpp"

namespace report {

using examples::Anchor, examples::Canvas, examples::Colour;
using Points = std::vector<std::pair<double, double>>;

/// Maps values to pixels along a side of a panel.
class Axis {
 public:
  /// Maps `low` to the pixel `from` and `high` to the pixel `to`.
  [[nodiscard]] static Axis linear(double low, double high, double from, double to);
  /// The same on a logarithmic scale, extended by a tenth of a decade at either end.
  [[nodiscard]] static Axis logarithmic(double low, double high, double from, double to);

  [[nodiscard]] double operator()(double value) const;
  /// For a logarithmic axis: the powers of ten and, if there are fewer than three, also twice and five times these.
  [[nodiscard]] std::vector<double> ticks() const;

 private:
  Axis(double low, double high, double from, double to, bool logarithmic)
      : low_(low), high_(high), from_(from), to_(to), logarithmic_(logarithmic) {}

  double low_, high_, from_, to_;
  bool logarithmic_;
};

/// A rectangle of a canvas that holds curves, and the labels beside it. Lengths are in pixels.
struct Panel {
  Canvas& canvas;
  double x, y, width, height;
  double size = 11, left = 5, below = 15;  ///< of the labels at ticks, and their distances from the rectangle
  Colour ink = Colour::hex(0x222222), grid = Colour::hex(0xe6e6e6);

  /// A panel for a picture of its own.
  [[nodiscard]] static Panel with_large_labels(Canvas& canvas, double x, double y, double width, double height);

  /// A tick at `place` along the lower side, with a line through the panel unless `bare`.
  void tick_across(double place, const std::string& label, bool bare = false);
  /// The same along the left side.
  void tick_up(double place, const std::string& label);
  void frame() { canvas.frame(x, y, width, height, Colour::hex(0x888888)); }
  /// A text below the middle of the lower side, at the distance `down` from it.
  void caption(const std::string& words, double down, double letters);
  /// A disc at each of the points.
  void dots(const Points& points, double radius, const Colour& colour);
  /// A curve through points, each with a disc; dashed according to `dashes`.
  void curve(const Points& points, const Colour& colour, double thickness, double radius,
             const std::vector<double>& dashes = {});
};

/// A disc with a hole.
void ring(Canvas& canvas, double x, double y, double outer, double inner, const Colour& colour);

}  // namespace report
