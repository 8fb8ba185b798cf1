// SPDX-License-Identifier: MIT
#include "output/pictures.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "../../common/canvas.hpp"
#include "output/checkpoint.hpp"

namespace swallowing {

namespace {

using examples::Anchor;
using examples::Canvas;
using examples::Colour;

constexpr Colour ink = Colour::hex(0x1d2430);
constexpr Colour faint = Colour::hex(0x6b7480);
constexpr Colour ground = Colour::hex(0xf4f6f9);
constexpr Colour control_colour = Colour::hex(0x20232b);
constexpr Colour mark = Colour::hex(0xc01c28);
constexpr Colour plate_colour = Colour::hex(0x9aa1ab);

[[nodiscard]] Colour colour_of(const std::string& organ) {
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

[[nodiscard]] std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), pattern, value);
  return text;
}

/// The part of the sagittal plane that a panel shows, in m, and its scale in pixels per m.
struct Window {
  double x0, z0, x1, z1, scale;
  [[nodiscard]] double px(double x) const { return (x - x0) * scale; }
  [[nodiscard]] double py(double z) const { return (z1 - z) * scale; }
};

/// Draws the particles of the right half, y >= 0, those closest to the midsagittal plane last. The viewer stands on the
/// left: x, posterior, runs to the right.
void draw_particles(Canvas& canvas, const Snapshot& s, const Window& window) {
  std::vector<std::size_t> order(s.positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return s.positions[i][1] < 0; });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return s.positions[a][1] > s.positions[b][1]; });
  std::vector<Colour> colours;
  for (const std::string& organ : s.organs) colours.push_back(colour_of(organ));

  const double radius = 0.56 * s.spacing * window.scale;
  constexpr double depth = 0.022;  // m, over which the colours fade by a factor of e
  for (const std::size_t i : order) {
    const double y = s.positions[i][1];
    const bool near = y < s.spacing;
    Colour fill = colours.at(s.organ[i]);
    if (s.role[i] == Role::control) fill = control_colour.mixed(fill, 0.12);
    if (s.role[i] == Role::plate) fill = plate_colour;
    const double fog = near ? 0 : 0.22 + 0.6 * (1 - std::exp(-y / depth));
    const Colour rim = fill.mixed(ink, near ? 0.55 : 0.28).mixed(ground, fog);
    fill = fill.mixed(ground, fog);
    const double x = window.px(s.positions[i][0]), z = window.py(s.positions[i][2]);
    canvas.disc(x, z, radius, rim);
    canvas.disc(x - 0.06 * radius, z - 0.06 * radius, radius - std::max(0.35, 0.13 * radius), fill);
    canvas.disc(x - 0.3 * radius, z - 0.34 * radius, 0.3 * radius, fill.mixed({1, 1, 1}, 0.3));
  }
}

/// The line from the centre to the tip of the epiglottis, and the horizontal through the centre.
void draw_angle(Canvas& canvas, const Snapshot& s, const Window& window) {
  const double cx = window.px(s.centre[0]), cz = window.py(s.centre[2]);
  const double tx = window.px(s.tip[0]), tz = window.py(s.tip[2]);
  const double reach = std::max(0.022 * window.scale, std::abs(tx - cx) * 1.15);
  canvas.line(cx, cz, cx + reach, cz, Colour{1, 1, 1, 0.85}, 3.5);
  canvas.line(cx, cz, cx + reach, cz, ink, 1.4, {5, 4});
  canvas.line(cx, cz, tx, tz, Colour{1, 1, 1, 0.9}, 5);
  canvas.line(cx, cz, tx, tz, mark, 2.4);
  canvas.disc(cx, cz, 4.6, {1, 1, 1});
  canvas.disc(cx, cz, 3.2, mark);
}

void draw_legend(Canvas& canvas, double x, double y, const Snapshot& s) {
  // Only what is present, the organs in their own order.
  std::vector<bool> seen(s.organs.size(), false);
  bool control = false, plate = false;
  for (std::size_t i = 0; i < s.organ.size(); ++i) {
    if (s.role[i] == Role::free) seen[s.organ[i]] = true;
    control = control || s.role[i] == Role::control;
    plate = plate || s.role[i] == Role::plate;
  }
  const auto entry = [&](const Colour& colour, const std::string& words) {
    canvas.disc(x + 9, y - 6, 9, colour.mixed(ink, 0.5));
    canvas.disc(x + 9, y - 6, 7.6, colour);
    canvas.text(x + 30, y, words, 17, ink);
    y += 30;
  };
  for (std::size_t i = 0; i < s.organs.size(); ++i)
    if (seen[i]) entry(colour_of(s.organs[i]), s.organs[i]);
  if (control) entry(control_colour, "control regions");
  if (plate) entry(plate_colour, "region H (constrictors)");
  y += 2;
  canvas.line(x, y - 6, x + 20, y - 6, mark, 2.4);
  canvas.disc(x, y - 6, 3.2, mark);
  canvas.text(x + 30, y, "centre to tip of epiglottis", 17, ink);
  y += 27;
  canvas.line(x, y - 6, x + 20, y - 6, ink, 1.4, {5, 4});
  canvas.text(x + 30, y, "horizontal through the centre", 17, ink);
  y += 40;
  canvas.text(x, y, "Right half, seen from the midsagittal plane;", 15, faint);
  canvas.text(x, y + 20, "the farther from it, the paler. Angle: centre to", 15, faint);
  canvas.text(x, y + 40, "tip above the horizontal.", 15, faint);
}

}  // namespace

