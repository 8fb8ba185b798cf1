// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <hmps/executors/openmp.hpp>
#include <iterator>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include "../common/arguments.hpp"

namespace swallowing {

using examples::whole_within;
using examples::within;

std::filesystem::path data_folder(const Options& options) {
  return options.data.empty() ? SWALLOWING_DATA : options.data;
}

namespace {

/// The chosen of all cases, in their order, each once; all if none is chosen or "all" is among them.
std::vector<std::string> chosen_of(const std::vector<std::string>& all, const std::vector<std::string>& chosen) {
  const auto is_chosen = [&](const std::string& name) { return std::count(chosen.begin(), chosen.end(), name) > 0; };
  if (chosen.empty() || is_chosen("all")) return all;
  std::vector<std::string> cases;
  std::copy_if(all.begin(), all.end(), std::back_inserter(cases), is_chosen);
  return cases;
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                                     int& exit_code) {
  Options options;
  std::vector<std::string> chosen;
  std::string contact = "smooth", particles = "lattice", scalar, quality(default_quality.name);
  bool without_h = false, no_frames = false, no_surfaces = false;
  CLI::App app(
      "Simulates a human swallow with the Hamiltonian MPS method: cases X1, X3, Y1 and Y3 of the paper's\n"
      "Table 1. Writes for each case a summary, a time series, pictures and frames for ParaView, and for all\n"
      "of them the times of epiglottic downfolding beside the paper's Table 2.",
      "swallowing");
  app.get_formatter()->column_width(30);
  const auto number = [](CLI::Option* option, const char* unit) { return option->type_name(unit); };

  app.add_option("--case", chosen, "one or more of X1, X3, Y1 and Y3, or all (default: all)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"X1", "X3", "Y1", "Y3", "all"}));
  std::vector<std::string> names;
  for (const Quality& q : qualities) names.emplace_back(q.name);
  app.add_option(
         "--quality", quality,
         "spacing, time step and scalar in one: draft (default), standard, paper or fine; options that are given as "
         "well overrule it")
      ->type_name("NAME")
      ->check(CLI::IsMember(names));
  auto* spacing =
      number(app.add_option(
                 "--spacing", options.spacing,
                 "diameter l0 of the particles in m (draft: 2.4e-3, standard: 1.8e-3, paper: 1.2e-3, fine: 1e-3)"),
             "M")
          ->check(within(0.5e-3, 2.4e-3, "the spacing is in metres and must lie between 0.5e-3 and 2.4e-3"));
  auto* time_step =
      number(app.add_option("--time-step", options.time_step,
                            "time step in s; 0: follows the estimate of the largest stable step (default: 0; paper: "
                            "1e-5)"),
             "S")
          ->check(within(0, 1e-3, "the time step is in seconds and must lie between 0 (automatic) and 1e-3"));
  number(app.add_option("--until", options.until, "end of the simulated time in s (default: 2.05)"), "S")
      ->check(within(1e-9, end_of_swallow,
                     "the end is in seconds and must be above 0 and at most 2.05, where the "
                     "swallow ends"));
  number(app.add_option("--friction", options.friction, "friction coefficient instead of the cases' 0.1 and 0.3"), "MU")
      ->check(within(0, 10, "the friction coefficient must lie between 0 and 10"));
  app.add_option("--scalar", scalar, "float or double (default: float)")
      ->type_name("TYPE")
      ->check(CLI::IsMember({"float", "double"}));
  app.add_option("--threads", options.threads, "number of threads (default: all cores); results do not depend on it")
      ->type_name("N")
      ->transform(whole_within(1, hmps::OpenMP::most_threads(),
                               "the number of threads must lie between 1 and " +
                                   std::to_string(hmps::OpenMP::most_threads()) +
                                   ", four for each processor here: more would only wait for each other"));
  app.add_option("--out", options.out,
                 "output folder (default: results; of `run`: results/swallowing of the repository)")
      ->type_name("DIR");
  app.add_flag("--resume", options.resume,
               "continue from the last checkpoints in the output folder; results are identical to the bit. The motion "
               "of --data may differ from that of the checkpoint in what is to come");
  app.add_flag("--no-frames", no_frames, "write no frames for ParaView");
  app.add_flag("--no-surfaces", no_surfaces, "draw no smooth surfaces of the organs, which takes some seconds");
  number(app.add_option("--frame-interval", options.frame_interval, "time between frames in s (default: 0.01)"), "S")
      ->check(within(1e-5, 10, "the time between frames is in seconds and must lie between 1e-5 and 10"));
  app.add_option("--data", options.data, "folder with the motion tracks (default: those of the example)")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);

  app.add_option(
         "--contact", contact,
         "smooth (default): SmoothMetaball on the drawn surfaces, corrected friction, k of the materials; paper: "
         "its metaball (eq. 26) on the lattice's own surface, its friction (eq. 40), k~ = 0.3 unless given")
      ->type_name("NAME")
      ->check(CLI::IsMember({"smooth", "paper"}));

  app.add_option("--particles", particles,
                 "lattice (default): the sites of a cubic lattice in the organs, stabilised as in the "
                 "paper; fitted: along the surfaces of the organs, stabilised for thin walls")
      ->type_name("NAME")
      ->check(CLI::IsMember({"lattice", "fitted"}));

  const std::string experiments = "Experiments";
  auto* fixed = number(app.add_option("--penalty", options.penalty, "fixed penalty coefficient k in N/m4"), "K")
                    ->check(within(1e-300, 1e300, "the penalty coefficient must be positive"))
                    ->group(experiments);
  number(app.add_option("--penalty-ratio", options.penalty_ratio,
                        "spring ratio k~ of eq. 25, k = k~ rho / dt^2 (paper: 0.3)"),
         "R")
      ->check(within(1e-9, 0.99, "the spring ratio must be above 0 and at most 0.99"))
      ->excludes(fixed)
      ->group(experiments);
  number(app.add_option("--step-share", options.step_share,
                        "time step as a share of the largest stable step (default: 0.8)"),
         "R")
      ->check(within(1e-3, 2, "the share of the stable step must lie between 1e-3 and 2"))
      ->excludes(time_step)
      ->group(experiments);
  auto* shift =
      number(app.add_option("--lattice-shift", options.lattice_shift, "shift of the lattice along x and z in spacings"),
             "P")
          ->check(within(-1, 1, "the shift of the lattice must lie between -1 and 1 spacings"))
          ->group(experiments);
  number(app.add_option("--stiffness", options.stiffness, "factor on Young's moduli of all organs"), "R")
      ->check(within(0.1, 10, "the factor on Young's moduli must lie between 0.1 and 10"))
      ->group(experiments);
  app.add_flag("--without-H", without_h, "leave out region H, the pharyngeal constrictors")->group(experiments);

  exit_code = 0;
  try {
    app.parse(argc, argv);
    options.cases = chosen_of(options.cases, chosen);
    options.fitted = particles == "fitted";
    if (options.fitted && !shift->empty())
      throw CLI::ValidationError(shift->get_name(), "fitted particles do not lie on a lattice that could be shifted");
    if (options.out.empty()) throw CLI::ValidationError("--out", "the output folder needs a name");
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) {
      out << app.help();
      return std::nullopt;
    }
    err << "swallowing: " << problem.what() << "\nTry swallowing --help.\n";
    exit_code = 2;
    return std::nullopt;
  }
  const auto named =
      std::find_if(qualities.begin(), qualities.end(), [&](const Quality& q) { return q.name == quality; });
  if (spacing->empty()) options.spacing = named->spacing;
  // The step of a quality is meant for its spacing only.
  if (time_step->empty()) options.time_step = spacing->empty() ? named->time_step : 0;
  options.single_precision = scalar.empty() ? named->single_precision : scalar == "float";
  options.paper_contact = contact == "paper";
  if (options.paper_contact && !options.penalty && !options.penalty_ratio) options.penalty_ratio = 0.3;
  options.constrictors = !without_h;
  options.frames = !no_frames;
  options.surfaces = !no_surfaces;
  if (options.threads == 0) options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return options;
}

}  // namespace swallowing
