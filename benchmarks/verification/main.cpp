// SPDX-License-Identifier: MIT
// Problems with known answers, refined: writes docs/verification.md. See --help.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "../../examples/common/files.hpp"
#include "../../examples/common/streams.hpp"
#include "page.hpp"
#include "parts.hpp"

namespace {

using namespace verification;
namespace fs = std::filesystem;

std::vector<Problem> problems() {
  return {affine_patch(), rigid_motion(),   uniaxial_stress(), equibiaxial_stress(), simple_shear(),
          free_bar(),     rubber_bar(),     cantilever(),      bonded_shear(),       bonded_compression(),
          torsion(),      long_wall(),      thick_cylinder(),  bending_column(),     oscillating_plate(),
          elastic_flag(), cooks_membrane(), sphere_on_block(), contact_patch(),      dispersion()};
}

/// `seconds`: what the runs took.
std::string preface(double seconds) {
  using tradeoff::wrapped;
  std::string text = "# Problems with known answers\n\n";
  text += wrapped(
      "This page, its picture and `verification.csv` beside it are written by `benchmarks/verification/run` from runs "
      "of "
      "the library's components; nothing in them is typed by hand. `--only NAME` runs one problem anew, `--quick` "
      "small "
      "sizes of all; `--help` lists the rest. It is a measurement of where the method is right and where not.");
  text += '\n';
  for (const char* line :
       {"- **Error**: relative to the answer, with its sign. A problem whose strain is the same everywhere should be "
        "right "
        "at any spacing, to the tolerance of the relaxation; for it the table gives the largest error.",
        "- **Order**: p of |error| = c h^p, fitted to all spacings whose error exceeds that of the answer itself; none "
        "is "
        "given where the error changes its sign. The tables of the problems give it between neighbouring spacings.",
        "- **Odd and even** numbers of particles across are told apart where they differ: nearly incompressible sheets "
        "with an even number of layers lock (see [theory.md](theory.md)).",
        "- **Static answers** are found by `relax`, two-dimensional ones are plane strain.",
        "- **Geometry**: particles stand at the centres of cells; a body of height h has n = h / l0 of them, the "
        "outermost half a spacing inside its faces. Displacements of faces are extrapolated from the two nearest "
        "layers.",
        "- **A fixed face** is one layer of held particles half a spacing behind it. It holds what hangs on it about "
        "half a "
        "spacing too far back, an error of first order; with two layers, as in `examples/first_program.cpp`, the error "
        "is "
        "mostly larger. Both are in the tables.",
        "- **E_hat**: the paper's E beside `shear_wave_modulus`, 4/3 of the shear modulus; "
        "`mean_dilatation` where the volume is stiff, with the shares of `split_bulk_modulus`."})
    text += wrapped(line, "  ");
  text +=
      '\n' + wrapped(
                 "Rows 7, 8 and 25 to 27 of the list from which the problems are taken are held by tests: energy by "
                 "`tests/hmps/time/symplectic_euler.test.cpp`, the largest step by "
                 "`tests/hmps/analysis/stable_step.test.cpp` and [stability.md](stability.md), incline and slide by "
                 "`tests/hmps/contact/incline.test.cpp`, stick by `tests/hmps/contact/penalty.test.cpp`.");
  return text + '\n' + wrapped("All runs took " + stability::digits(seconds / 60, 2) + " minutes of one core here.") +
         '\n';
}

}  // namespace

int main(int argc, char** argv) {
  examples::check_standard_streams("verification");
  std::string out = "results/verification", document;
  std::vector<std::string> chosen;
  bool quick = false, tables = false, list = false;
  CLI::App app(
      "Problems with known answers at growing resolution: errors, orders of convergence, a page and a picture.",
      "verification");
  app.add_option("--only", chosen, "problems to run anew; the rest is taken from the table in --out")
      ->type_name("NAME");
  app.add_flag("--list", list, "names of the problems");
  app.add_flag("--quick", quick, "only the three smallest sizes of each");
  app.add_flag("--tables", tables, "run nothing: write page and picture anew from the table in --out");
  app.add_option("--out", out, "folder of the table and the picture (default: results/verification)")->take_last();
  app.add_option("--document", document, "page to write; picture and table go beside it")->take_last();
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Problem> all = problems();
    if (list) {
      for (const Problem& problem : all) std::printf("%s\n", problem.name.c_str());
      return 0;
    }
    for (const std::string& name : chosen)
      hmps::require(std::any_of(all.begin(), all.end(), [&](const Problem& p) { return p.name == name; }),
                    "verification: there is no problem ", name, "; --list names them");
    examples::prepare_folder(out);
    const fs::path file = fs::path(out) / "verification.csv";
    const std::string old = fs::exists(file) ? examples::read_file(file) : "";
    std::vector<Solved> solved;
    std::string csv = csv_header;
    for (Problem& problem : all) {
      if (quick && problem.sizes.size() > 3) problem.sizes.resize(3);
      const bool wanted =
          !tables && (chosen.empty() || std::find(chosen.begin(), chosen.end(), problem.name) != chosen.end());
      Solved one{problem, wanted ? std::vector<Trial>{} : read_trials(problem, old)};
      for (std::size_t m = 0; wanted && m < problem.methods.size(); ++m)
        for (const int size : problem.sizes) {
          one.trials.push_back(solve(problem, size, problem.methods[m]));
          std::fprintf(stderr, "%s, %s, %d: %.1f s\n", problem.name.c_str(), problem.methods[m].name.c_str(), size,
                       one.trials.back().seconds);
        }
      csv += csv_lines(one);
      solved.push_back(std::move(one));
      // Kept after each problem, so that nothing is lost if the next one is stopped.
      if (wanted) {
        std::string rest = csv;
        for (std::size_t k = solved.size(); k < all.size(); ++k) rest += csv_lines({all[k], read_trials(all[k], old)});
        examples::write_atomically(file, rest);
      }
    }
    double seconds = 0;
    for (const Solved& one : solved)
      for (const Trial& trial : one.trials) seconds += trial.seconds;
    std::string page = preface(seconds) + summary(solved) +
                       "\n![Error over the number of particles across](images/verification.png)\n";
    for (const Solved& one : solved) page += '\n' + section(one);
    std::printf("%s\n%.0f s in all\n", summary(solved).c_str(), seconds);
    draw(solved, fs::path(out) / "verification.png");
    if (!document.empty()) {
      const fs::path folder = fs::path(document).parent_path();
      examples::prepare_folder(folder / "images");
      draw(solved, folder / "images" / "verification.png");
      examples::write_atomically(folder / "verification.csv", csv);
      examples::write_atomically(document, page);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "verification: %s\n", error.what());
    return 2;
  }
  return 0;
}
