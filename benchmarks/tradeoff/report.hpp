// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "rules.hpp"
#include "sweep.hpp"

/// A sweep as a section of a page in Markdown.
namespace tradeoff {

/// `text` in lines of at most 120 characters, all but the first behind `indent`.
[[nodiscard]] inline std::string wrapped(const std::string& text, const std::string& indent = "") {
  std::istringstream words(text);
  std::string all, line;
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > 120) {
      all += line + '\n';
      line = indent + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
  }
  return all + line + '\n';
}

namespace detail {

[[nodiscard]] inline std::string row(const Scene& scene, const std::string& first, const Trial& run) {
  std::string text = "| " + first + " | ";
  if (run.failed()) {
    text += "failed: " + run.failure + " | | |";
    for (const Quantity& q : scene.quantities) text += q.headline ? " |" : "";
    return text + '\n';
  }
  text += counted(run.outcome.particle_steps) + " | " + rounded(run.relative_seconds, 2) + " | " +
          bytes(static_cast<double>(run.outcome.bytes)) + " |";
  for (std::size_t q = 0; q < scene.quantities.size(); ++q)
    if (scene.quantities[q].headline) text += (run.errors[q] > 0 ? " +" : " ") + rounded(run.errors[q]) + " % |";
  return text + '\n';
}
[[nodiscard]] inline std::string head(const Scene& scene, const std::string& first) {
  std::string names = "| " + first + " | particle-steps | time | memory |", line = "|---|---|---|---|";
  for (const Quantity& q : scene.quantities)
    if (q.headline) names += " error of " + q.name + " |", line += "---|";
  return names + '\n' + line + '\n';
}
[[nodiscard]] inline std::string list(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& s : sentences) text += wrapped("- " + s, "  ");
  return text.empty() ? "- nothing\n" : text;
}

}  // namespace detail

/// The section of a page on this sweep, in Markdown, with a link to the `picture`.
[[nodiscard]] inline std::string section(const Scene& scene, const Sweep& sweep, const std::string& picture) {
  const Trial& standard = sweep.standard();
  std::string text = "## " + scene.title + "\n\n" + wrapped(scene.description), settings = "Standard: ";
  for (std::size_t k = 0; k < scene.parameters.size(); ++k)
    settings +=
        (k > 0 ? ", " : "") + scene.parameters[k].name + ' ' + scene.parameters[k].shown(scene.parameters[k].standard);
  settings += ". It takes " + counted(standard.outcome.particle_steps) + " particle-steps, " +
              rounded(standard.outcome.seconds, 2) + " s of one processor here and " +
              bytes(static_cast<double>(standard.outcome.bytes)) + ". " + std::to_string(sweep.runs.size()) + " runs.";
  text += '\n' + wrapped(settings);
  if (!scene.known) text += '\n' + wrapped("Reference: " + scene.difference(*scene.reference, standard.settings) + ".");
  text += "\n![Error against cost of all runs, and the fronts](" + picture + ")\n\n### What to choose\n\n" +
          detail::list(target_rules(scene, sweep));
  if (const auto rules = halving_rules(scene, sweep); !rules.empty())
    text += "\n### What refinement costs\n\n" + detail::list(rules);
  text += "\n### What each setting does\n\n" + detail::list(single_rules(scene, sweep)) +
          "\n### One parameter at a time\n\n" + detail::head(scene, "differs from the standard by") +
          detail::row(scene, "nothing", standard);
  for (const Parameter& p : scene.parameters)
    for (const Value& value : p.values)
      if (value != p.standard)
        if (const Trial* run = sweep.find(scene.standard().with(p.name, value)))
          text += detail::row(scene, p.name + ' ' + p.shown(value), *run);
  for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
    if (!scene.quantities[q].headline) continue;
    text += "\n### The front: error of " + scene.quantities[q].name + " against time\n\n" +
            detail::head(scene, "number in the picture: settings that differ from the standard");
    std::size_t number = 0;
    for (const Trial* run : front(scene, sweep, q, seconds_cost))
      text += detail::row(scene, std::to_string(++number) + ": " + scene.difference(run->settings, standard.settings),
                          *run);
  }
  return text;
}

/// `page` with `section` in place of what stands between the marks of that name, or at its end.
[[nodiscard]] inline std::string with_section(std::string page, const std::string& name, const std::string& section) {
  const std::string begin = "<!-- begin " + name + " -->\n", end = "<!-- end " + name + " -->\n";
  const std::string marked = begin + section + end;
  const auto from = page.find(begin), to = page.find(end);
  if (from == std::string::npos) return page + '\n' + marked;
  hmps::require(to != std::string::npos && to > from, "tradeoff: the page has the mark ",
                begin.substr(0, begin.size() - 1), " but not its end; remove the mark or restore the end");
  return page.replace(from, to + end.size() - from, marked);
}

}  // namespace tradeoff