Snapshots::Snapshots(const std::filesystem::path& folder, std::optional<double> resume_time) : folder_(folder) {
  std::filesystem::create_directories(folder_);
  for (std::size_t panel = 0; panel < picture_times.size(); ++panel)
    if (!resume_time || picture_times[panel] > *resume_time + 5e-10) std::filesystem::remove(file(panel));
}

std::filesystem::path Snapshots::file(std::size_t panel) const {
  return folder_ / ("snapshot_" + format("%.3f", picture_times.at(panel)) + "s.bin");
}

void Snapshots::add(std::size_t panel, const Snapshot& snapshot) const {
  Checkpoint box;  // used as a container: either complete or absent, with a checksum
  box.time = snapshot.time;
  for (const std::string& organ : snapshot.organs) box.settings.emplace_back("organ", organ);
  box.set("spacing", snapshot.spacing);
  box.set("positions", snapshot.positions);
  box.set("organ", snapshot.organ);
  box.set("role", snapshot.role);
  box.set("centre", snapshot.centre);
  box.set("tip", snapshot.tip);
  box.set("tip_angle", snapshot.tip_angle);
  box.save(file(panel));
}

std::optional<Snapshot> Snapshots::load(std::size_t panel) const {
  const auto box = Checkpoint::load(file(panel));
  if (!box) return std::nullopt;
  Snapshot s;
  s.time = box->time;
  for (const auto& [key, organ] : box->settings) s.organs.push_back(organ);
  s.spacing = box->value<double>("spacing");
  s.positions = box->get<std::array<float, 3>>("positions");
  s.organ = box->get<std::uint8_t>("organ");
  s.role = box->get<Role>("role");
  box->get("centre", s.centre);
  box->get("tip", s.tip);
  s.tip_angle = box->value<double>("tip_angle");
  return s;
}

void draw_sheet(const std::filesystem::path& path, const Snapshots& snapshots, const std::string& title) {
  constexpr int columns = 5, rows = 2, gap = 18, top = 66, strip = 40;
  constexpr double panel_width = 400;

  Window window{1e9, 1e9, -1e9, -1e9, 1};
  std::vector<std::optional<Snapshot>> panels;
  for (std::size_t panel = 0; panel < picture_times.size(); ++panel) {
    panels.push_back(snapshots.load(panel));
    if (!panels.back()) continue;
    for (const auto& p : panels.back()->positions) {
      window.x0 = std::min(window.x0, double{p[0]});
      window.x1 = std::max(window.x1, double{p[0]});
      window.z0 = std::min(window.z0, double{p[2]});
      window.z1 = std::max(window.z1, double{p[2]});
    }
  }
  if (window.x0 > window.x1) window = {-0.1, -0.1, 0.1, 0.1, 1};  // nothing was reached
  constexpr double margin = 0.004;
  window.x0 -= margin;
  window.x1 += margin;
  window.z0 -= margin;
  window.z1 += margin;
  window.scale = panel_width / (window.x1 - window.x0);
  const double panel_height = std::clamp((window.z1 - window.z0) * window.scale, 200., 1600.);

  Canvas canvas(static_cast<int>(columns * (panel_width + gap) + gap),
                static_cast<int>(top + rows * (panel_height + strip + gap)));
  canvas.text(gap, 42, title, 26, ink, Anchor::left, true);
  const Snapshot* any = nullptr;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double x = gap + static_cast<double>(i % columns) * (panel_width + gap);
    const double y = top + static_cast<double>(i / columns) * (panel_height + strip + gap);
    const std::string letter(1, static_cast<char>('a' + i));
    canvas.text(x + 4, y + 28, letter, 25, ink, Anchor::left, true);
    canvas.text(x + 30, y + 28, format("%.3f s", picture_times[i]), 21, ink);
    if (panels[i])
      canvas.text(x + panel_width - 4, y + 28, format("%+.1f°", panels[i]->tip_angle), 21, mark, Anchor::right, true);
    cairo_save(canvas.cairo());
    cairo_translate(canvas.cairo(), x, y + strip);
    cairo_rectangle(canvas.cairo(), 0, 0, panel_width, panel_height);
    cairo_clip(canvas.cairo());
    canvas.rectangle(0, 0, panel_width, panel_height, ground);
    if (panels[i]) {
      any = &*panels[i];
      draw_particles(canvas, *any, window);
      draw_angle(canvas, *any, window);
    } else {
      canvas.text(panel_width / 2, panel_height / 2, "not reached", 20, faint, Anchor::middle);
    }
    if (i == 0) {
      canvas.line(16, panel_height - 18, 16 + 0.02 * window.scale, panel_height - 18, ink, 3);
      canvas.text_with_halo(16 + 0.01 * window.scale, panel_height - 26, "20 mm", 15, ink, ground, Anchor::middle);
      canvas.text_with_halo(16, panel_height - 54, "← anterior", 15, faint, ground);
    }
    cairo_restore(canvas.cairo());
  }
  if (any) draw_legend(canvas, gap + 4 * (panel_width + gap) + 30, top + panel_height + strip + gap + 76, *any);
  canvas.save(path);
}

}  // namespace swallowing
