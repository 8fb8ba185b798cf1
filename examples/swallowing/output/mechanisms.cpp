// SPDX-License-Identifier: MIT
#include "output/mechanisms.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <hmps/output/file_replacement.hpp>
#include <limits>
#include <string>
#include <vector>

#include "options.hpp"

namespace swallowing {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double descent = 1.4;         // s, when the leaf has begun to turn
constexpr double end_of_descent = 1.8;  // s, if it never folds

[[nodiscard]] std::string number(const char* pattern, double value, double time = nothing) {
  if (!std::isfinite(value)) return "–";
  char text[80];
  std::snprintf(text, sizeof text, pattern, value);
  std::string words = text;
  if (std::isfinite(time)) {
    std::snprintf(text, sizeof text, " at %.3f s", time);
    words += text;
  }
  return words;
}

/// The contacts of a case between two times, by the names of their columns.
struct Extract {
  const ContactTable& table;
  double from, to;

  template <class Visit>
  void each(const std::string& name, Visit&& visit) const {
    const auto column = table.column(name);
    for (const auto& row : table.rows)
      if (column && row[0] > from - 1e-9 && row[0] < to + 1e-9) visit(row[0], row[*column]);
  }
  [[nodiscard]] std::string mean(const std::string& name, const char* pattern) const {
    double sum = 0, count = 0;
    each(name, [&](double, double value) { sum += value, count += 1; });
    return number(pattern, count > 0 ? sum / count : nothing);
  }
  /// The least value as a share of the first one.
  [[nodiscard]] std::string left(const std::string& name) const {
    double first = nothing, least = nothing, when = nothing;
    each(name, [&](double time, double value) {
      if (std::isnan(first)) first = value;
      if (!(value >= least)) least = value, when = time;
    });
    return number("%.0f %%", 100 * least / first, when);
  }
  /// The largest value, times `sign`.
  [[nodiscard]] std::string most(const std::string& name, const char* pattern, double sign = 1) const {
    double found = nothing, when = nothing;
    each(name, [&](double time, double value) {
      if (std::isfinite(value) && !(sign * value <= sign * found)) found = value, when = time;
    });
    return number(pattern, found, when);
  }
};

struct Line {
  const char* words;
  std::function<std::string(const CaseResult&, const Case&)> value;
};

/// From when the leaf has begun to turn until it folds.
[[nodiscard]] Extract falling(const CaseResult& result) {
  return {result.contacts, descent, result.summary->fold_time.value_or(end_of_descent)};
}
/// The interval over which the paper compares areas of contact.
[[nodiscard]] Extract compared(const CaseResult& result) { return {result.contacts, 1.63, 1.69}; }
[[nodiscard]] Extract at(const CaseResult& result, double time) { return {result.contacts, time, time}; }
[[nodiscard]] Extract whole(const CaseResult& result) { return {result.contacts, 0, end_of_swallow}; }

[[nodiscard]] std::vector<Line> lines() {
  using R = const CaseResult&;
  using C = const Case&;
  const std::string wall = "epiglottis-pharynx_", tongue = "epiglottis-tongue_";
  return {
      {"folds below the horizontal", [](R r, C) { return number("%.3f s", r.summary->fold_time.value_or(nothing)); }},
      {"α, tongue: largest moment that turns the tip down, mN m",
       [](R r, C) { return falling(r).most("moment_tongue", "%.2f"); }},
      {"α, tongue: largest normal force on the leaf, N",
       [=](R r, C) { return falling(r).most(tongue + "normal", "%.2f"); }},
      {"β, pharyngeal wall: largest moment that turns the tip down, mN m",
       [](R r, C) { return falling(r).most("moment_pharynx", "%.2f"); }},
      {"β, pharyngeal wall: largest moment that holds the tip up, mN m",
       [](R r, C) { return falling(r).most("moment_pharynx", "%.2f", -1); }},
      {"γ and δ: middle of the leaf turned by region F",
       [](R, C c) { return std::string(c.model == Model::X ? "prescribed" : "no"); }},
      {"leaf on wall, 1.63 to 1.69 s: area, mm2", [=](R r, C) { return compared(r).mean(wall + "area", "%.1f"); }},
      {"leaf on wall, 1.63 to 1.69 s: normal force, N",
       [=](R r, C) { return compared(r).mean(wall + "normal", "%.3f"); }},
      {"leaf on wall, 1.63 to 1.69 s: friction, N",
       [=](R r, C) { return compared(r).mean(wall + "tangential", "%.3f"); }},
      {"height of the middle of the leaf at 1.700 s, mm",
       [](R r, C) { return at(r, 1.7).mean("centre_height", "%.1f"); }},
      {"height of its tip at 1.700 s, mm", [](R r, C) { return at(r, 1.7).mean("tip_height", "%.1f"); }},
      {"least gap between the upper leaf and the larynx, mm",
       [](R r, C) { return whole(r).most("leaf_to_larynx", "%.1f", -1); }},
      {"least gap of the glottis, mm", [](R r, C) { return whole(r).most("glottis", "%.1f", -1); }},
      {"least gap between tongue and posterior wall, mm",
       [](R r, C) { return whole(r).most("tongue_to_wall", "%.1f", -1); }},
      {"least width of the pharynx at 65 mm, mm", [](R r, C) { return whole(r).most("width_upper", "%.1f", -1); }},
      {"at 40 mm", [](R r, C) { return whole(r).most("width_middle", "%.1f", -1); }},
      {"at 22 mm", [](R r, C) { return whole(r).most("width_lower", "%.1f", -1); }},
      {"least open area of the pharynx at 65 mm, of that at rest", [](R r, C) { return whole(r).left("open_upper"); }},
      {"at 40 mm", [](R r, C) { return whole(r).left("open_middle"); }},
      {"at 22 mm", [](R r, C) { return whole(r).left("open_lower"); }},
  };
}

}  // namespace

void write_mechanisms(const std::filesystem::path& path, const std::array<CaseResult, 4>& results) {
  std::string text = "# What turns the epiglottis\n\n| |";
  for (const Case& c : cases) text += ' ' + std::string(c.name) + " |";
  text += "\n|---|---|---|---|---|\n";
  for (const Line& line : lines()) {
    text += "| " + std::string(line.words) + " |";
    for (std::size_t i = 0; i < results.size(); ++i)
      text += ' ' + (results[i].summary ? line.value(results[i], cases[i]) : "–") + " |";
    text += '\n';
  }
  text +=
      "\nAll by contacts.csv, every millisecond. Moments are those of the forces on the half of the leaf beyond its\n"
      "middle, about its middle; the largest are sought from 1.4 s until the leaf folds, or until 1.8 s. Areas count\n"
      "the particles that touch, at their size at rest. Gaps are between balls of the particles' size.\n";
  hmps::replace_file(path, text);
}

}  // namespace swallowing
