// SPDX-License-Identifier: MIT
// Sweeps scenes over their parameters and writes what accuracy costs: see docs/tradeoff.md, which this writes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "../../examples/common/files.hpp"
#include "../../examples/common/streams.hpp"
#include "agreement.hpp"
#include "chart.hpp"
#include "report.hpp"
#include "scenes.hpp"
#include "sweep.hpp"
#include "table.hpp"

namespace {

namespace fs = std::filesystem;

constexpr std::pair<const char*, tradeoff::Scene (*)(const tradeoff::Scale&)> scenes[] = {
    {"beam", tradeoff::beam},       {"bar", tradeoff::bar}, {"sag", tradeoff::sag}, {"contact", tradeoff::contact},
#ifdef TRADEOFF_SWALLOW
    {"swallow", tradeoff::swallow},
#endif
};

/// The name that the system gives the processor.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "an unnamed processor";
}

#ifdef __clang__
constexpr const char* compiler = "clang++ " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

std::string preface() {
  std::string text = "# What accuracy costs\n\n";
  text += tradeoff::wrapped(
      "This page and its pictures are written by `benchmarks/tradeoff/run`; nothing in it is typed by hand. "
      "`benchmarks/tradeoff/run --help` lists what else it does; `results/tradeoff` gets the tables of all runs. A "
      "scene "
      "of your own is one file of less than a hundred lines: start from `benchmarks/tradeoff/sag.cpp`.");
  text += '\n';
  for (const char* line :
       {"- **Error**: signed, in per cent of the right answer, or of what the quantity is named for.",
        "- **Particle-steps** and **memory** are counted, not timed. Memory is what the scene holds while stepping.",
        "- **Time** is that of one processor over that of the standard settings, each run timed beside the standard; "
        "median of up to five. Differences below a tenth mean nothing.",
        "- **Front**: the runs that no other run beats in error and cost at once. A run can be on it because its error "
        "happens to cross zero; \"what to choose\" therefore names runs that keep the error when the spacing alone is "
        "refined, and says where none was.",
        "- **take** costs less at no larger an error, or errs less at no larger a cost; **pay** errs less for more; "
        "**save** errs more for less; **leave** gains nothing; **weigh** has one error smaller and another larger; "
        "**avoid** does not run."})
    text += tradeoff::wrapped(line, "  ");
  return text + '\n' + tradeoff::wrapped("Compiled by " + std::string(compiler) + ", run on " + processor() + ".");
}

}  // namespace

int main(int argc, char** argv) {
  examples::check_standard_streams("tradeoff");
  using namespace tradeoff;
  std::vector<std::string> names;
  for (const auto& [name, make] : scenes) names.emplace_back(name);
  std::string out = "results/tradeoff", finer = "results/swallowing", document;
  std::vector<std::string> chosen = names;
  bool quick = false, tables = false;
  CLI::App app(
      "Sweeps scenes over spacing, step, scalar and more, and writes the front of error against cost as CSV,\n"
      "picture and sentences.",
      "tradeoff");
  app.add_option("--scene", chosen, "which of " + CLI::detail::join(names) + " (default: all)")
      ->type_name("NAME")
      ->check(CLI::IsMember(names));
  app.add_flag("--quick", quick, "small sweeps of seconds, to see that it works");
  app.add_flag("--tables", tables, "run nothing: write pictures and page anew from the tables in --out");
  app.add_option("--out", out, "folder for tables and pictures (default: results/tradeoff)")
      ->type_name("DIR")
      ->take_last();
  app.add_option("--finer", finer,
                 "folder with results of the swallow at finer spacings, with which it is compared where there are any "
                 "(default: results/swallowing)")
      ->type_name("DIR")
      ->take_last();
  app.add_option("--document", document, "Markdown page whose sections are replaced; pictures go to images beside it")
      ->type_name("FILE")
      ->take_last();
  CLI11_PARSE(app, argc, argv);
  try {
    examples::prepare_folder(out);
    // What stands in the page of scenes that are not swept stays.
    std::string page = preface();
    if (!document.empty() && fs::exists(document)) {
      const std::string old = examples::read_file(document);
      if (const auto first = old.find("<!-- begin "); first != std::string::npos) page += '\n' + old.substr(first);
    }
    if (page.find("<!-- begin agreement -->") == std::string::npos) page = with_section(page, "agreement", "");
    std::vector<Swept> all;
    for (const auto& [key, make] : scenes) {
      const std::string name = key, picture = "tradeoff_" + name + ".png";
      const bool wanted = std::find(chosen.begin(), chosen.end(), name) != chosen.end();
      const fs::path table = fs::path(out) / (name + ".csv");
      const bool run = wanted && !tables;
      if (!run && !fs::exists(table)) continue;
      const Scene scene = make({.quick = quick, .out = fs::path(out) / name, .finer = finer});
      if (run) {
        const Sweep swept = sweep(scene, [](const std::string& line) { std::cerr << line << '\n'; });
        examples::write_atomically(table, csv(scene, swept));
      }
      all.push_back({scene, read_csv(scene, examples::read_file(table))});
      if (!wanted) continue;
      const Sweep& swept = all.back().sweep;
      draw(scene, swept, fs::path(out) / picture);
      const std::string text = section(scene, swept, "images/" + picture);
      std::cout << text << '\n';
      page = with_section(page, name, text);
      if (document.empty()) continue;
      const fs::path images = fs::path(document).parent_path() / "images";
      examples::prepare_folder(images);
      draw(scene, swept, images / picture);
      if (all.size() > 1) page = with_section(page, "agreement", agreement(all));
      examples::write_atomically(document, page);
    }
  } catch (const std::exception& error) {
    std::cerr << "tradeoff: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
