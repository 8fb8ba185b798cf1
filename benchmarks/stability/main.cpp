// SPDX-License-Identifier: MIT
// Stability limits: runs whose loads grow until they fail. See --help.
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "report/chart.hpp"
#include "report/study.hpp"
#include "stability/groups.hpp"

namespace {

using namespace stability;

/// Draws a dot for each scene: the step that `stable_step` recommends over the largest stable one.
void draw(const std::vector<Ratio>& ratios, const std::filesystem::path& path) {
  using report::Anchor, report::Colour;
  const int row = 18, left = 300, width = 900, top = 70;
  const int height = top + row * static_cast<int>(ratios.size()) + 40;
  report::Canvas canvas(width, height);
  const auto at = report::Axis::linear(0.75, 1.05, left, width - 30);
  const Colour ink = Colour::hex(0x333333), grey = Colour::hex(0xbbbbbb);
  canvas.text(20, 28, "Step of stable_step (filled) and its limit (ring), over the largest that holds", 15, ink,
              Anchor::left, true);
  canvas.rectangle(at(0.9), top - 10, at(1.0) - at(0.9), height - top - 20, Colour::hex(0xe6f2e6));
  for (const double tick : {0.75, 0.8, 0.85, 0.9, 0.95, 1.0, 1.05}) {
    canvas.line(at(tick), top - 10, at(tick), height - 30, grey, 1);
    canvas.text(at(tick), top - 18, places(tick, 2), 12, ink, Anchor::middle);
  }
  double y = top + 8;
  for (const Ratio& ratio : ratios) {
    canvas.text(left - 15, y + 4, ratio.scene, 12, ink, Anchor::right);
    canvas.line(left, y, width - 30, y, Colour::hex(0xeeeeee), 1);
    report::ring(canvas, at(ratio.limit), y, 5, 3, Colour::hex(0xd06020));
    canvas.disc(at(ratio.step), y, 4.5, Colour::hex(0x2060b0));
    y += row;
  }
  canvas.save(path);
}

}  // namespace

int main(int argc, char** argv) {
  report::Study study("stability",
                      "Survival map: extremes stepped up until they fail, and the estimate of the largest stable step",
                      "a few problems, to see that the properties hold, in seconds");
  std::vector<Ratio> ratios;
  const std::pair<std::string, std::function<Table()>> groups[] = {
      {"courant", [&] { return courant(study.quick, ratios); }},
      {"refresh", [&] { return refresh(study.quick); }},
      {"inversion", [&] { return inversion(study.quick); }},
      {"deformation", [&] { return deformation(study.quick); }},
      {"impact", [&] { return impact(study.quick); }},
      {"partners", [&] { return partners(study.quick); }},
      {"endurance", [&] { return endurance(study.quick); }},
      {"rejected_input", [] { return rejected_input(); }},
  };
  std::vector<std::string> names;
  for (const auto& [name, measure] : groups) names.push_back(name);
  std::string only;
  study.app.add_option("--only", only, "one group alone")->type_name("NAME")->check(CLI::IsMember(names));
  return study.run(argc, argv, [&] {
    const report::Picture picture{"stability.png", "Step and limit of stable_step over the largest stable step",
                                  [&](const auto& path) { draw(ratios, path); }};
    for (const auto& [name, measure] : groups)
      if (only.empty() || only == name) study.publish(measure(), name == "courant" ? picture : report::Picture{});
  });
}
