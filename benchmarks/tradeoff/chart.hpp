// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "report/chart.hpp"
#include "tradeoff/rules.hpp"

namespace tradeoff {

namespace detail {

/// Draws the error of quantity `q` against one of the costs.
inline void draw_front(const Scene& scene, const Sweep& sweep, std::size_t q, std::size_t cost_number,
                       report::Panel panel) {
  using report::Colour;
  constexpr auto line = Colour::hex(0xc0392b);
  const char* units[] = {"particle-steps", "time over the standard's", "memory (MB)"};
  const bool first = cost_number == 0, timed = cost_number == 1;
  const auto error = [q](const Trial& run) { return std::max(std::abs(run.errors[q]), 1e-4); };
  const auto cost = [&](const Trial& run) { return costs[cost_number].of(run) * (cost_number == 2 ? 1e-6 : 1); };
  std::vector<const Trial*> drawn;
  double least = 1e300, most = 0, best = 1e300, worst = 0;
  for (const Trial& run : sweep.runs) {
    if (run.failed() || !scene.same_problem(run.settings)) continue;
    drawn.push_back(&run);
    least = std::min(least, cost(run)), most = std::max(most, cost(run));
    best = std::min(best, error(run)), worst = std::max(worst, error(run));
  }
  const auto across = report::Axis::logarithmic(least, most, panel.x, panel.x + panel.width);
  const auto up = report::Axis::logarithmic(best, worst, panel.y + panel.height, panel.y);
  for (const double t : across.ticks()) panel.tick_across(across(t), first ? counted(t) : rounded(t));
  for (const double t : up.ticks()) panel.tick_up(up(t), first ? rounded(t) + " %" : "");
  panel.frame();
  panel.caption(units[cost_number], 33, 12);
  const auto place = [&](const Trial& run) { return std::pair(across(cost(run)), up(error(run))); };
  report::Points dots, stairs, corners;
  for (const Trial* run : drawn) dots.push_back(place(*run));
  for (const Trial* run : front(scene, sweep, q, costs[cost_number])) {
    corners.push_back(place(*run));
    if (!stairs.empty()) stairs.emplace_back(corners.back().first, stairs.back().second);
    stairs.push_back(corners.back());
  }
  panel.dots(dots, 3, Colour::hex(0xb8c0c8));
  panel.canvas.line(stairs, line, 1.5);
  panel.dots(corners, 3.5, line);
  const auto [x, y] = place(sweep.standard());
  report::ring(panel.canvas, x, y, 6, 3.5, Colour::hex(0x1f5f99));
  for (std::size_t n = 0; timed && n < corners.size(); ++n)
    panel.canvas.text_with_halo(corners[n].first + 6, corners[n].second - 5, std::to_string(n + 1), 11, line,
                                {1, 1, 1});
}

}  // namespace detail

/// Draws the magnitude of each headline error against each cost. Runs on the front are joined by a line and, against
/// time, numbered as in the tables; the standard has a ring. Errors below 1e-4 % are drawn at 1e-4 %. Runs of another
/// problem are left out.
inline void draw(const Scene& scene, const Sweep& sweep, const std::filesystem::path& path) {
  constexpr double left = 66, top = 34, width = 250, height = 190, gap = 52, below = 58;
  constexpr auto ink = report::Colour::hex(0x222222);
  const auto rows = std::count_if(scene.quantities.begin(), scene.quantities.end(),
                                  [](const Quantity& quantity) { return quantity.headline; });
  report::Canvas canvas(static_cast<int>(left + 3 * width + 2 * gap + 16),
                        static_cast<int>(static_cast<double>(rows) * (top + height + below)));
  double y = top;
  for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
    if (!scene.quantities[q].headline) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = left + static_cast<double>(k) * (width + gap);
      detail::draw_front(scene, sweep, q, k, {.canvas = canvas, .x = x, .y = y, .width = width, .height = height});
    }
    canvas.text(left, y - 10, scene.title + ": error of " + scene.quantities[q].name, 13, ink, report::Anchor::left,
                true);
    canvas.text(left + 3 * width + 2 * gap, y - 10, "red: the front, ring: the standard", 11, ink,
                report::Anchor::right);
    y += top + height + below;
  }
  canvas.save(path);
}

}  // namespace tradeoff
