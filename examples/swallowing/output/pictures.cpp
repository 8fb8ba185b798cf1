// SPDX-License-Identifier: MIT
#include "output/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "../../common/error.hpp"
#include "output/lumen.hpp"
#include "output/panels.hpp"
#include "output/shaded.hpp"

namespace swallowing {

namespace {

using examples::Anchor;
using examples::Canvas;
using examples::Colour;

/// Particles of one picture at some of the `snapshot_times`.
using Moments = std::vector<std::optional<Snapshot>>;

template <std::size_t N>
[[nodiscard]] Moments moments(const Snapshots& snapshots, const std::array<double, N>& times) {
  Moments all;
  for (const double time : times) all.push_back(snapshots.load(time));
  return all;
}

[[nodiscard]] std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), pattern, value);
  return text;
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

void draw_sheet_legend(Canvas& canvas, double x, double y, const Snapshot& s) {
  y = draw_legend(canvas, x, y, s) + 2;
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

/// The window, `width` pixels wide, that holds the particles at all `moments`, as far as `view` shows them.
[[nodiscard]] Window around(const Moments& moments, const View& view, double width) {
  constexpr double infinite = std::numeric_limits<double>::infinity(), margin = 0.004;
  double left = infinite, bottom = infinite, right = -infinite, top = -infinite;
  for (const auto& moment : moments)
    for (std::size_t i = 0; moment && i < moment->positions.size(); ++i) {
      const auto [across, up, behind] = view.project(moment->positions[i]);
      left = std::min(left, across), right = std::max(right, across);
      bottom = std::min(bottom, up), top = std::max(top, up);
    }
  if (left > right) left = bottom = -0.1, right = top = 0.1;  // nothing was reached
  return Window::of_width(width, left - margin, bottom - margin, right + margin, top + margin);
}

[[nodiscard]] const Snapshot* any_of(const Moments& moments) {
  const auto found = std::find_if(moments.begin(), moments.end(), [](const auto& s) { return s.has_value(); });
  return found == moments.end() ? nullptr : &**found;
}

}  // namespace

namespace {

/// Draws a moment into a panel.
using DrawMoment = std::function<void(Canvas&, const Snapshot&, const View&, const Window&)>;

/// The moments of Figs 13, 15 and 16, seen from the midsagittal plane; then `besides(canvas, x, y, any)`, where `any`
/// is one of the moments and `x`, `y` the place to the right of the last.
void draw_from_midsagittal_plane(const std::filesystem::path& path, const Snapshots& snapshots,
                                 const std::string& title, const DrawMoment& draw,
                                 const std::function<void(Canvas&, double, double, const Snapshot&)>& besides) {
  constexpr std::array times{0., 0.5, 1.383, 1.583, 1.667, 1.677, 1.683, 1.7, 2.05};
  const Moments all = moments(snapshots, times);
  const View view = from_midsagittal_plane();
  Grid grid{.title = title, .columns = 5, .width = 400};
  const Window window = around(all, view, grid.width);
  grid.height = std::clamp(window.height(), 200., 1600.);
  for (std::size_t i = 0; i < times.size(); ++i) {
    Panel panel{.words = format("%.3f s", times[i])};
    if (all[i]) {
      panel.value = format("%+.1f°", all[i]->tip_angle);
      panel.draw = [&, i](Canvas& canvas) {
        draw(canvas, *all[i], view, window);
        if (i > 0) return;
        draw_scale(canvas, window);
        canvas.text_with_halo(16, grid.height - 54, "← anterior", 15, faint, ground);
      };
    }
    grid.panels.push_back(std::move(panel));
  }
  grid.draw(path, [&](Canvas& canvas) {
    const auto [x, y] = grid.corner(times.size());
    if (const Snapshot* s = any_of(all)) besides(canvas, x + 30, y + 76, *s);
  });
}

}  // namespace

void draw_sheet(const std::filesystem::path& path, const Snapshots& snapshots, const std::string& title) {
  const auto draw = [](Canvas& canvas, const Snapshot& s, const View& view, const Window& window) {
    draw_particles(canvas, s, view, window);
    draw_angle(canvas, s, window);
  };
  draw_from_midsagittal_plane(path, snapshots, title, draw, draw_sheet_legend);
}

void draw_surfaces(const std::filesystem::path& path, const Snapshots& snapshots, const CarriedOrgans& organs,
                   const std::string& title) {
  const auto draw = [&](Canvas& canvas, const Snapshot& s, const View& view, const Window& window) {
    draw_shaded(canvas, organs, s, view, window);
  };
  const auto besides = [](Canvas& canvas, double x, double y, Snapshot s) {
    // The surfaces do not tell control regions apart, and hide the plates.
    std::erase(s.role, Role::plate);
    s.organ.resize(s.role.size());
    std::replace(s.role.begin(), s.role.end(), Role::control, Role::free);
    y = draw_legend(canvas, x, y, s) + 12;
    canvas.text(x, y, "Right half: the drawn surfaces of the organs,", 15, faint);
    canvas.text(x, y + 20, "cut at the midsagittal plane, as the particles", 15, faint);
    canvas.text(x, y + 40, "carry them. Angle: centre to tip of the", 15, faint);
    canvas.text(x, y + 60, "epiglottis above the horizontal.", 15, faint);
  };
  draw_from_midsagittal_plane(path, snapshots, title, draw, besides);
}

