// SPDX-License-Identifier: MIT
// What a wall of particles feels like that is cut out of its lattice at an angle. See --help.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "../stability/page.hpp"
#include "../tradeoff/report.hpp"
#include "block.hpp"
#include "common/canvas.hpp"
#include "common/streams.hpp"

namespace {

using namespace walls;
using stability::digits, stability::places, stability::Table;
namespace fs = std::filesystem;

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
      "- Lay rigid walls and plates out along their own surface, whatever their direction: `SmoothMetaball` then errs "
      "by " +
          error("smooth", false, true) + " of the friction coefficient at most, `PaperMetaball` by " +
          error("paper", false, true) + ".",
      "- Where a surface has to cut the lattice, let contact see it through `SurfaceCorrection`: with `SmoothMetaball` "
      "the "
      "friction errs by " +
          error("smooth", true, false) + " at most instead of " + error("smooth", false, false) +
          ", and a slide without friction is dragged by " + drag("smooth", true, false) + " instead of " +
          drag("smooth", false, false) +
          " of the normal force. Contact takes about as long as on a wall along its lattice.",
      "- As cut, count on friction coefficients that are too large by up to " + error("smooth", false, false) +
          " with `SmoothMetaball` and " + error("paper", false, false) +
          " with `PaperMetaball` where a body is driven, and on stairs that stop one that should slide by its weight: "
          "their sides are as steep as " +
          digits(worst(all, "smooth", false, false, [](const Found& row) { return row.relief.largest_tilt; }), 2) +
          " (as a tangent).",
      "- It is the surface slid over that counts: a block that is cut, on a wall along its lattice, errs by " +
          percent(worst(all, "smooth", false, false, error_of, true)) + " as cut and by " +
          percent(worst(all, "smooth", true, false, error_of, true)) + " raised.",
      "- A kernel that reaches further does not help: with a radius of 3.5 l0 (wide) friction errs by " +
          error("wide", false, false) + " as cut and " + error("wide", true, false) + " raised, for " + time("wide") +
          " times the time of the paper's kernel where the smooth one takes " + time("smooth") + "."};
  std::string text;
  for (const std::string& rule : rules) text += tradeoff::wrapped(rule, "  ");
  return text;
}

/// Error of friction over the angle, one line per kernel and skin.
void draw(const std::vector<Found>& all, const fs::path& path) {
  using examples::Anchor, examples::Colour;
  constexpr double left = 80, top = 50, width = 520, height = 260, most = 0.6;
  examples::Canvas canvas(860, 380);
  const Colour ink = Colour::hex(0x333333), grid = Colour::hex(0xdddddd);
  const auto x_of = [&](double degrees) { return left + width * degrees / 45; };
  const auto y_of = [&](double error) { return top + height * (1 - error / most); };
  canvas.text(left, 28, "Error of a friction coefficient of 0.2 on a wall cut out of its lattice", 15, ink,
              Anchor::left, true);
  for (const double tick : {0., 0.2, 0.4, 0.6}) {
    canvas.line(left, y_of(tick), left + width, y_of(tick), grid, 1);
    canvas.text(left - 8, y_of(tick) + 4, percent(tick, 0), 12, ink, Anchor::right);
  }
  for (const double degrees : angles)
    canvas.text(x_of(degrees), top + height + 20, digits(degrees), 12, ink, Anchor::middle);
  canvas.text(left + width / 2, top + height + 42, "angle between surface and lattice, degrees", 12, ink,
              Anchor::middle);
  const std::pair<const char*, Colour> kernels[] = {
      {"paper", Colour::hex(0xc0392b)}, {"smooth", Colour::hex(0x2060b0)}, {"wide", Colour::hex(0x30a060)}};
  double y = top + 20;
  for (const auto& [kernel, colour] : kernels)
    for (const bool raised : {false, true}) {
      std::vector<std::pair<double, double>> line;
      for (const Found& row : all)
        if (row.kernel == kernel && !row.soft && (row.raised == raised || row.degrees == 0))
          line.emplace_back(x_of(row.degrees), y_of(std::clamp(row.error(), 0., most)));
      std::sort(line.begin(), line.end());
      std::vector<double> dashes;
      if (!raised) dashes = {6, 4};
      canvas.line(line, colour, 2, dashes);
      for (const auto& [px, py] : line) canvas.disc(px, py, 4, colour);
      canvas.line(left + width + 30, y - 4, left + width + 70, y - 4, colour, 2, dashes);
      canvas.text(left + width + 80, y, std::string(kernel) + (raised ? ", raised skin" : ", as cut"), 13, ink);
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

}  // namespace

int main(int argc, char** argv) {
  examples::check_standard_streams("walls");
  CLI::App app{
      "What a wall of particles feels like that is cut out of its lattice at an angle: drag, ripple, friction"};
  bool quick = false;
  std::string out = "results/walls", document;
  app.add_flag("--quick", quick, "the smooth kernel at 15 degrees, to see that the properties hold");
  app.add_option("--out", out, "folder of the tables (CSV)")->capture_default_str();
  app.add_option("--document", document, "page whose sections are replaced by the tables");
  CLI11_PARSE(app, argc, argv);

  try {
    examples::prepare_folder(out);
    std::vector<Found> all;
    if (!quick) measure<hmps::PaperMetaball>("paper", false, quick, all);
    measure<hmps::SmoothMetaball>("smooth", false, quick, all);
    measure<hmps::SmoothMetaball>("smooth", true, quick, all);
    if (!quick) measure<WideMetaball>("wide", false, quick, all);
    bool whole = true;
    for (const Table& table : {table_of(all), friction(quick)}) {
      std::string content = "\n" + table.markdown() + "\n";
      for (const std::string& words : table.broken) content += "Does not hold: " + words + ".\n";
      whole = whole && table.broken.empty();
      std::printf("%s\n", content.c_str());
      examples::write_atomically(fs::path(out) / (table.name + ".csv"), table.csv());
      if (document.empty()) continue;
      std::string page = examples::read_file(document);
      if (table.name == "walls") {
        draw(all, fs::path(document).parent_path() / "images" / "walls.png");
        content += "![Error of friction over the angle](images/walls.png)\n\n";
        stability::replace_section(page, "rules", "\n" + rules_of(all) + "\n");
      }
      stability::replace_section(page, table.name, content);
      examples::write_atomically(document, page);
    }
    return whole ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
