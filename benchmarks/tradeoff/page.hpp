// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "report/table.hpp"
#include "tradeoff/rules.hpp"

/// A sweep as a section of a page in Markdown.
namespace tradeoff {

namespace detail {

/// A table of runs, whose first column distinguishes them.
[[nodiscard]] inline report::Table runs_table(const Scene& scene, const std::string& first) {
  report::Table table{.header = {first, "particle-steps", "time", "memory"}};
  for (const Quantity& q : scene.quantities)
    if (q.headline) table.header.push_back("error of " + q.name);
  return table;
}
inline void add_run(report::Table& table, const Scene& scene, const std::string& first, const Trial& run) {
  report::Cells row{first};
  if (run.failed()) {
    row.push_back(report::spanning("failed: " + run.failure, table.header.size() - 2));
  } else {
    row.push_back(counted(run.outcome.particle_steps));
    row.push_back(rounded(run.relative_seconds, 2));
    row.push_back(bytes(static_cast<double>(run.outcome.bytes)));
    for (std::size_t q = 0; q < scene.quantities.size(); ++q)
      if (scene.quantities[q].headline) row.push_back((run.errors[q] > 0 ? "+" : "") + rounded(run.errors[q]) + " %");
  }
  table.rows.push_back(std::move(row));
}
[[nodiscard]] inline std::string settings_text(const Scene& scene, const Sweep& sweep) {
  const Trial& standard = sweep.standard();
  std::string text = "Standard: ";
  for (std::size_t k = 0; k < scene.parameters.size(); ++k)
    text +=
        (k > 0 ? ", " : "") + scene.parameters[k].name + ' ' + scene.parameters[k].shown(scene.parameters[k].standard);
  return text + ". A run takes " + counted(standard.outcome.particle_steps) + " particle-steps, " +
         rounded(standard.outcome.seconds, 2) + " s on this machine and " +
         bytes(static_cast<double>(standard.outcome.bytes)) + ". The sweep has " + std::to_string(sweep.runs.size()) +
         " runs.";
}

/// A table of all combinations for each pair of parameters that are crossed with each other alone.
[[nodiscard]] inline std::string pair_tables(const Scene& scene, const Sweep& sweep) {
  std::string text;
  for (const std::vector<std::string>& group : scene.crossed) {
    if (group.size() != 2) continue;
    report::Table pairs = runs_table(scene, group[0] + ", " + group[1]);
    for (const Settings& settings : combinations(scene, group)) {
      const auto shown = [&](const std::string& name) { return scene.parameter(name).shown(settings.at(name)); };
      if (const Trial* run = sweep.find(settings))
        add_run(pairs, scene, shown(group[0]) + ", " + shown(group[1]), *run);
    }
    text += "\n### Combinations of " + group[0] + " and " + group[1] + "\n\n" + pairs.markdown();
  }
  return text;
}

}  // namespace detail

/// The section of the page about this sweep, in Markdown, with a link to the `picture`.
[[nodiscard]] inline std::string section(const Scene& scene, const Sweep& sweep, const std::string& picture) {
  const Trial& standard = sweep.standard();
  std::string text =
      "## " + scene.title + "\n\n" + wrapped(scene.description) + '\n' + wrapped(detail::settings_text(scene, sweep));
  if (!scene.known) text += '\n' + wrapped("Reference: " + scene.difference(*scene.reference, standard.settings) + ".");
  text += "\n![Error against cost of all runs, and the fronts](" + picture + ")\n\n### What to choose\n\n" +
          bullets(target_rules(scene, sweep));
  if (const auto rules = halving_rules(scene, sweep); !rules.empty())
    text += "\n### What refinement costs\n\n" + bullets(rules);
  report::Table single = detail::runs_table(scene, "difference from the standard");
  detail::add_run(single, scene, "nothing", standard);
  for (const Parameter& p : scene.parameters)
    for (const Value& value : p.values)
      if (value != p.standard)
        if (const Trial* run = sweep.find(scene.standard().with(p.name, value)))
          detail::add_run(single, scene, p.name + ' ' + p.shown(value), *run);
  text += "\n### What each setting does\n\n" + bullets(single_rules(scene, sweep)) +
          "\n### One parameter at a time\n\n" + single.markdown() + detail::pair_tables(scene, sweep);
  for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
    if (!scene.quantities[q].headline) continue;
    report::Table best = detail::runs_table(scene, "number in the picture: settings that differ from the standard");
    for (const Trial* run : front(scene, sweep, q, seconds_cost))
      detail::add_run(best, scene,
                      std::to_string(best.rows.size() + 1) + ": " + scene.difference(run->settings, standard.settings),
                      *run);
    text += "\n### The front: error of " + scene.quantities[q].name + " against time\n\n" + best.markdown();
  }
  return text;
}

}  // namespace tradeoff
