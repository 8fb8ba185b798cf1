// SPDX-License-Identifier: MIT
#include "output/panels.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

namespace swallowing {

namespace {

using examples::Anchor;
using examples::Canvas;
using examples::Colour;

constexpr Colour control_colour = Colour::hex(0x20232b);

}  // namespace

Colour colour_of(const std::string& organ) {
  static const std::pair<const char*, Colour> colours[] = {
      {"epiglottis", Colour::hex(0xf5c211)}, {"tongue", Colour::hex(0xd9584f)},    {"hard", Colour::hex(0xb9ae98)},
      {"palate", Colour::hex(0xe8915b)},     {"vallec", Colour::hex(0x3fa796)},    {"aryt", Colour::hex(0x2f6fb5)},
      {"laryn", Colour::hex(0x5596d6)},      {"trachea", Colour::hex(0x5596d6)},   {"phary", Colour::hex(0xe3a3b4)},
      {"wall", Colour::hex(0xe3a3b4)},       {"esophagus", Colour::hex(0x9b7fc9)}, {"vertebra", Colour::hex(0x8a8172)}};
  std::string name = organ;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [part, colour] : colours)
    if (name.find(part) != std::string::npos) return colour;
  return Colour::hex(0x8fae6a);
}

Window Window::holding(double width, double height, const std::array<double, 2>& lower,
                       const std::array<double, 2>& upper) {
  constexpr double margin = 0.004;
  const double scale =
      std::min(width / (upper[0] - lower[0] + 2 * margin), height / (upper[1] - lower[1] + 2 * margin));
  const double across = (lower[0] + upper[0]) / 2, up = (lower[1] + upper[1]) / 2;
  const double w = width / scale / 2, h = height / scale / 2;
  return {across - w, up - h, across + w, up + h, scale};
}

View from_midsagittal_plane() {
  return {.project =
              [](const std::array<float, 3>& p) {
                return std::array<double, 3>{p[0], p[2], p[1]};
              },
          .shows = [](const Snapshot& s, std::size_t i) { return s.positions[i][1] >= 0; }};
}

std::function<std::array<double, 3>(const std::array<float, 3>&)> seen_from(double left, double above,
                                                                            const std::array<double, 3>& middle,
                                                                            double in_front) {
  using Vector = Eigen::Vector3d;
  const double l = left * std::numbers::pi / 180, a = above * std::numbers::pi / 180;
  const Vector towards(std::cos(a) * std::cos(l), -std::cos(a) * std::sin(l), std::sin(a));
  const Vector across = Vector::UnitZ().cross(towards).normalized(), up = towards.cross(across);
  const Vector at = Eigen::Map<const Vector>(middle.data());
  return [=](const std::array<float, 3>& p) {
    const Vector d = Eigen::Map<const Eigen::Vector3f>(p.data()).cast<double>() - at;
    return std::array{d.dot(across), d.dot(up), std::max(0., in_front - d.dot(towards))};
  };
}

std::vector<Ball> shown_balls(const Snapshot& snapshot, const View& view) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < snapshot.positions.size(); ++i)
    if (view.shows(snapshot, i)) balls.push_back({view.project(snapshot.positions[i]), i});
  std::stable_sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.at[2] > b.at[2]; });
  return balls;
}