void draw_rear(const std::filesystem::path& path, const Snapshots& snapshots, const std::string& title) {
  constexpr std::array times{1.383, 1.583, 1.633, 1.677};
  constexpr std::array middle{-5e-3, 0., 45e-3};             // m, about where the leaf turns
  constexpr double removed_behind = 2e-3, in_front = 12e-3;  // m
  const View view{.project = seen_from(30, 25, middle, in_front),
                  .shows =
                      [](const Snapshot& s, std::size_t i) {
                        const std::string& organ = s.organ_of(i);
                        if (s.role[i] == Role::plate || organ == name(Organ::vertebrae)) return false;
                        return organ != name(Organ::pharynx) ||
                               (s.positions[i][1] > 0 && s.positions[i][0] < removed_behind);
                      },
                  .cuts = false};
  const Moments all = moments(snapshots, times);
  Grid grid{.title = title, .columns = 4, .width = 460};
  const Window window = Window::of_width(grid.width, -26e-3, -38e-3, 26e-3, 26e-3);
  grid.height = window.height();
  for (std::size_t i = 0; i < times.size(); ++i) {
    Panel panel{.words = format("%.3f s", times[i])};
    if (all[i])
      panel.draw = [&, i](Canvas& canvas) {
        draw_particles(canvas, *all[i], view, window);
        if (i == 0) draw_scale(canvas, window);
      };
    grid.panels.push_back(std::move(panel));
  }
  grid.draw(path, [](Canvas&) {});
}

void draw_sections(const std::filesystem::path& path, const Snapshots& snapshots, const std::string& title) {
  constexpr std::array times{0., 1.583, 1.667, 1.7, 1.85};
  const Moments all = moments(snapshots, times);
  Grid grid{.title = title, .columns = static_cast<int>(times.size()), .more = 1, .width = 360};
  const Window window = Window::of_width(grid.width, -26e-3, -22e-3, 26e-3, 26e-3);
  grid.height = window.height();
  for (const double height : observed_heights)
    for (std::size_t i = 0; i < times.size(); ++i) {
      Panel panel{.words = format("z = %.0f mm, ", 1e3 * height) + format("%.3f s", times[i])};
      if (all[i])
        panel.draw = [&, i, height](Canvas& canvas) {
          // From above: anterior is up, and the right half on the right.
          const View view{
              .project =
                  [](const std::array<float, 3>& p) {
                    return std::array<double, 3>{p[1], -p[0], 0};
                  },
              .shows = [height](const Snapshot& s,
                                std::size_t k) { return std::abs(s.positions[k][2] - height) < s.spacing / 2; }};
          draw_particles(canvas, *all[i], view, window);
          if (i == 0) draw_scale(canvas, window);
        };
      grid.panels.push_back(std::move(panel));
    }
  grid.draw(path, [&](Canvas& canvas) {
    const auto [x, y] = grid.corner(times.size() - 1);
    if (const Snapshot* s = any_of(all)) draw_legend(canvas, x + grid.width + Grid::gap + 12, y + 66, *s);
  });
}

namespace {

[[nodiscard]] bool in_midsagittal_plane(const Snapshot& s, std::size_t i) {
  return std::abs(s.positions[i][1]) < 0.75 * s.spacing;
}

/// The outline of the leaf in the midsagittal plane: that of broad lines between its neighbouring particles.
void draw_outline(Canvas& canvas, const Snapshot& s, const Window& window, const Colour& colour) {
  std::vector<std::array<float, 3>> leaf;
  for (std::size_t i = 0; i < s.positions.size(); ++i)
    if (in_midsagittal_plane(s, i) && s.organ_of(i) == name(Organ::epiglottis)) leaf.push_back(s.positions[i]);
  cairo_t* cairo = canvas.cairo();
  cairo_push_group(cairo);
  constexpr double thickness = 4, reach = 1.75;  // pixels, spacings
  for (const bool inside : {false, true}) {
    if (inside) cairo_set_operator(cairo, CAIRO_OPERATOR_CLEAR);
    const double breadth = s.spacing * window.scale - (inside ? 2 * thickness : 0);
    for (const auto& p : leaf)
      for (const auto& q : leaf)
        if (std::hypot(p[0] - q[0], p[2] - q[2]) < reach * s.spacing)
          canvas.line(window.px(p[0]), window.py(p[2]), window.px(q[0]), window.py(q[2]), colour, breadth);
  }
  cairo_pop_group_to_source(cairo);
  cairo_paint(cairo);
}

}  // namespace

void draw_outlines(const std::filesystem::path& path, const std::array<NamedSnapshots, 2>& both) {
  constexpr double time = 1.7;
  constexpr std::array colours{mark, Colour::hex(0xe6b800)};
  const std::array leaves{load_snapshot(both[0].folder, time), load_snapshot(both[1].folder, time)};
  if (!leaves[0] || !leaves[1]) return;
  View view = from_midsagittal_plane();
  view.shows = [](const Snapshot& s, std::size_t i) {
    return in_midsagittal_plane(s, i) && s.organ_of(i) != name(Organ::epiglottis);
  };
  Grid grid{.title = "The leaf in " + both[0].name + " and " + both[1].name, .width = 620};
  const Window window = Window::of_width(grid.width, -40e-3, 0, 22e-3, 82e-3);
  grid.height = window.height();
  grid.panels.push_back({.words = format("%.3f s", time), .draw = [&](Canvas& canvas) {
                           draw_particles(canvas, *leaves[0], view, window);
                           for (std::size_t k = 0; k < 2; ++k) {
                             draw_outline(canvas, *leaves[k], window, colours[k]);
                             const double y = 30 + 26 * static_cast<double>(k);
                             canvas.line(16, y - 6, 46, y - 6, colours[k], 5);
                             canvas.text_with_halo(56, y, both[k].name, 19, ink, ground);
                           }
                           draw_scale(canvas, window);
                         }});
  grid.draw(path, [](Canvas&) {});
}

}  // namespace swallowing
