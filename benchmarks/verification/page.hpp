// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "../tradeoff/chart.hpp"
#include "../tradeoff/report.hpp"
#include "results.hpp"

/// The results as a page in Markdown and a picture.
namespace verification {

[[nodiscard]] inline std::string percent(double error) {
  if (!std::isfinite(error)) return "failed";
  return (error > 0 ? "+" : "") + stability::digits(100 * error, 2) + " %";
}

/// What a method made of a quantity: the largest error where it should be right at any spacing, otherwise that of the
/// finest and the order.
[[nodiscard]] inline std::string verdict(const Solved& solved, const std::string& method, std::size_t q) {
  const Quantity& quantity = solved.problem.quantities[q];
  const Curve all = curve(solved, method, q, Sizes::all);
  if (all.empty()) return "-";
  if (quantity.bound > 0) {
    double worst = 0;
    for (const double error : all.errors) worst = std::max(worst, std::abs(error));
    return stability::digits(worst, 2) + " at most";
  }
  const auto part = [&](Sizes sizes, const char* name) {
    const Curve c = curve(solved, method, q, sizes);
    if (c.empty()) return std::string();
    const std::string order = order_text(c, quantity.resolution());
    return name + percent(c.errors.back()) + (order == "-" ? "" : "; " + order);
  };
  if (!solved.problem.parity) return part(Sizes::all, "");
  return part(Sizes::odd, "odd ") + "<br>" + part(Sizes::even, "even ");
}

/// The table of all problems.
[[nodiscard]] inline std::string summary(const std::vector<Solved>& all) {
  std::string text = "| Problem | Quantity | Answer | Source | " + paper.name + " | " + shear_wave.name + " | " +
                     mean_dilatation.name + " |\n";
  text += "|---|---|---|---|---|---|---|\n";
  for (const Solved& solved : all)
    for (std::size_t q = 0; q < solved.problem.quantities.size(); ++q) {
      const Quantity& quantity = solved.problem.quantities[q];
      std::string answer = stability::digits(quantity.answer, 5);
      if (quantity.uncertainty > 0) answer += " +- " + stability::digits(quantity.uncertainty, 2);
      if (quantity.unit != "1") answer += ' ' + quantity.unit;
      text += "| " + (q == 0 ? solved.problem.title : std::string()) + " | " + quantity.name + " | " + answer + " | " +
              quantity.source + " | " + verdict(solved, paper.name, q) + " | " + verdict(solved, shear_wave.name, q) +
              " | " + verdict(solved, mean_dilatation.name, q) + " |\n";
    }
  return text;
}

/// All runs of a problem, with the order between two sizes (of the same parity where that matters).
[[nodiscard]] inline std::string table(const Solved& solved) {
  const Problem& problem = solved.problem;
  std::string head = "| Method | " + problem.across + " | Particles |", line = "|---|---|---|", text;
  for (const Quantity& quantity : problem.quantities) {
    head += ' ' + quantity.name + (quantity.unit == "1" ? "" : " (" + quantity.unit + ")") + " | error |";
    line += "---|---|";
    if (quantity.bound == 0) head += " order |", line += "---|";
  }
  for (std::size_t k = 0; k < solved.trials.size(); ++k) {
    const Trial& trial = solved.trials[k];
    text += "| " + trial.method + " | " + std::to_string(trial.size) + " | " +
            std::to_string(trial.measured.particles) + " |";
    if (!trial.failure.empty()) {
      text += " failed: " + trial.failure + " |\n";
      continue;
    }
    const std::size_t back = problem.parity ? 2 : 1;
    const Trial* before =
        k >= back && solved.trials[k - back].method == trial.method ? &solved.trials[k - back] : nullptr;
    for (std::size_t q = 0; q < problem.quantities.size(); ++q) {
      const Quantity& quantity = problem.quantities[q];
      const double value = trial.measured.values[q], error = quantity.error(value);
      text += ' ' + stability::digits(value, 5) + " | " +
              (quantity.bound > 0 ? stability::digits(error, 2) : percent(error)) + " |";
      if (quantity.bound > 0) continue;
      std::string order = "-";
      if (before != nullptr && before->failure.empty()) {
        const double earlier = quantity.error(before->measured.values[q]);
        // Between errors that mean something and have one sign.
        if (earlier * error > 0 && std::min(std::abs(earlier), std::abs(error)) > quantity.resolution())
          order = stability::places(order_between(before->measured.spacing, earlier, trial.measured.spacing, error), 1);
      }
      text += ' ' + order + " |";
    }
    text += '\n';
  }
  return head + '\n' + line + '\n' + text;
}

/// The section of a problem.
[[nodiscard]] inline std::string section(const Solved& solved) {
  std::string text =
      "## " + solved.problem.title + "\n\n" + tradeoff::wrapped(solved.problem.text) + '\n' + table(solved);
  if (!solved.problem.remark.empty()) text += '\n' + tradeoff::wrapped(solved.problem.remark);
  return text;
}

/// Draws the error of the first quantity of each problem that converges over the number of particles across.
inline void draw(const std::vector<Solved>& all, const std::filesystem::path& path) {
  using examples::Anchor, examples::Colour;
  constexpr double left = 52, top = 30, width = 210, height = 150, right = 14, below = 44, legend = 56;
  constexpr int columns = 4;
  constexpr auto ink = Colour::hex(0x222222), grid = Colour::hex(0xe6e6e6), unsure = Colour::hex(0xf2ecd9);
  const std::vector<std::pair<Method, Colour>> lines{{paper, Colour::hex(0xc0392b)},
                                                     {shear_wave, Colour::hex(0x1f5f99)},
                                                     {two_layers, Colour::hex(0x9cc4e0)},
                                                     {mean_dilatation, Colour::hex(0x2e8b57)}};
  std::vector<const Solved*> shown;
  for (const Solved& solved : all)
    if (solved.problem.quantities[0].bound == 0 && !solved.trials.empty()) shown.push_back(&solved);
  const int rows = (static_cast<int>(shown.size()) + columns - 1) / columns;
  examples::Canvas canvas(static_cast<int>(columns * (left + width + right)),
                          static_cast<int>(legend + rows * (top + height + below)));
  double at = left;
  for (const auto& [method, colour] : lines) {
    canvas.line(at, 20, at + 24, 20, colour, 2);
    canvas.text(at + 30, 24, method.name, 12, ink);
    at += 60 + canvas.text_width(method.name, 12);
  }
  canvas.text(left, 44, "dashed: even numbers of particles; shaded: within the answer's own error", 12, ink);

  for (std::size_t p = 0; p < shown.size(); ++p) {
    const Solved& solved = *shown[p];
    const Problem& problem = solved.problem;
    const Quantity& quantity = problem.quantities[0];
    const auto column = static_cast<double>(p % columns), row = static_cast<double>(p / columns);
    const double x0 = left + column * (left + width + right), y0 = legend + top + row * (top + height + below);
    double least = 1e300, most = 0, near = 1e300, far = 0;
    const auto size_error = [&](const Trial& trial) {
      return std::max(std::abs(quantity.error(trial.measured.values[0])), 1e-5);
    };
    for (const Trial& trial : solved.trials) {
      if (!trial.failure.empty()) continue;
      least = std::min(least, size_error(trial)), most = std::max(most, size_error(trial));
      near = std::min(near, 1.0 / trial.size), far = std::max(far, 1.0 / trial.size);
    }
    if (far == 0) continue;
    least = std::max(least, most * 1e-3);
    const tradeoff::detail::LogAxis across(near, far, x0, x0 + width), up(least, most, y0 + height, y0);
    const auto clamped = [&](double error) { return std::clamp(up(std::max(error, 1e-9)), y0, y0 + height); };
    if (quantity.resolution() > 0)
      canvas.rectangle(x0, clamped(quantity.resolution()), width, y0 + height - clamped(quantity.resolution()), unsure);
    for (const double t : up.ticks()) {
      canvas.line(x0, up(t), x0 + width, up(t), grid, 1);
      canvas.text(x0 - 4, up(t) + 4, stability::digits(100 * t, 2) + " %", 10, ink, Anchor::right);
    }
    for (const int size : problem.sizes) {
      const double x = across(1.0 / size);
      canvas.line(x, y0, x, y0 + height, grid, 1);
      canvas.text(x, y0 + height + 13, std::to_string(size), 10, ink, Anchor::middle);
    }
    canvas.frame(x0, y0, width, height, Colour::hex(0x888888));
    canvas.text(x0, y0 - 8, problem.title, 12, ink, Anchor::left, true);
    canvas.text(x0 + width / 2, y0 + height + 28, quantity.name + ", over " + problem.across, 9.5, ink, Anchor::middle);
    for (const auto& [method, colour] : lines)
      for (const bool odd : {true, false}) {
        std::vector<std::pair<double, double>> points;
        for (const Trial& trial : solved.trials)
          if (trial.method == method.name && trial.failure.empty() && (!problem.parity || (trial.size % 2 == 1) == odd))
            points.emplace_back(across(1.0 / trial.size), clamped(size_error(trial)));
        canvas.line(points, colour, 1.5, odd || !problem.parity ? std::vector<double>{} : std::vector<double>{4, 3});
        for (const auto& [x, y] : points) canvas.disc(x, y, 2.5, colour);
        if (!problem.parity) break;
      }
  }
  canvas.save(path);
}

}  // namespace verification
