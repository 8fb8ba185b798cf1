// SPDX-License-Identifier: MIT
// What a wall of particles feels like that is cut out of its lattice at an angle. See --help.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "report/chart.hpp"
#include "report/study.hpp"
#include "report/text.hpp"
#include "walls/block.hpp"

namespace {

using namespace walls;
using report::digits, report::places, report::Table;

constexpr std::array angles{0., 15., 30., 45.};
constexpr double mu = 0.2, steep_mu = 0.3, holding = 10, sliding = 20;  // -, -, degrees, degrees

/// The candidate that was not worth it: the smooth kernel with a longer reach, to level the stairs.
struct WideMetaball : hmps::SmoothMetaball {
  static constexpr double radius = 3.5;
};

/// One kernel on one wall.
struct Found {
  std::string kernel;
  bool raised, soft;
  double degrees;
  Relief relief;
  Outcome frictionless, rough;
  [[nodiscard]] double error() const { return rough.friction / mu - 1; }
};
template <class Ball>
void measure(const std::string& kernel, bool soft, bool quick, std::vector<Found>& all) {
  for (const bool raised : {false, true})
    for (const double degrees : angles) {
      if ((raised || soft) && degrees == 0) continue;  // it lies where it would be raised to
      if (quick && degrees != 0 && degrees != 15) continue;
      Scene scene{.degrees = degrees, .raised = raised, .soft = soft};
      const Outcome frictionless = run<Ball, hmps::CorrectedFriction>(scene);
      scene.friction = mu;
      all.push_back({kernel, raised, soft, degrees, relief<Ball>(degrees, raised), frictionless,
                     run<Ball, hmps::CorrectedFriction>(scene)});
    }
}

/// The largest magnitude of what `of` takes from the walls of one kernel and skin, at an angle or along the lattice; or
/// from the blocks.
template <class Of>
[[nodiscard]] double worst(const std::vector<Found>& all, const std::string& kernel, bool raised, bool along, Of&& of,
                           bool soft = false) {
  double most = 0;
  for (const Found& row : all)
    if (row.kernel == kernel && row.soft == soft && row.raised == raised && (row.degrees == 0) == along)
      most = std::max(most, std::abs(of(row)));
  return most;
}
[[nodiscard]] std::string percent(double share, int count = 1) { return places(100 * share, count) + " %"; }

[[nodiscard]] Table table_of(const std::vector<Found>& all) {
  Table table{"walls",
              {"Kernel", "What is cut", "Skin", "Angle", "Bumps, l0", "Tilt, rms", "Tilt, largest",
               "Drag without friction", "Ripple of F_n", "Error of friction", "Time"}};
  const double unit = all.front().rough.seconds;
  for (const Found& row : all)
    table.rows.push_back({row.kernel, row.soft ? "block" : "wall",
                          row.degrees == 0 ? "along the lattice"
                          : row.raised     ? "raised"
                                           : "as cut",
                          digits(row.degrees), places(row.relief.bumps), places(row.relief.tilt),
                          places(row.relief.largest_tilt), places(row.frictionless.friction, 4),
                          percent(row.rough.ripple), percent(row.error()), places(row.rough.seconds / unit, 1)});
  const auto error = [](const Found& row) { return row.error(); };
  const auto drag = [](const Found& row) { return row.frictionless.friction; };
  table.check(worst(all, "smooth", false, true, error) < 0.01,
              "along the lattice the smooth kernel errs by 1 % of friction at most");
  table.check(worst(all, "smooth", true, false, error) < 0.3 * worst(all, "smooth", false, false, error),
              "raising the skin takes away two thirds of the error of friction");
  table.check(worst(all, "smooth", true, false, drag) < 0.5 * worst(all, "smooth", false, false, drag),
              "raising the skin takes away half of the drag");
  return table;
}

/// What to do, from the figures.
[[nodiscard]] std::string rules_of(const std::vector<Found>& all) {
  const auto error_of = [](const Found& row) { return row.error(); };
  const auto error = [&](const std::string& kernel, bool raised, bool along) {
    return percent(worst(all, kernel, raised, along, error_of));
  };
  const auto drag = [&](const std::string& kernel, bool raised, bool along) {
    return places(worst(all, kernel, raised, along, [](const Found& row) { return row.frictionless.friction; }));
  };
  const auto time = [&](const std::string& kernel) {
    return places(worst(all, kernel, false, true, [](const Found& row) { return row.rough.seconds; }) /
                      worst(all, "paper", false, true, [](const Found& row) { return row.rough.seconds; }),
                  1);
  };
  const std::vector<std::string> rules = {
      "Lay rigid walls and plates out along their own surface, whatever their direction: `SmoothMetaball` then errs "
      "by " +
          error("smooth", false, true) + " of the friction coefficient at most, `PaperMetaball` by " +
          error("paper", false, true) + ".",
      "Where a surface has to cut the lattice, let contact see it through `SurfaceCorrection`: with `SmoothMetaball` "
      "the "
      "friction errs by " +
          error("smooth", true, false) + " at most instead of " + error("smooth", false, false) +
          ", and a slide without friction is dragged by " + drag("smooth", true, false) + " instead of " +
          drag("smooth", false, false) +
          " of the normal force. Contact takes about as long as on a wall along its lattice.",
      "As cut, count on friction coefficients that are too large by up to " + error("smooth", false, false) +
          " with `SmoothMetaball` and " + error("paper", false, false) +
          " with `PaperMetaball` where a body is driven, and on stairs that stop one that should slide by its weight: "
          "their sides are as steep as " +
          digits(worst(all, "smooth", false, false, [](const Found& row) { return row.relief.largest_tilt; }), 2) +
          " (as a tangent).",
      "It is the surface slid over that counts: a block that is cut, on a wall along its lattice, errs by " +
          percent(worst(all, "smooth", false, false, error_of, true)) + " as cut and by " +
          percent(worst(all, "smooth", true, false, error_of, true)) + " raised.",
      "A kernel that reaches further does not help: with a radius of 3.5 l0 (wide) friction errs by " +
          error("wide", false, false) + " as cut and " + error("wide", true, false) + " raised, for " + time("wide") +
          " times the time of the paper's kernel where the smooth one takes " + time("smooth") + "."};
  return '\n' + report::bullets(rules) + '\n';
}

/// Error of friction over the angle, one line per kernel and skin.
void draw(const std::vector<Found>& all, const std::filesystem::path& path) {
  using report::Anchor, report::Colour;
  constexpr double left = 80, top = 50, width = 520, height = 260, most = 0.6;
  report::Canvas canvas(860, 380);
  report::Panel panel{.canvas = canvas,
                      .x = left,
                      .y = top,
                      .width = width,
                      .height = height,
                      .size = 12,
                      .left = 8,
                      .below = 20,
                      .ink = Colour::hex(0x333333),
                      .grid = Colour::hex(0xdddddd)};
  const auto across = report::Axis::linear(0, 45, left, left + width);
  const auto up = report::Axis::linear(0, most, top + height, top);
  canvas.text(left, 28, "Error of a friction coefficient of 0.2 on a wall cut out of its lattice", 15, panel.ink,
              Anchor::left, true);
  for (const double tick : {0., 0.2, 0.4, 0.6}) panel.tick_up(up(tick), percent(tick, 0));
  for (const double degrees : angles) panel.tick_across(across(degrees), digits(degrees), true);
  panel.caption("angle between surface and lattice, degrees", 42, 12);
  const std::pair<const char*, Colour> kernels[] = {
      {"paper", Colour::hex(0xc0392b)}, {"smooth", Colour::hex(0x2060b0)}, {"wide", Colour::hex(0x30a060)}};
  double y = top + 20;
  for (const auto& [kernel, colour] : kernels)
    for (const bool raised : {false, true}) {
      report::Points line;
      for (const Found& row : all)
        if (row.kernel == kernel && !row.soft && (row.raised == raised || row.degrees == 0))
          line.emplace_back(across(row.degrees), up(std::clamp(row.error(), 0., most)));
      std::sort(line.begin(), line.end());
      const std::vector<double> dashes = raised ? std::vector<double>{} : std::vector<double>{6, 4};
      panel.curve(line, colour, 2, 4, dashes);
      canvas.line(left + width + 30, y - 4, left + width + 70, y - 4, colour, 2, dashes);
      canvas.text(left + width + 80, y, std::string(kernel) + (raised ? ", raised skin" : ", as cut"), 13, panel.ink);
      y += 24;
    }
  canvas.save(path);
}

/// A free block on an incline: does it stay where it must, and slide at the right rate where it does not?
[[nodiscard]] Table friction(bool quick) {
  Table table{"friction",
              {"Kernel", "Law", "Skin", "Angle", "Creeps while it should hold, l0", "Speed while it should hold, m/s",
               "Error of the acceleration, m/s2"}};
  const double slope = sliding * std::numbers::pi / 180;
  const double exact = gravity * (std::sin(slope) - steep_mu * std::cos(slope));
  double paper_creep = 0, creep = 0;
  const auto add = [&](const std::string& kernel, const std::string& law, auto run_scene) {
    for (const bool raised : {false, true})
      for (const double degrees : angles) {
        if (raised && degrees == 0) continue;
        if (quick && degrees != 15) continue;
        const auto at = [&](double incline) { return run_scene(Scene{degrees, raised, steep_mu, incline}); };
        const Outcome held = at(holding), slid = at(sliding);
        table.rows.push_back({kernel, law,
                              degrees == 0 ? "along the lattice"
                              : raised     ? "raised"
                                           : "as cut",
                              digits(degrees), digits(held.moved / spacing, 2), digits(held.shaking, 2),
                              places(slid.acceleration - exact)});
        const std::string wall = kernel + " kernel, " + law + " law, " + digits(degrees) + " degrees";
        if (kernel == "smooth" && law == "corrected") creep = std::max(creep, std::abs(held.moved / spacing));
        if (kernel == "smooth" && law == "paper's") paper_creep = std::max(paper_creep, std::abs(held.moved / spacing));
        if (kernel == "smooth" && raised)
          table.check(std::abs(slid.acceleration - exact) < 0.1 * exact,
                      wall + ": a raised skin holds the acceleration to a tenth");
      }
  };
  add("smooth", "corrected", run<hmps::SmoothMetaball, hmps::CorrectedFriction>);
  add("smooth", "paper's", run<hmps::SmoothMetaball, hmps::PaperFriction>);
  if (!quick) add("paper", "paper's", run<hmps::PaperMetaball, hmps::PaperFriction>);
  table.check(creep < 0.01, "the corrected law holds the block within a hundredth of a spacing on every wall");
  table.check(creep < 0.3 * paper_creep, "the corrected law holds the block better than the paper's");
  return table;
}

/// The drift in um/s of a block on an incline at 95 % of the friction limit: on the wall along its lattice, and the
/// largest on the walls as cut and on the raised ones.
struct Drift {
  double along = 0, cut = 0, raised = 0;
};
template <class Friction>
[[nodiscard]] Drift drift_at_the_limit(double coefficient, bool viscous, bool quick) {
  Drift drift;
  const double incline = std::atan(0.95 * coefficient) * 180 / std::numbers::pi;
  for (const bool raised : {false, true})
    for (const double degrees : angles) {
      if ((raised && degrees == 0) || (quick && degrees != 15)) continue;
      const Outcome held = run<hmps::SmoothMetaball, Friction>({.degrees = degrees,
                                                                .raised = raised,
                                                                .friction = coefficient,
                                                                .incline = incline,
                                                                .viscous = viscous,
                                                                .settled = 0.3});
      double& largest = degrees == 0 ? drift.along : raised ? drift.raised : drift.cut;
      largest = std::max(largest, 1e6 * std::abs(held.moved) / measured);
    }
  return drift;
}

/// Which law holds a block for long?
[[nodiscard]] Table limit(bool quick) {
  Table table{"limit", {"Law", "Viscosity, m2/s", "mu", "Along the lattice, um/s", "As cut, um/s", "Raised, um/s"}};
  const auto rounded = [](double drift) { return drift < 10 ? digits(drift, 2) : places(drift, 0); };
  const auto add = [&](const std::string& law, bool viscous, auto drift_of) {
    for (const double coefficient : {0.1, 0.3, 0.5, 1.0}) {
      if (quick && coefficient != 0.3 && coefficient != 1) continue;
      const Drift drift = drift_of(coefficient, viscous, quick);
      table.rows.push_back({law, digits(viscous ? viscosity : 0), digits(coefficient), rounded(drift.along),
                            rounded(drift.cut), rounded(drift.raised)});
      if (law == "spring" && viscous)
        table.check(std::max({drift.along, drift.cut, drift.raised}) < 0.1,
                    "mu = " + digits(coefficient) + ": the spring holds every block within 0.1 um/s");
    }
  };
  add("corrected", true, drift_at_the_limit<hmps::CorrectedFriction>);
  add("spring", true, drift_at_the_limit<hmps::SpringFriction>);
  if (!quick) add("spring", false, drift_at_the_limit<hmps::SpringFriction>);
  return table;
}

}  // namespace

int main(int argc, char** argv) {
  report::Study study(
      "walls", "What a wall of particles feels like that is cut out of its lattice at an angle: drag, ripple, friction",
      "the smooth kernel at 15 degrees, to see that the properties hold");
  return study.run(argc, argv, [&] {
    std::vector<Found> all;
    if (!study.quick) measure<hmps::PaperMetaball>("paper", false, study.quick, all);
    measure<hmps::SmoothMetaball>("smooth", false, study.quick, all);
    measure<hmps::SmoothMetaball>("smooth", true, study.quick, all);
    if (!study.quick) measure<WideMetaball>("wide", false, study.quick, all);
    study.publish("rules", rules_of(all));
    study.publish(table_of(all),
                  {"walls.png", "Error of friction over the angle", [&](const auto& path) { draw(all, path); }});
    study.publish(friction(study.quick));
    study.publish(limit(study.quick));
  });
}
