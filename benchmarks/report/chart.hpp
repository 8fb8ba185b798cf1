// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/canvas.hpp"

namespace report {

using examples::Anchor, examples::Canvas, examples::Colour;
using Points = std::vector<std::pair<double, double>>;

/// Where values lie along a side of a panel, in pixels.
class Axis {
 public:
  /// From `low` to `high` over the pixels `from` to `to`.
  [[nodiscard]] static Axis linear(double low, double high, double from, double to);
  /// The same by logarithms, with a tenth of a decade more at either end.
  [[nodiscard]] static Axis logarithmic(double low, double high, double from, double to);

  [[nodiscard]] double operator()(double value) const;
  /// Of a logarithmic axis: the powers of ten, where there are fewer than three also their two- and fivefold.
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
  double size = 11, left = 5, below = 15;  ///< of the labels at ticks, and how far from the rectangle they are
  Colour ink = Colour::hex(0x222222), grid = Colour::hex(0xe6e6e6);

  /// A tick at `place` along the lower side, with a line through the panel unless `bare`.
  void tick_across(double place, const std::string& label, bool bare = false);
  /// The same at the left side.
  void tick_up(double place, const std::string& label);
  void frame() { canvas.frame(x, y, width, height, Colour::hex(0x888888)); }
  /// A text below the middle, `down` from the lower side.
  void caption(const std::string& words, double down, double letters);
  /// A disc at each of the points.
  void dots(const Points& points, double radius, const Colour& colour);
  /// A curve through points, each with a disc; dashed if `dashes` says so.
  void curve(const Points& points, const Colour& colour, double thickness, double radius,
             const std::vector<double>& dashes = {});
};

/// A disc with a hole.
void ring(Canvas& canvas, double x, double y, double outer, double inner, const Colour& colour);

}  // namespace report
