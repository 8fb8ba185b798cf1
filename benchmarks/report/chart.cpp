// SPDX-License-Identifier: MIT
#include "report/chart.hpp"

#include <algorithm>
#include <cmath>

namespace report {

Axis Axis::linear(double low, double high, double from, double to) { return {low, high, from, to, false}; }
Axis Axis::logarithmic(double low, double high, double from, double to) {
  const double first = std::log10(low) - 0.1;
  return {first, std::max(std::log10(high) + 0.1, first + 0.5), from, to, true};
}
double Axis::operator()(double value) const {
  return from_ + (to_ - from_) * ((logarithmic_ ? std::log10(value) : value) - low_) / (high_ - low_);
}
std::vector<double> Axis::ticks() const {
  std::vector<double> found;
  for (const bool few : {false, true}) {
    found.clear();
    for (double decade = std::floor(low_); decade <= high_; ++decade)
      for (const double digit : {1., 2., 5.}) {
        const double value = digit * std::pow(10, decade), place = std::log10(value);
        if ((digit == 1 || few) && place >= low_ && place <= high_) found.push_back(value);
      }
    if (found.size() >= 3) break;
  }
  return found;
}

Panel Panel::with_large_labels(Canvas& canvas, double x, double y, double width, double height) {
  return {.canvas = canvas,
          .x = x,
          .y = y,
          .width = width,
          .height = height,
          .size = 12,
          .left = 8,
          .below = 20,
          .ink = Colour::hex(0x333333),
          .grid = Colour::hex(0xdddddd)};
}

void Panel::tick_across(double place, const std::string& label, bool bare) {
  if (!bare) canvas.line(place, y, place, y + height, grid, 1);
  canvas.text(place, y + height + below, label, size, ink, Anchor::middle);
}
void Panel::tick_up(double place, const std::string& label) {
  canvas.line(x, place, x + width, place, grid, 1);
  if (!label.empty()) canvas.text(x - left, place + 4, label, size, ink, Anchor::right);
}
void Panel::caption(const std::string& words, double down, double letters) {
  canvas.text(x + width / 2, y + height + down, words, letters, ink, Anchor::middle);
}
void Panel::dots(const Points& points, double radius, const Colour& colour) {
  for (const auto& [px, py] : points) canvas.disc(px, py, radius, colour);
}
void Panel::curve(const Points& points, const Colour& colour, double thickness, double radius,
                  const std::vector<double>& dashes) {
  canvas.line(points, colour, thickness, dashes);
  dots(points, radius, colour);
}

void ring(Canvas& canvas, double x, double y, double outer, double inner, const Colour& colour) {
  canvas.disc(x, y, outer, colour);
  canvas.disc(x, y, inner, {1, 1, 1});
}

}  // namespace report
