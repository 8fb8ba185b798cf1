// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "tradeoff/sweep.hpp"

/// Advice that follows from a sweep, in sentences. All of them are computed.
namespace tradeoff {

/// How a run compares with another.
enum class Verdict {
  take,   ///< no error is larger, and it is cheaper
  buy,    ///< an error is smaller and none larger, at a higher cost
  save,   ///< an error is larger and none smaller, at a lower cost
  leave,  ///< an error is larger and none smaller, and it is not cheaper
  mixed,  ///< one error is larger, another smaller
  same    ///< neither errors nor cost differ by more than a tenth
};

/// Whether the error of quantity `q` is smaller (-1) or larger (1) than that of `beside`, or equal (0). Errors that
/// differ by less than a tenth, or by less than `Quantity::matters`, count as equal.
[[nodiscard]] inline int compare(const Scene& scene, const Trial& run, const Trial& beside, std::size_t q) {
  const double now = std::abs(run.errors[q]), then = std::abs(beside.errors[q]), least = scene.quantities[q].matters;
  if (now < 0.9 * then && then - now > least) return -1;
  return now > 1.1 * then && now - then > least ? 1 : 0;
}

/// The ratio of the costs of two runs: of their times, or of their particle-steps if runs are not timed repeatedly.
[[nodiscard]] inline double relative_cost(const Scene& scene, const Trial& run, const Trial& beside) {
  return scene.repeats > 0 ? run.relative_seconds / beside.relative_seconds
                           : run.outcome.particle_steps / beside.outcome.particle_steps;
}

/// Compares all headline errors and the cost; costs that differ by less than a tenth count as equal.
[[nodiscard]] inline Verdict judge(const Scene& scene, const Trial& run, const Trial& beside) {
  bool better = false, worse = false;
  for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
    if (!scene.quantities[q].headline) continue;
    better = better || compare(scene, run, beside, q) < 0;
    worse = worse || compare(scene, run, beside, q) > 0;
  }
  const double cost = relative_cost(scene, run, beside);
  if (better && worse) return Verdict::mixed;
  if (worse) return cost < 0.9 ? Verdict::save : Verdict::leave;
  if (cost < 0.9) return Verdict::take;
  if (better) return cost > 1.1 ? Verdict::buy : Verdict::take;
  return cost > 1.1 ? Verdict::leave : Verdict::same;
}

[[nodiscard]] inline std::string name(Verdict verdict) {
  switch (verdict) {
    case Verdict::take:
      return "take";
    case Verdict::buy:
      return "pay";
    case Verdict::save:
      return "save";
    case Verdict::leave:
      return "leave";
    case Verdict::mixed:
      return "weigh";
    case Verdict::same:
      return "no matter";
  }
  return "";
}

/// "15 times the particle-steps, 14 times the time and 7.6 times the memory"
[[nodiscard]] inline std::string compared_cost(const Trial& run, const Trial& beside) {
  const auto times = [](double ratio, const char* what) {
    return std::abs(ratio - 1) < 0.05 ? std::string("the same ") + what : rounded(ratio, 2) + " times the " + what;
  };
  const double steps = run.outcome.particle_steps / beside.outcome.particle_steps;
  const std::string steps_text = std::abs(steps - 1) < 0.005 ? "the same number of particle-steps"
                                                             : rounded(steps, 3) + " times the particle-steps";
  return steps_text + ", " + times(run.relative_seconds / beside.relative_seconds, "time") + " and " +
         times(static_cast<double>(run.outcome.bytes) / static_cast<double>(beside.outcome.bytes), "memory");
}

/// "the error of the frequency goes from 4.1 to 1.6 %, that of the energy stays at 0.12 %"
[[nodiscard]] inline std::string compared_errors(const Scene& scene, const Trial& run, const Trial& beside) {
  std::string text;
  for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
    if (!scene.quantities[q].headline) continue;
    const std::string now = rounded(std::abs(run.errors[q]), 2), then = rounded(std::abs(beside.errors[q]), 2);
    text += (text.empty() ? "the error of " : ", that of ") + scene.quantities[q].name +
            (now == then ? " stays at " + now : " goes from " + then + " to " + now) + " %";
  }
  return text;
}

