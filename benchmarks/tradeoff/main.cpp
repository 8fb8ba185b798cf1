// SPDX-License-Identifier: MIT
// Sweeps scenes over their parameters and writes docs/measured/tradeoff.md, which shows what accuracy costs. See
// --help.
#include <algorithm>
#include <cstdio>
#include <hmps/output/file_replacement.hpp>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/files.hpp"
#include "report/page.hpp"
#include "report/study.hpp"
#include "tradeoff/agreement.hpp"
#include "tradeoff/chart.hpp"
#include "tradeoff/page.hpp"
#include "tradeoff/scenes.hpp"
#include "tradeoff/table.hpp"

namespace {

using namespace tradeoff;
namespace fs = std::filesystem;

constexpr std::pair<const char*, Scene (*)(const Scale&)> makers[] = {
    {"beam", beam},       {"bar", bar}, {"sag", sag}, {"contact", contact},
#ifdef TRADEOFF_SWALLOW
    {"swallow", swallow},
#endif
};

std::string preface() {
  return "# What accuracy costs\n\n" +
         wrapped(
             "This page and its pictures are written by `benchmarks/tradeoff/run`; nothing in it is typed by hand. "
             "`benchmarks/tradeoff/run --help` lists its options; the tables of all runs go to `results/tradeoff`. A "
             "scene of your own takes one file of about a hundred lines: start from "
             "`benchmarks/tradeoff/sag.cpp`.") +
         '\n' +
         bullets(
             {"**Particles**: those of a lattice, or of `fit_particles`, bonded by a `BondList`, with E_hat and mean "
              "dilatation as `thin_wall_stabiliser` chooses them; with these, the setting E_hat does not apply and r_e "
              "is 1.75 l0. A body of eight and more layers counts as bulk, where E_hat is 4/3 mu. The time and memory "
              "of the fit are not counted.",
              "**Error**: signed, in per cent of the right answer or, if that is zero, of the energy or the load "
              "itself. The swallow has scales of its own.",
              "**Particle-steps** and **memory** are counted, not timed. Memory is what the scene holds while "
              "stepping.",
              "**Time** is processor time relative to that of the standard settings. Each run is timed beside a run "
              "of the standard, up to five times, and the median is given. Differences below a tenth mean nothing.",
              "**Front**: the runs that no other run beats in both error and cost. A run can be on the front because "
              "its error happens to cross zero; \"What to choose\" therefore names runs that stay within the limit "
              "when the spacing alone is refined, and says where no finer run was made.",
              "**take**: a lower cost with no larger error, or a smaller error at no higher cost; **pay**: a smaller "
              "error at a higher cost; **save**: a larger error at a lower cost; **leave**: no gain; **weigh**: one "
              "error is smaller, another larger; **no matter**: neither errors nor cost differ; **avoid**: the run "
              "fails."}) +
         '\n' + wrapped("Compiled by " + report::compiler() + " and run on " + report::processor() + ".");
}

}  // namespace

int main(int argc, char** argv) {
  report::Study study(
      "tradeoff",
      "Sweeps scenes over spacing, step, scalar, particles and more, and writes the front of error against cost as "
      "CSV,\npicture and sentences.",
      "small sweeps of seconds, to see that it works");
  std::vector<std::string> names;
  for (const auto& [name, make] : makers) names.emplace_back(name);
  std::vector<std::string> chosen = names;
  std::string finer = "results/swallowing";
  bool tables = false;
  study.app.add_option("--scene", chosen, "which of " + CLI::detail::join(names) + " (default: all)")
      ->type_name("NAME")
      ->check(CLI::IsMember(names));
  study.app.add_flag("--tables", tables, "run nothing: write pictures and page anew from the tables in --out");
  study.app
      .add_option("--finer", finer,
                  "folder with results of the swallow at finer spacings, with which it is compared where there are any "
                  "(default: results/swallowing)")
      ->type_name("DIR")
      ->take_last();
  return study.run(argc, argv, [&] {
    for (const std::string& name : chosen)
      examples::require(!tables || fs::exists(study.out / (name + ".csv")), "there is no table ",
                        (study.out / (name + ".csv")).string(),
                        "; sweep the scene without --tables, or name others by --scene");
    // The sections of scenes that are not swept stay in the page.
    std::string page = report::with_opening(study.page(), preface());
    if (page.find("<!-- begin agreement -->") == std::string::npos) page = report::with_section(page, "agreement", "");
    std::vector<Swept> all;
    for (const auto& [key, make] : makers) {
      const std::string name = key, picture = "tradeoff_" + name + ".png";
      const bool wanted = std::find(chosen.begin(), chosen.end(), name) != chosen.end();
      const fs::path table = study.out / (name + ".csv");
      const bool run = wanted && !tables;
      if (!run && !fs::exists(table)) continue;
      const Scene scene = make({.quick = study.quick, .out = study.out / name, .finer = finer});
      if (run) {
        const Sweep swept = sweep(scene, [](const std::string& line) { std::cerr << line << '\n'; });
        hmps::replace_file(table, csv(scene, swept));
      }
      all.push_back({scene, read_csv(scene, examples::read_file(table))});
      if (!wanted) continue;
      const Sweep& swept = all.back().sweep;
      draw(scene, swept, study.out / picture);
      study.draw({picture, "", [&](const auto& path) { draw(scene, swept, path); }});
      const std::string text = section(scene, swept, "images/" + picture);
      std::cout << text << '\n';
      page = report::with_section(page, name, text);
      if (all.size() > 1) page = report::with_section(page, "agreement", agreement(all));
      study.save(page);
    }
  });
}
