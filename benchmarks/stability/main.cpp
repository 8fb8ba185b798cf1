// SPDX-License-Identifier: MIT
// The survival map: runs that go until they break. See --help.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/canvas.hpp"
#include "common/streams.hpp"
#include "parts.hpp"

namespace {

using namespace stability;
using examples::Colour;

/// A dot for the step that `stable_step` recommends over the largest that holds, for each scene.
void draw(const std::vector<Ratio>& ratios, const fs::path& path) {
  const int row = 18, left = 300, width = 900, top = 70;
  const int height = top + row * static_cast<int>(ratios.size()) + 40;
  examples::Canvas canvas(width, height);
  const auto at = [&](double ratio) { return left + (width - left - 30) * (ratio - 0.75) / 0.3; };
  const Colour ink = Colour::hex(0x333333), grey = Colour::hex(0xbbbbbb);
  canvas.text(20, 28, "Step of stable_step (filled) and its limit (ring), over the largest that holds", 15, ink,
              examples::Anchor::left, true);
  canvas.rectangle(at(0.9), top - 10, at(1.0) - at(0.9), height - top - 20, Colour::hex(0xe6f2e6));
  for (const double tick : {0.75, 0.8, 0.85, 0.9, 0.95, 1.0, 1.05}) {
    canvas.line(at(tick), top - 10, at(tick), height - 30, grey, 1);
    canvas.text(at(tick), top - 18, places(tick, 2), 12, ink, examples::Anchor::middle);
  }
  double y = top + 8;
  for (const Ratio& ratio : ratios) {
    canvas.text(left - 15, y + 4, ratio.scene, 12, ink, examples::Anchor::right);
    canvas.line(left, y, width - 30, y, Colour::hex(0xeeeeee), 1);
    canvas.disc(at(ratio.limit), y, 5, Colour::hex(0xd06020));
    canvas.disc(at(ratio.limit), y, 3, {1, 1, 1});
    canvas.disc(at(ratio.step), y, 4.5, Colour::hex(0x2060b0));
    y += row;
  }
  canvas.save(path);
}

}  // namespace

int main(int argc, char** argv) {
  examples::check_standard_streams("stability");
  CLI::App app{"Survival map: extremes stepped up until they fail, and the estimate of the largest stable step"};
  bool quick = false;
  std::string out = "results/stability", document, only;
  app.add_flag("--quick", quick, "a few problems, to see that the properties hold, in seconds");
  app.add_option("--out", out, "folder of the tables (CSV)")->capture_default_str();
  app.add_option("--document", document, "page whose sections are replaced by the tables");
  app.add_option("--only", only,
                 "one group: courant, refresh, inversion, deformation, impact, partners, endurance, door");
  CLI11_PARSE(app, argc, argv);

  try {
    examples::prepare_folder(out);
    std::vector<Ratio> ratios;
    const std::vector<std::pair<std::string, std::function<Table()>>> groups = {
        {"courant", [&] { return courant(quick, ratios); }}, {"refresh", [&] { return refresh(quick); }},
        {"inversion", [&] { return inversion(quick); }},     {"deformation", [&] { return deformation(quick); }},
        {"impact", [&] { return impact(quick); }},           {"partners", [&] { return partners(quick); }},
        {"endurance", [&] { return endurance(quick); }},     {"door", [] { return door(); }},
    };
    bool whole = true;
    for (const auto& [name, make] : groups) {
      if (!only.empty() && only != name) continue;
      const auto start = std::chrono::steady_clock::now();
      const Table table = make();
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      std::printf("%s (%.0f s)\n\n%s\n", name.c_str(), seconds, table.markdown().c_str());
      for (const std::string& words : table.broken) {
        std::printf("does not hold: %s\n", words.c_str());
        whole = false;
      }
      std::fflush(stdout);
      examples::write_atomically(fs::path(out) / (name + ".csv"), table.csv());
      if (document.empty()) continue;
      std::string page = examples::read_file(document);
      std::string content = "\n" + table.markdown() + "\n";
      for (const std::string& words : table.broken) content += "Does not hold: " + words + ".\n";
      if (name == "courant") {
        draw(ratios, fs::path(document).parent_path() / "images" / "stability.png");
        content += "![Step and limit of stable_step over the largest step that holds](images/stability.png)\n\n";
      }
      replace_section(page, name, content);
      examples::write_atomically(document, page);
    }
    return whole ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
