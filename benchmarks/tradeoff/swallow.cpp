// SPDX-License-Identifier: MIT
// Case X1 of the swallow, run with the parts of examples/swallowing: when does the epiglottis fold, and how far?
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "run_case.hpp"
#include "tradeoff/meter.hpp"
#include "tradeoff/scenes.hpp"
#include "tradeoff/tissue.hpp"

namespace tradeoff {
namespace {

namespace fs = std::filesystem;

constexpr const char* which = "X1";

/// Runs the case and writes to `folder`. A run there with the same settings is continued where it ended, so that a
/// sweep can be interrupted; a run with other settings, or with other tracks of the motion, is replaced. Fitted
/// particles are fitted anew; they are always the same.
swallowing::Summary run_into(const fs::path& folder, swallowing::Options options) {
  options.out = folder.string();
  options.cases = {which};
  options.frames = false;
  options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const swallowing::Case& chosen = swallowing::find_case(which);
  std::optional<swallowing::FittedOrgans> organs;
  if (options.fitted) organs = swallowing::fit_organs(options.spacing, options.threads);
  forget_peak();  // the fit is not part of the cost
  const auto run = [&] { return run_case(options, chosen, organs ? &*organs : nullptr); };
  options.resume = fs::exists(folder / which / "checkpoint.bin");
  if (!options.resume) return run();
  try {
    return run();
  } catch (const hmps::InputError&) {
    options.resume = false;
    return run();
  }
}

Outcome swallow_once(const Settings& settings, const Scale& scale, double until) {
  Meter meter;
  swallowing::Options options;
  options.spacing = settings.number("spacing");
  options.single_precision = settings.word("scalar") == "float";
  options.fitted = asks_for_fitted(settings, {{"lattice shift", 0.}});
  options.lattice_shift = settings.number("lattice shift");
  options.penalty = settings.number("pressure per penetration") / options.spacing;
  options.until = until;
  std::string name = settings.word("scalar");
  for (const char* number : {"spacing", "step", "pressure per penetration", "lattice shift"})
    (name += '_') += rounded(settings.number(number), 6);
  if (options.fitted) name += "_fitted";
  const fs::path folder = scale.out / name;

  options.step_share *= settings.number("step");
  const swallowing::Summary summary = run_into(folder, options);
  if (summary.failure) throw hmps::StateError(*summary.failure);
  Outcome outcome = meter.outcome({});
  outcome.bytes = meter.peak();
  outcome.seconds = summary.wall_seconds;
  outcome.particle_steps =
      static_cast<double>(summary.steps) * static_cast<double>(summary.particles_free + summary.particles_control);
  if (!scale.quick) {
    if (!summary.fold_time)
      throw hmps::StateError("the epiglottis does not fold; its smallest angle is " + rounded(summary.tip_angle_min) +
                             " degrees");
    outcome.values.push_back(*summary.fold_time);
  }
  outcome.values.push_back(summary.tip_angle_min);
  return outcome;
}

/// Whether a run was one with fitted particles.
bool is_fitted(const swallowing::Summary& summary) {
  const std::pair<std::string, std::string> fitted{"particles", "fitted"};
  return std::find(summary.settings.begin(), summary.settings.end(), fitted) != summary.settings.end();
}

/// The finest complete result of the case on a lattice in the folders below `folder`, if one is finer than `spacing`.
std::optional<swallowing::Summary> finer_result(const fs::path& folder, double spacing) {
  std::optional<swallowing::Summary> finest;
  if (!fs::is_directory(folder)) return finest;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().filename() != "summary.json") continue;
    const auto found = swallowing::read_summary(entry.path());
    const bool whole = found && found->case_name == which && !found->failure && found->fold_time;
    if (whole && !is_fitted(*found) && found->friction == swallowing::find_case(which).friction &&
        found->spacing < 0.999 * spacing && (!finest || found->spacing < finest->spacing))
      finest = found;
  }
  return finest;
}

}  // namespace

Scene swallow(const Scale& scale) {
  const double until = scale.quick ? 2e-3 : swallowing::end_of_swallow;
  std::vector<Value> spacings{2.4e-3, 1.8e-3};
  if (scale.quick) spacings = {2.4e-3};
  Scene scene{
      .name = "swallow",
      .title = "The swallow",
      .description =
          "Case X1 of `examples/swallowing`, on all cores. The error of the time of downfolding is in per cent of a "
          "second, so 1 % is 10 ms; that of the smallest angle of the tip is in per cent of 100 degrees, so 1 % is "
          "one degree. The step is given relative to the automatic one. Time is wall-clock time of one run each and "
          "can vary by a third on a shared machine, so the advice on settings is based on particle-steps. Memory is "
          "the largest amount allocated, including while the scene is built. The fit of "
          "particles counts neither for time nor for memory.",
      .quantities = {{.name = "the time of downfolding", .unit = "s", .scale = 1},
                     {.name = "the smallest angle of the tip", .unit = "degrees", .scale = 100}},
      .parameters =
          {{.name = "spacing", .values = spacings, .standard = 2.4e-3, .unit = "mm", .per_unit = 1e-3, .refines = true},
           {.name = "scalar", .values = {"float", "double"}, .standard = "float"},
           {.name = "step", .values = {1.3, 1., 0.5}, .standard = 1.},
           {.name = "pressure per penetration",
            .values = {2e8, 4e8},
            .standard = 2e8,
            .unit = "kPa/mm",
            .per_unit = 1e6},
           {.name = "lattice shift", .values = {0., 0.5}, .standard = 0., .unit = "l0", .choice = false},
           particles_parameter()},
      .crossed = {{"spacing", "scalar"}, {"spacing", "particles"}},
      .run = [scale, until](const Settings& settings) { return swallow_once(settings, scale, until); },
      .repeats = 0};
  if (scale.quick) {
    scene.quantities.erase(scene.quantities.begin());
    for (const char* kept : {"step", "pressure per penetration", "lattice shift"})
      for (Parameter& p : scene.parameters)
        if (p.name == kept) p.values = {p.standard};
    scene.crossed.clear();
    scene.reference = scene.standard().with("scalar", "double");
    return scene;
  }
  if (const auto finer = finer_result(scale.finer, 1.8e-3)) {
    const std::vector<double> answer{*finer->fold_time, finer->tip_angle_min};
    scene.known = [answer](const Settings&) { return answer; };
    scene.description += " The results are compared with a run on a lattice at " + rounded(1e3 * finer->spacing) +
                         " mm in " + finer->scalar + ", which took " + rounded(finer->wall_seconds / 60, 2) +
                         " minutes.";
  } else {
    scene.reference = scene.standard().with("spacing", 1.8e-3).with("scalar", "double");
    scene.description +=
        " The results are compared with the finest run of the sweep, because there is no finer one "
        "below results/swallowing.";
  }
  return scene;
}

}  // namespace tradeoff