void draw_particles(Canvas& canvas, const Snapshot& snapshot, const View& view, const Window& window) {
  std::vector<Colour> colours;
  for (const std::string& organ : snapshot.organs) colours.push_back(colour_of(organ));

  const double radius = Ball::radius * snapshot.spacing * window.scale;
  constexpr double fading = 0.022;  // m, over which the colours fade by a factor of e
  for (const auto& [at, particle] : shown_balls(snapshot, view)) {
    const bool in_front = view.cuts && at[2] < snapshot.spacing;
    Colour fill = colours.at(snapshot.organ[particle]);
    if (snapshot.role[particle] == Role::control && view.darkens) fill = control_colour.mixed(fill, 0.12);
    if (snapshot.role[particle] == Role::plate) fill = plate_colour;
    const double fog = in_front ? 0 : (view.cuts ? 0.22 : 0) + 0.6 * (1 - std::exp(-at[2] / fading));
    const Colour rim = fill.mixed(ink, in_front ? 0.55 : 0.28).mixed(ground, fog);
    fill = fill.mixed(ground, fog);
    const double x = window.px(at[0]), y = window.py(at[1]);
    canvas.disc(x, y, radius, rim);
    canvas.disc(x - 0.06 * radius, y - 0.06 * radius, radius - std::max(0.35, 0.13 * radius), fill);
    canvas.disc(x - 0.3 * radius, y - 0.34 * radius, 0.3 * radius, fill.mixed({1, 1, 1}, 0.3));
  }
}

double draw_legend(Canvas& canvas, double x, double y, const Snapshot& snapshot, bool dark_organs) {
  // Only what is present, the organs in their own order.
  std::vector<bool> seen(snapshot.organs.size(), false);
  bool control = false, plate = false;
  for (std::size_t i = 0; i < snapshot.organ.size(); ++i) {
    if (snapshot.role[i] == Role::free || (dark_organs && snapshot.role[i] == Role::control))
      seen[snapshot.organ[i]] = true;
    control = control || snapshot.role[i] == Role::control;
    plate = plate || snapshot.role[i] == Role::plate;
  }
  const auto entry = [&](const Colour& colour, const std::string& words) {
    canvas.disc(x + 9, y - 6, 9, colour.mixed(ink, 0.5));
    canvas.disc(x + 9, y - 6, 7.6, colour);
    canvas.text(x + 30, y, words, 17, ink);
    y += 30;
  };
  for (std::size_t i = 0; i < snapshot.organs.size(); ++i)
    if (seen[i]) entry(colour_of(snapshot.organs[i]), snapshot.organs[i]);
  if (control) entry(control_colour, "control regions");
  if (plate) entry(plate_colour, "region H (constrictors)");
  return y;
}

void draw_scale(Canvas& canvas, const Window& window) {
  const double y = window.height() - 18;
  canvas.line(16, y, 16 + 0.02 * window.scale, y, ink, 3);
  canvas.text_with_halo(16 + 0.01 * window.scale, y - 8, "20 mm", 15, ink, ground, Anchor::middle);
}

std::array<double, 2> Grid::corner(std::size_t panel) const {
  const auto column = static_cast<double>(panel % static_cast<std::size_t>(columns));
  const auto row = static_cast<double>(panel / static_cast<std::size_t>(columns));
  return {gap + column * (width + gap), top + row * (height + strip + gap)};
}

void Grid::draw(const std::filesystem::path& path, const std::function<void(Canvas&)>& besides) const {
  const auto rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  Canvas canvas(static_cast<int>((columns + more) * (width + gap) + gap),
                static_cast<int>(top + rows * (height + strip + gap)));
  canvas.text(gap, 42, title, 26, ink, Anchor::left, true);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    const auto [x, y] = corner(i);
    canvas.text(x + 4, y + 28, std::string(1, static_cast<char>('a' + i)), 25, ink, Anchor::left, true);
    canvas.text(x + 38, y + 28, panel.words, 21, ink);
    canvas.text(x + width - 4, y + 28, panel.value, 21, mark, Anchor::right, true);
    cairo_save(canvas.cairo());
    cairo_translate(canvas.cairo(), x, y + strip);
    cairo_rectangle(canvas.cairo(), 0, 0, width, height);
    cairo_clip(canvas.cairo());
    canvas.rectangle(0, 0, width, height, ground);
    if (panel.draw)
      panel.draw(canvas);
    else
      canvas.text(width / 2, height / 2, "not reached", 20, faint, Anchor::middle);
    cairo_restore(canvas.cairo());
  }
  besides(canvas);
  canvas.save(path);
}

}  // namespace swallowing
