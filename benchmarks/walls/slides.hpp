// SPDX-License-Identifier: MIT
#pragma once

// The forces on blocks that slide along walls of every kind.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "report/chart.hpp"
#include "report/table.hpp"
#include "report/text.hpp"
#include "walls/block.hpp"

namespace walls {

using report::digits, report::places, report::Table;

inline constexpr std::array angles{0., 15., 22.5, 30., 45.};
inline constexpr double mu = 0.2;

/// A candidate that was not adopted: the smooth metaball with a longer reach, which should level the staircase.
struct WideMetaball : hmps::SmoothMetaball {
  static constexpr double radius = 3.5;
};

/// The angles of a wall or block: surface particles along a lattice are not raised, and 22.5 degrees are only for
/// fitted bodies.
[[nodiscard]] inline std::vector<double> angles_of(Made made, Part part, bool quick) {
  std::vector<double> chosen;
  for (const double degrees : angles) {
    const bool known =
        made == Made::fitted || (degrees != 22.5 && (degrees != 0 || (made == Made::cut && part == Part::wall)));
    if (known && (!quick || degrees == 15 || (degrees == 0 && made == Made::cut))) chosen.push_back(degrees);
  }
  return chosen;
}
[[nodiscard]] inline std::string skin(Made made, double degrees) {
  if (made == Made::fitted) return "fitted";
  return degrees == 0 ? "along the lattice" : made == Made::raised ? "raised" : "as cut";
}

/// The results of one metaball on one wall.
struct Found {
  std::string kernel;
  Made made;
  Part part;
  double degrees;
  Relief relief;
  Outcome frictionless, rough;
  [[nodiscard]] bool along() const { return made == Made::cut && degrees == 0; }
  [[nodiscard]] double error() const { return rough.friction / mu - 1; }
  [[nodiscard]] double drag() const { return frictionless.friction; }
};
template <class Ball>
void measure(const std::string& kernel, Made made, Part part, bool quick, std::vector<Found>& all) {
  for (const double degrees : angles_of(made, part, quick)) {
    Scene scene{.degrees = degrees, .made = made, .part = part};
    const Outcome frictionless = run<Ball, hmps::CorrectedFriction>(scene);
    scene.friction = mu;
    all.push_back({kernel, made, part, degrees, relief_of<Ball>({.degrees = degrees, .made = made}), frictionless,
                   run<Ball, hmps::CorrectedFriction>(scene)});
  }
}
/// Measures one part with all kinds of surface particles.
template <class Ball>
void measure(const std::string& kernel, Part part, bool quick, std::vector<Found>& all) {
  for (const Made made : {Made::cut, Made::raised, Made::fitted})
    if (part != Part::both || made == Made::fitted) measure<Ball>(kernel, made, part, quick, all);
}

/// The largest magnitude of the value that `of` returns, over the walls (or blocks) of one metaball and one kind of
/// surface particles, at an angle or along the lattice.
template <class Of>
[[nodiscard]] double worst(const std::vector<Found>& all, const std::string& kernel, Made made, bool along, Of&& of,
                           Part part = Part::wall) {
  double most = 0;
  for (const Found& row : all)
    if (row.kernel == kernel && row.part == part && row.made == made && row.along() == along)
      most = std::max(most, std::abs(of(row)));
  return most;
}
[[nodiscard]] inline std::string percent(double share, int count = 1) { return places(100 * share, count) + " %"; }

[[nodiscard]] inline Table table_of(const std::vector<Found>& all) {
  Table table{"walls",
              {"Metaball", "Turned", "Surface", "Angle", "Offset, l0", "Bumps, l0", "Tilt, rms", "Tilt, largest",
               "Drag without friction", "Ripple of F_n", "Error of friction", "Time"}};
  const double unit = all.front().rough.seconds;
  for (const Found& row : all)
    table.rows.push_back({row.kernel,
                          row.part == Part::both    ? "both"
                          : row.part == Part::block ? "block"
                                                    : "wall",
                          skin(row.made, row.degrees), digits(row.degrees), places(row.relief.offset),
                          places(row.relief.bumps), places(row.relief.tilt), places(row.relief.largest_tilt),
                          places(row.drag(), 4), percent(row.rough.ripple), percent(row.error()),
                          places(row.rough.seconds / unit, 1)});
  const auto error = [](const Found& row) { return row.error(); };
  const auto drag = [](const Found& row) { return row.drag(); };
  table.check(worst(all, "smooth", Made::cut, true, error) < 0.01,
              "along the lattice the error of friction with the smooth metaball is 1 % at most");
  table.check(worst(all, "smooth", Made::raised, false, error) < 0.3 * worst(all, "smooth", Made::cut, false, error),
              "raising the surface particles removes two thirds of the error of friction");
  table.check(worst(all, "smooth", Made::raised, false, drag) < 0.5 * worst(all, "smooth", Made::cut, false, drag),
              "raising the surface particles removes half of the drag");
  for (const Part part : {Part::wall, Part::block, Part::both}) {
    const std::string what = part == Part::wall ? "wall" : part == Part::block ? "block" : "pair";
    table.check(worst(all, "smooth", Made::fitted, false, error, part) < 0.01,
                "with a fitted " + what + " the error of friction with the smooth metaball is 1 % at most");
    table.check(worst(all, "smooth", Made::fitted, false, drag, part) < 0.01,
                "with a fitted " + what + " the drag is 1 % of the normal force at most");
  }
  return table;
}

/// Advice that follows from the figures.
[[nodiscard]] inline std::string rules_of(const std::vector<Found>& all) {
  const auto error_of = [](const Found& row) { return row.error(); };
  const auto drag_of = [](const Found& row) { return row.drag(); };
  const std::string least_above =
      places(1e-4 * std::floor(1 + 1e4 * worst(all, "smooth", Made::fitted, false, drag_of)), 4);
  const auto error = [&](const std::string& kernel, Made made, bool along, Part part = Part::wall) {
    return percent(worst(all, kernel, made, along, error_of, part));
  };
  const auto drag = [&](const std::string& kernel, Made made) {
    return places(worst(all, kernel, made, false, drag_of));
  };
  const auto time = [&](const std::string& kernel) {
    const auto seconds = [](const Found& row) { return row.rough.seconds; };
    return places(worst(all, kernel, Made::cut, true, seconds) / worst(all, "paper", Made::cut, true, seconds), 1);
  };
  const double steepest =
      worst(all, "smooth", Made::cut, false, [](const Found& row) { return row.relief.largest_tilt; });
  const std::vector<std::string> rules = {
      "Lay out the lattice of rigid walls and plates along their own surface, whatever its direction: the error of the "
      "friction coefficient is then at most " +
          error("smooth", Made::cut, true) + " with `SmoothMetaball` and " + error("paper", Made::cut, true) +
          " with `PaperMetaball`.",
      "Or fit their particles, whatever their shape: with `fit_particles` and `SmoothMetaball` the error of friction "
      "is at most " +
          error("smooth", Made::fitted, false) + ", and in a slide without friction the drag is less than " +
          least_above + " of the normal force, at any angle. For a fitted block the error is " +
          error("smooth", Made::fitted, false, Part::block) + " on a wall along its lattice and " +
          error("smooth", Made::fitted, false, Part::both) +
          " on a fitted wall. With `PaperMetaball` the error on a fitted wall is " +
          error("paper", Made::fitted, false) + ".",
      "Where a surface has to cut the lattice, use `SurfaceCorrection` in contact: with `SmoothMetaball` the error of "
      "friction is at most " +
          error("smooth", Made::raised, false) + " instead of " + error("smooth", Made::cut, false) +
          ", and in a slide without friction the drag is " + drag("smooth", Made::raised) + " instead of " +
          drag("smooth", Made::cut) +
          " of the normal force. Contact takes about as long as on a wall along its lattice.",
      "On walls as cut, expect friction coefficients that are too large by up to " + error("smooth", Made::cut, false) +
          " with `SmoothMetaball` and " + error("paper", Made::cut, false) +
          " with `PaperMetaball` if the body is driven. A body that should slide by its own weight may be stopped by "
          "the stairs: their sides are as steep as " +
          digits(steepest, 2) + " (as a tangent).",
      "What counts is the surface that is slid over: for a cut block on a wall along its lattice, the error is " +
          error("smooth", Made::cut, false, Part::block) + " as cut and " +
          error("smooth", Made::raised, false, Part::block) + " raised.",
      "A metaball that reaches further does not help: with a radius of 3.5 l0 (wide) the error of friction is " +
          error("wide", Made::cut, false) + " as cut, " + error("wide", Made::raised, false) + " raised and " +
          error("wide", Made::fitted, false) + " fitted, at " + time("wide") +
          " times the cost of the paper's metaball, whereas the smooth one costs " + time("smooth") +
          " times as much."};
  return '\n' + report::bullets(rules) + '\n';
}

/// Draws the error of friction over the angle, one line for each metaball and kind of surface particles.
inline void draw(const std::vector<Found>& all, const std::filesystem::path& path) {
  using report::Anchor, report::Colour;
  constexpr double left = 80, top = 50, across_all = 520, up_all = 260, most = 0.6;
  report::Canvas canvas(860, 380);
  auto panel = report::Panel::with_large_labels(canvas, left, top, across_all, up_all);
  const auto across = report::Axis::linear(0, 45, left, left + across_all);
  const auto up = report::Axis::linear(0, most, top + up_all, top);
  canvas.text(left, 28, "Error of a friction coefficient of 0.2 on a wall at an angle", 15, panel.ink, Anchor::left,
              true);
  for (const double tick : {0., 0.2, 0.4, 0.6}) panel.tick_up(up(tick), percent(tick, 0));
  for (const double degrees : {0., 15., 30., 45.}) panel.tick_across(across(degrees), digits(degrees), true);
  panel.caption("angle between surface and lattice, or grid of samples, degrees", 42, 12);
  const std::pair<const char*, Colour> kernels[] = {
      {"paper", Colour::hex(0xc0392b)}, {"smooth", Colour::hex(0x2060b0)}, {"wide", Colour::hex(0x30a060)}};
  double y = top + 20;
  for (const auto& [kernel, colour] : kernels)
    for (const Made made : {Made::cut, Made::raised, Made::fitted}) {
      report::Points line;
      for (const Found& row : all)
        if (row.kernel == kernel && row.part == Part::wall &&
            (row.made == made || (row.along() && made != Made::fitted)))
          line.emplace_back(across(row.degrees), up(std::clamp(row.error(), 0., most)));
      std::sort(line.begin(), line.end());
      const std::vector<double> dashes = made == Made::cut      ? std::vector<double>{6, 4}
                                         : made == Made::fitted ? std::vector<double>{1, 3}
                                                                : std::vector<double>{};
      panel.curve(line, colour, 2, 4, dashes);
      canvas.line(left + across_all + 30, y - 4, left + across_all + 70, y - 4, colour, 2, dashes);
      const char* skin = made == Made::cut ? ", as cut" : made == Made::raised ? ", raised skin" : ", fitted";
      canvas.text(left + across_all + 80, y, std::string(kernel) + skin, 13, panel.ink);
      y += 24;
    }
  canvas.save(path);
}

}  // namespace walls