/// Whether the error of quantity `q` is at most `limit` per cent in `run` and in all runs that differ from it only by a
/// finer value of a parameter that refines. This excludes errors that happen to cross zero.
[[nodiscard]] inline bool holds(const Scene& scene, const Sweep& sweep, const Trial& run, std::size_t q, double limit) {
  if (run.failed() || std::abs(run.errors[q]) > limit) return false;
  for (const Parameter& p : scene.parameters) {
    if (!p.refines) continue;
    for (const Value& value : p.values) {
      if (std::get<double>(value) >= run.settings.number(p.name)) continue;
      const Trial* finer = sweep.find(run.settings.with(p.name, value));
      if (finer != nullptr && (finer->failed() || std::abs(finer->errors[q]) > limit)) return false;
    }
  }
  return true;
}
/// Whether there is no finer run with which `holds` could compare.
[[nodiscard]] inline bool finest(const Scene& scene, const Sweep& sweep, const Trial& run) {
  for (const Parameter& p : scene.parameters)
    for (const Value& value : p.values)
      if (p.refines && std::get<double>(value) < run.settings.number(p.name) &&
          sweep.find(run.settings.with(p.name, value)) != nullptr)
        return false;
  return true;
}

/// For each limit of the error, the quickest run that keeps it, preferably one that a finer run confirms. Runs whose
/// times differ by less than a tenth count as equally quick; of these, the first in the sweep is taken.
[[nodiscard]] inline std::vector<std::string> target_rules(const Scene& scene, const Sweep& sweep) {
  std::vector<std::string> rules;
  for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
    if (!scene.quantities[q].headline) continue;
    const Trial* last = nullptr;
    std::vector<std::string> lines;
    for (const double limit : {20., 10., 5., 2., 1., 0.5, 0.2, 0.1, 0.05, 0.02, 0.01}) {
      const Trial* best = nullptr;
      for (const bool confirmed : {true, false})
        for (const Trial& run : sweep.runs)
          if (scene.same_problem(run.settings) && holds(scene, sweep, run, q, limit) &&
              finest(scene, sweep, run) != confirmed &&
              (best == nullptr || (finest(scene, sweep, *best) != confirmed && relative_cost(scene, run, *best) < 0.9)))
            best = &run;
      if (best == nullptr) break;
      if (best == last) lines.pop_back();  // the line of the stricter limit replaces it
      last = best;
      lines.push_back("**" + scene.quantities[q].name + " within " + rounded(limit) +
                      " %**: " + scene.difference(best->settings, sweep.standard().settings) + "; " +
                      counted(best->outcome.particle_steps) + " particle-steps, " + rounded(best->relative_seconds, 2) +
                      " times the standard's time, " + bytes(static_cast<double>(best->outcome.bytes)) +
                      (finest(scene, sweep, *best) ? " (nothing finer was run to confirm it)" : "") + ".");
    }
    rules.insert(rules.end(), lines.begin(), lines.end());
  }
  return rules;
}

/// The cost and the gain of halving the spacing, wherever the sweep has two values with this ratio.
[[nodiscard]] inline std::vector<std::string> halving_rules(const Scene& scene, const Sweep& sweep) {
  std::vector<std::string> rules;
  for (const Parameter& p : scene.parameters) {
    if (!p.refines) continue;
    for (const Value& coarse : p.values)
      for (const Value& fine : p.values) {
        const double ratio = std::get<double>(coarse) / std::get<double>(fine);
        if (std::abs(ratio - 2) > 0.02) continue;
        const Trial* from = sweep.find(scene.standard().with(p.name, coarse));
        const Trial* to = sweep.find(scene.standard().with(p.name, fine));
        if (from == nullptr || to == nullptr || from->failed() || to->failed()) continue;
        rules.push_back("Halving the " + p.name + " from " + p.shown(coarse) + " to " + p.shown(fine) + " costs " +
                        compared_cost(*to, *from) + ": " + compared_errors(scene, *to, *from) + ".");
      }
  }
  return rules;
}

/// The effect of each value that alone differs from the standard.
[[nodiscard]] inline std::vector<std::string> single_rules(const Scene& scene, const Sweep& sweep) {
  std::vector<std::string> rules;
  for (const Parameter& p : scene.parameters)
    for (const Value& value : p.values) {
      if (value == p.standard || p.refines) continue;
      const Trial* run = sweep.find(scene.standard().with(p.name, value));
      if (run == nullptr) continue;
      const std::string what = p.name + " " + p.shown(value) + " (instead of " + p.shown(p.standard) + ")";
      if (run->failed())
        rules.push_back("**avoid** " + what + ": " + run->failure + ".");
      else
        rules.push_back((p.choice ? "**" + name(judge(scene, *run, sweep.standard())) + "** " : "at ") + what + ": " +
                        compared_cost(*run, sweep.standard()) + "; " + compared_errors(scene, *run, sweep.standard()) +
                        ".");
    }
  return rules;
}

}  // namespace tradeoff
