// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"
#include "tradeoff/front.hpp"
#include "tradeoff/scene.hpp"

namespace tradeoff {

/// One line of the table.
struct Trial {
  Settings settings;
  Outcome outcome;              ///< without values if the run failed
  std::vector<double> exact;    ///< what the values should be
  std::vector<double> errors;   ///< signed, in per cent
  double relative_seconds = 0;  ///< relative to the standard, measured beside it
  std::string failure = {};     ///< reason if there is no outcome

  [[nodiscard]] bool failed() const { return !failure.empty(); }
};

/// The runs of a scene. The first run is the standard.
struct Sweep {
  std::vector<Trial> runs;

  [[nodiscard]] const Trial& standard() const { return runs.front(); }
  /// The run with these settings, or nullptr.
  [[nodiscard]] const Trial* find(const Settings& settings) const {
    const auto found = std::find_if(runs.begin(), runs.end(), [&](const Trial& r) { return r.settings == settings; });
    return found == runs.end() ? nullptr : &*found;
  }
};

/// A kind of cost, for the fronts.
struct Cost {
  const char* name;
  double (*of)(const Trial&);
};
inline constexpr Cost costs[] = {
    {"particle-steps", [](const Trial& run) { return run.outcome.particle_steps; }},
    {"seconds, over the standard's", [](const Trial& run) { return run.relative_seconds; }},
    {"bytes", [](const Trial& run) { return static_cast<double>(run.outcome.bytes); }},
};
inline constexpr const Cost& seconds_cost = costs[1];

/// The runs on the front of the error of quantity `q` against `cost`, by rising cost. Runs of another problem are left
/// out.
[[nodiscard]] inline std::vector<const Trial*> front(const Scene& scene, const Sweep& sweep, std::size_t q,
                                                     const Cost& cost) {
  std::vector<const Trial*> good, chosen;
  std::vector<Point> points;
  for (const Trial& run : sweep.runs)
    if (!run.failed() && scene.same_problem(run.settings)) {
      good.push_back(&run);
      points.push_back({cost.of(run), std::abs(run.errors[q])});
    }
  for (const std::size_t i : pareto_front(points)) chosen.push_back(good[i]);
  return chosen;
}

/// The result points to runs of the sweep, which must outlive it.
std::vector<const Trial*> front(const Scene&, Sweep&&, std::size_t, const Cost&) = delete;

/// All combinations of the values of some parameters; the others have their standard.
[[nodiscard]] inline std::vector<Settings> combinations(const Scene& scene, const std::vector<std::string>& names) {
  std::vector<Settings> grid{scene.standard()};
  for (const std::string& name : names) {
    std::vector<Settings> wider;
    for (const Settings& settings : grid)
      for (const Value& value : scene.parameter(name).values) wider.push_back(settings.with(name, value));
    grid = std::move(wider);
  }
  return grid;
}

/// The settings that a sweep runs: the standard, every other value alone, and all combinations within each group of
/// crossed parameters. No combination occurs twice.
[[nodiscard]] inline std::vector<Settings> plan(const Scene& scene) {
  std::vector<Settings> all{scene.standard()};
  const auto add = [&](const Settings& settings) {
    if (std::find(all.begin(), all.end(), settings) == all.end()) all.push_back(settings);
  };
  for (const Parameter& p : scene.parameters) {
    examples::require(std::find(p.values.begin(), p.values.end(), p.standard) != p.values.end(),
                      "tradeoff: the standard value of ", p.name, " in the scene ", scene.name,
                      " is not among its values; add it");
    for (const Value& value : p.values) add(scene.standard().with(p.name, value));
  }
  for (const std::vector<std::string>& group : scene.crossed)
    for (const Settings& settings : combinations(scene, group)) add(settings);
  return all;
}

namespace detail {

inline void check(const Scene& scene, const Settings& settings, const std::vector<double>& values, const char* what) {
  examples::require(values.size() == scene.quantities.size(), "tradeoff: the scene ", scene.name, " gave ",
                    values.size(), ' ', what, " for ", scene.quantities.size(), " quantities; give one for each");
  for (std::size_t q = 0; q < values.size(); ++q)
    examples::require(std::isfinite(values[q]), "tradeoff: ", what, ": ", scene.quantities[q].name, " of the scene ",
                      scene.name, " is ", values[q], " at ", scene.difference(settings, scene.standard()),
                      "; throw hmps::StateError where a run breaks down");
}

[[nodiscard]] inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

}  // namespace detail

/// Runs the scene with one combination of settings. `exact` is empty if the scene knows the answer itself.
[[nodiscard]] inline Trial run_once(const Scene& scene, const Settings& settings, const std::vector<double>& exact) {
  Trial run{settings, {}, exact, {}, 1, {}};
  try {
    run.outcome = scene.run(settings);
  } catch (const hmps::Error& error) {
    run.outcome = {};
    run.failure = error.what();
    return run;
  }
  detail::check(scene, settings, run.outcome.values, "values");
  if (scene.known) run.exact = scene.known(settings);
  detail::check(scene, settings, run.exact, "right answers");
  for (std::size_t q = 0; q < run.exact.size(); ++q) {
    const double scale = scene.quantities[q].scale > 0 ? scene.quantities[q].scale : std::abs(run.exact[q]);
    examples::require(scale > 0, "tradeoff: ", scene.quantities[q].name, " of the scene ", scene.name,
                      " should be 0, of which there are no per cent; give the quantity a scale");
    run.errors.push_back(100 * (run.outcome.values[q] - run.exact[q]) / scale);
  }
  return run;
}

/// Sweeps a scene. Each run is timed by the processor's clock beside a run of the standard, up to
/// `repeats` times within about two seconds, and the median of the ratios is kept, so that other load of the machine
/// has little effect. `log` is called with a line per run. Throws `InputError` if the standard fails or a repeated run
/// gives other values.
[[nodiscard]] inline Sweep sweep(const Scene& scene, const std::function<void(const std::string&)>& log) {
  Sweep result;
  examples::require(scene.known != nullptr || scene.reference.has_value(), "tradeoff: the scene ", scene.name,
                    " has neither known answers nor a reference; give one");
  std::vector<double> reference;
  if (!scene.known) {
    reference = scene.run(*scene.reference).values;
    detail::check(scene, *scene.reference, reference, "values of the reference");
  }
  const std::vector<Settings> all = plan(scene);
  for (const Settings& settings : all) {
    Trial run = run_once(scene, settings, reference);
    const bool first = result.runs.empty();
    examples::require(!first || !run.failed(), "tradeoff: the standard of the scene ", scene.name,
                      " failed: ", run.failure);
    if (!first && !run.failed()) {
      std::vector<double> ratios;
      const double standard_seconds = result.runs.front().outcome.seconds;
      if (scene.repeats < 1) ratios = {run.outcome.seconds / standard_seconds};
      double spent = 0;
      for (int k = 0; k < scene.repeats && (k == 0 || spent < 2); ++k) {
        const double standard = scene.run(scene.standard()).seconds;
        // The first repetition uses the run that exists already, unless it was too short for timing.
        const Outcome again = k == 0 && run.outcome.seconds > 0.5 ? run.outcome : scene.run(settings);
        examples::require(again.values == run.outcome.values, "tradeoff: the scene ", scene.name,
                          " gave other values at ", scene.difference(settings, scene.standard()),
                          " when it was run again; a run must depend on its settings only");
        ratios.push_back(again.seconds / standard);
        spent += standard + again.seconds;
      }
      run.relative_seconds = detail::median(ratios);
    }
    std::string line = std::to_string(result.runs.size() + 1) + "/" + std::to_string(all.size()) + " " + scene.name +
                       ": " + scene.difference(settings, scene.standard()) + ": ";
    if (run.failed()) line += run.failure;
    for (std::size_t q = 0; q < run.errors.size(); ++q)
      line += scene.quantities[q].name + " " + rounded(run.errors[q]) + " %, ";
    if (!run.failed()) line += rounded(run.relative_seconds, 2) + " of the standard's seconds";
    log(line);
    result.runs.push_back(std::move(run));
  }
  return result;
}

}  // namespace tradeoff
