// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "../../examples/common/canvas.hpp"
#include "rules.hpp"
#include "sweep.hpp"

namespace tradeoff {

namespace detail {

/// A logarithmic axis from `low` to `high` over pixels `from` to `to`.
class LogAxis {
 public:
  LogAxis(double low, double high, double from, double to) : from_(from), to_(to) {
    low_ = std::log10(low) - 0.1;
    high_ = std::max(std::log10(high) + 0.1, low_ + 0.5);
  }
  [[nodiscard]] double operator()(double value) const {
    return from_ + (to_ - from_) * (std::log10(value) - low_) / (high_ - low_);
  }
  /// Powers of ten, and where there are fewer than three also their two- and fivefold.
  [[nodiscard]] std::vector<double> ticks() const {
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

 private:
  double low_, high_, from_, to_;
};

}  // namespace detail

/// Draws the magnitude of each headline error against each cost: all runs, those on the front joined and, against
/// time, numbered as in the tables; the standard with a ring. Errors below 1e-4 % are drawn there. Runs of another
/// problem are left out.
inline void draw(const Scene& scene, const Sweep& sweep, const std::filesystem::path& path) {
  using examples::Anchor, examples::Colour;
  constexpr double left = 66, top = 34, width = 250, height = 190, gap = 52, below = 58;
  constexpr auto dot = Colour::hex(0xb8c0c8), line = Colour::hex(0xc0392b), ink = Colour::hex(0x222222),
                 grid = Colour::hex(0xe6e6e6), ring = Colour::hex(0x1f5f99);
  std::vector<std::size_t> shown;
  for (std::size_t q = 0; q < scene.quantities.size(); ++q)
    if (scene.quantities[q].headline) shown.push_back(q);
  const auto rows = static_cast<double>(shown.size());
  examples::Canvas canvas(static_cast<int>(left + 3 * width + 2 * gap + 16),
                          static_cast<int>(rows * (top + height + below)));
  const auto error = [](const Trial& run, std::size_t q) { return std::max(std::abs(run.errors[q]), 1e-4); };
  const auto drawn = [&](const Trial& run) { return !run.failed() && scene.same_problem(run.settings); };
  const char* units[] = {"particle-steps", "time over the standard's", "memory (MB)"};

  for (std::size_t r = 0; r < shown.size(); ++r) {
    const std::size_t q = shown[r];
    const double y0 = static_cast<double>(r) * (top + height + below) + top;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x0 = left + static_cast<double>(k) * (width + gap);
      const auto cost = [&](const Trial& run) { return costs[k].of(run) * (k == 2 ? 1e-6 : 1); };
      double least = 1e300, most = 0, best = 1e300, worst = 0;
      for (const Trial& run : sweep.runs)
        if (drawn(run)) {
          least = std::min(least, cost(run)), most = std::max(most, cost(run));
          best = std::min(best, error(run, q)), worst = std::max(worst, error(run, q));
        }
      const detail::LogAxis across(least, most, x0, x0 + width), up(best, worst, y0 + height, y0);
      for (const double t : across.ticks()) {
        canvas.line(across(t), y0, across(t), y0 + height, grid, 1);
        canvas.text(across(t), y0 + height + 15, k == 0 ? counted(t) : rounded(t), 11, ink, Anchor::middle);
      }
      for (const double t : up.ticks()) {
        canvas.line(x0, up(t), x0 + width, up(t), grid, 1);
        if (k == 0) canvas.text(x0 - 5, up(t) + 4, rounded(t) + " %", 11, ink, Anchor::right);
      }
      canvas.frame(x0, y0, width, height, Colour::hex(0x888888));
      canvas.text(x0 + width / 2, y0 + height + 33, units[k], 12, ink, Anchor::middle);
      for (const Trial& run : sweep.runs)
        if (drawn(run)) canvas.disc(across(cost(run)), up(error(run, q)), 3, dot);
      std::vector<std::pair<double, double>> stairs;
      const auto best_runs = front(scene, sweep, q, costs[k]);
      for (const Trial* run : best_runs) {
        const std::pair<double, double> here(across(cost(*run)), up(error(*run, q)));
        if (!stairs.empty()) stairs.emplace_back(here.first, stairs.back().second);
        stairs.push_back(here);
      }
      canvas.line(stairs, line, 1.5);
      for (const Trial* run : best_runs) canvas.disc(across(cost(*run)), up(error(*run, q)), 3.5, line);
      const Trial& standard = sweep.standard();
      canvas.disc(across(cost(standard)), up(error(standard, q)), 6, ring);
      canvas.disc(across(cost(standard)), up(error(standard, q)), 3.5, {1, 1, 1});
      if (k == 1)
        for (std::size_t n = 0; n < best_runs.size(); ++n)
          canvas.text_with_halo(across(cost(*best_runs[n])) + 6, up(error(*best_runs[n], q)) - 5, std::to_string(n + 1),
                                11, line, {1, 1, 1});
    }
    canvas.text(left, y0 - 10, scene.title + ": error of " + scene.quantities[q].name, 13, ink, Anchor::left, true);
    canvas.text(left + 3 * width + 2 * gap, y0 - 10, "red: the front, ring: the standard", 11, ink, Anchor::right);
  }
  canvas.save(path);
}

}  // namespace tradeoff
