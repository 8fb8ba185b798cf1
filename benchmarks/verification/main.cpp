// SPDX-License-Identifier: MIT
// Solves problems with known answers at increasing resolution and writes docs/measured/verification.md. See --help.
#include <algorithm>
#include <cstdio>
#include <hmps/output/file_replacement.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "common/files.hpp"
#include "report/study.hpp"
#include "verification/page.hpp"
#include "verification/problems.hpp"

namespace {

using namespace verification;

/// The number of runs of a problem.
std::size_t runs_of(const Problem& problem) { return problem.methods.size() * problem.sizes.size(); }

/// All problems with their runs: problems that are `wanted` are run, the others are read from the table `old`. The
/// table in `file` is written after each problem, so that nothing is lost if the program is stopped.
std::vector<Solved> solve_all(const std::vector<Problem>& all, const std::string& old,
                              const std::filesystem::path& file, const std::function<bool(const Problem&)>& wanted) {
  std::vector<Solved> solved;
  for (const Problem& problem : all) solved.push_back({problem, read_trials(problem, old)});
  for (Solved& one : solved) {
    if (!wanted(one.problem)) continue;
    one.trials.clear();
    for (const Method& method : one.problem.methods)
      for (const int size : one.problem.sizes) {
        one.trials.push_back(solve(one.problem, size, method));
        std::fprintf(stderr, "%s, %s, %d: %.1f s\n", one.problem.name.c_str(), method.name.c_str(), size,
                     one.trials.back().seconds);
      }
    hmps::replace_file(file, csv(solved));
  }
  return solved;
}

}  // namespace

int main(int argc, char** argv) {
  report::Study study("verification",
                      "Problems with known answers at growing resolution: errors, orders of convergence, a page and a "
                      "picture.",
                      "only the three smallest sizes of each");
  std::vector<std::string> chosen;
  bool tables = false, list = false;
  study.app
      .add_option("--only", chosen,
                  "problems to run anew; the rest is taken from the table in --out, or else beside --document")
      ->type_name("NAME");
  study.app.add_flag("--list", list, "names of the problems");
  study.app.add_flag("--tables", tables,
                     "run nothing: write page and picture anew from the table in --out, or else beside --document");
  return study.run(argc, argv, [&] {
    std::vector<Problem> all = problems();
    if (list)
      for (const Problem& problem : all) std::printf("%s\n", problem.name.c_str());
    if (list) return;
    for (const std::string& name : chosen)
      examples::require(std::any_of(all.begin(), all.end(), [&](const Problem& p) { return p.name == name; }),
                        "verification: there is no problem ", name, "; --list names them");
    for (Problem& problem : all)
      if (study.quick && problem.sizes.size() > 3) problem.sizes.resize(3);
    const auto wanted = [&](const Problem& problem) {
      return !tables && (chosen.empty() || std::find(chosen.begin(), chosen.end(), problem.name) != chosen.end());
    };
    const std::filesystem::path table = study.out / "verification.csv",
                                beside = std::filesystem::path(study.document).parent_path() / "verification.csv";
    // In a fresh clone, the table exists only beside the page.
    const auto& known = std::filesystem::exists(table) || study.document.empty() ? table : beside;
    const std::string old = std::filesystem::exists(known) ? examples::read_file(known) : "";
    // The page must contain all problems, except that of a quick run, which nobody keeps.
    if (tables || !(study.document.empty() || study.quick))
      for (const Problem& problem : all)
        examples::require(wanted(problem) || read_trials(problem, old).size() == runs_of(problem), known.string(),
                          " does not have all runs of ", problem.name, "; run it too, by --only, or run all problems");
    const std::vector<Solved> solved = solve_all(all, old, table, wanted);
    std::printf("%s\n", summary(solved).c_str());
    draw(solved, study.out / "verification.png");
    study.draw({"verification.png", "", [&](const auto& path) { draw(solved, path); }});
    study.save(page_of(solved));
    if (!study.document.empty()) hmps::replace_file(beside, csv(solved));
  });
}
