// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tradeoff/rules.hpp"

namespace tradeoff {

/// A scene and its sweep.
struct Swept {
  Scene scene;
  Sweep sweep;
};

namespace detail {

/// A setting that several scenes tried against the same standard, and its effect in each of them.
struct Opinion {
  std::string setting;
  std::size_t scenes = 0;
  std::string better = "", worse = "", broken = "";  ///< scenes where errors fell, where they grew, where it failed
  double least_time = 1e300, most_time = 0;          ///< relative to the time of the standard

  void add(const Scene& scene, const Trial& run, const Trial& standard) {
    ++scenes;
    const auto append = [&](std::string& list, const std::string& what) { list += (list.empty() ? "" : ", ") + what; };
    if (run.failed()) return append(broken, scene.name);
    least_time = std::min(least_time, run.relative_seconds);
    most_time = std::max(most_time, run.relative_seconds);
    for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
      const int change = scene.quantities[q].headline ? compare(scene, run, standard, q) : 0;
      if (change != 0)
        append(change < 0 ? better : worse, scene.name + ": " + scene.quantities[q].name + " from " +
                                                rounded(std::abs(standard.errors[q]), 2) + " to " +
                                                rounded(std::abs(run.errors[q]), 2) + " %");
    }
  }
  [[nodiscard]] std::string time() const {
    const std::string low = rounded(least_time, 2), high = rounded(most_time, 2);
    return (low == high ? low : low + " to " + high) + " times the time";
  }
};

[[nodiscard]] inline std::vector<Opinion> opinions(const std::vector<Swept>& all) {
  std::vector<Opinion> found;
  for (const auto& [scene, sweep] : all)
    for (const Parameter& p : scene.parameters)
      for (const Value& value : p.values) {
        const Trial* run = sweep.find(scene.standard().with(p.name, value));
        if (value == p.standard || p.refines || !p.choice || run == nullptr) continue;
        const std::string setting = p.name + ' ' + p.shown(value) + " instead of " + p.shown(p.standard);
        auto place = std::find_if(found.begin(), found.end(), [&](const Opinion& o) { return o.setting == setting; });
        if (place == found.end()) place = found.insert(place, Opinion{.setting = setting});
        place->add(scene, *run, sweep.standard());
      }
  std::erase_if(found, [](const Opinion& o) { return o.scenes < 2; });
  return found;
}

}  // namespace detail

/// The section of the page on what the scenes agree on: a line for each setting that several of them tried against the
/// same standard, sorted by whether errors fall, grow, or both. Scenes in which no error changes are not named.
[[nodiscard]] inline std::string agreement(const std::vector<Swept>& all) {
  std::vector<std::string> less, more, none, split, broken;
  for (const auto& o : detail::opinions(all)) {
    if (!o.broken.empty())
      broken.push_back(o.setting + " (" + o.broken + ")");
    else if (o.better.empty() && o.worse.empty())
      none.push_back(o.setting + ", at " + o.time());
    else if (o.worse.empty())
      less.push_back(o.setting + ", at " + o.time() + " (" + o.better + ")");
    else if (o.better.empty())
      more.push_back(o.setting + ", at " + o.time() + " (" + o.worse + ")");
    else
      split.push_back(o.setting + ", at " + o.time() + " (smaller: " + o.better + "; larger: " + o.worse + ")");
  }
  std::string names;
  for (const Swept& one : all) names += (names.empty() ? "" : ", ") + one.scene.name;
  std::string text =
      "## What the scenes agree on\n\n" +
      wrapped("Settings that at least two of the scenes " + names +
              " compared with the same standard. Where a setting reduces errors in one scene and increases them in "
              "another, errors may happen to cancel.");
  const auto part = [&](const char* title, const std::vector<std::string>& lines) {
    if (!lines.empty()) text += std::string("\n### ") + title + "\n\n" + bullets(lines);
  };
  part("Smaller errors", less);
  part("No difference in errors", none);
  part("Larger errors", more);
  part("Smaller errors in some cases, larger in others", split);
  part("Failures", broken);
  return text;
}

}  // namespace tradeoff
