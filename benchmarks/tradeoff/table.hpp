// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "../../examples/common/csv_writer.hpp"
#include "sweep.hpp"

/// A sweep as a table of comma-separated values, from which it can be had again without running anything.
namespace tradeoff {

/// All runs, one a line: settings in SI units, values, right answers, errors in per cent, costs, why it failed.
[[nodiscard]] inline std::string csv(const Scene& scene, const Sweep& sweep) {
  const auto quoted = [](std::string_view text) {
    std::string out = "\"";
    for (const char c : text) (out += c) += c == '"' ? "\"" : "";
    return out + '"';
  };
  std::string text;
  for (const Parameter& p : scene.parameters) text += p.name + ',';
  for (const Quantity& q : scene.quantities)
    text += quoted(q.name + (q.unit.empty() ? "" : " (" + q.unit + ")")) + ',' + quoted(q.name + ", right answer") +
            ',' + quoted(q.name + ", error (%)") + ',';
  text += "particle_steps,seconds,seconds_over_standard,bytes,failure\n";
  for (const Trial& run : sweep.runs) {
    for (const Parameter& p : scene.parameters) {
      const Value& value = run.settings.at(p.name);
      const auto* word = std::get_if<std::string>(&value);
      text += (word != nullptr ? *word : examples::to_text(std::get<double>(value))) + ',';
    }
    for (std::size_t q = 0; q < scene.quantities.size(); ++q)
      text += run.failed() ? ",,,"
                           : examples::to_text(run.outcome.values[q]) + ',' + examples::to_text(run.exact[q]) + ',' +
                                 examples::to_text(run.errors[q]) + ',';
    text += run.failed()
                ? ",,,," + quoted(run.failure)
                : examples::to_text(run.outcome.particle_steps) + ',' + examples::to_text(run.outcome.seconds) + ',' +
                      examples::to_text(run.relative_seconds) + ',' + std::to_string(run.outcome.bytes) + ',';
    text += '\n';
  }
  return text;
}

namespace detail {

/// The cells of a table: lines of fields separated by commas, quoted where they hold commas or quotes.
[[nodiscard]] inline std::vector<std::vector<std::string>> cells(std::string_view text) {
  std::vector<std::vector<std::string>> lines;
  std::vector<std::string> line(1);
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      line.back() += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      line.emplace_back();
    else if (c == '\n' && !quoted)
      lines.push_back(std::exchange(line, std::vector<std::string>(1)));
    else
      line.back() += c;
  }
  return lines;
}

[[nodiscard]] inline double number(const std::string& cell) {
  double value = 0;
  const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  hmps::require(problem == std::errc() && end == cell.data() + cell.size(), "tradeoff: a table has '", cell,
                "' where a number should stand; sweep the scene again");
  return value;
}

}  // namespace detail

/// What `csv` wrote. Throws `InputError` if the table is not one of this scene.
[[nodiscard]] inline Sweep read_csv(const Scene& scene, std::string_view text) {
  const auto lines = detail::cells(text);
  const std::size_t width = scene.parameters.size() + 3 * scene.quantities.size() + 5;
  Sweep sweep;
  for (std::size_t n = 1; n < lines.size(); ++n) {
    const auto& line = lines[n];
    hmps::require(line.size() == width, "tradeoff: line ", n + 1, " of the table of ", scene.name, " has ", line.size(),
                  " fields instead of ", width, "; sweep the scene again");
    Trial run;
    std::size_t at = 0;
    for (const Parameter& p : scene.parameters) {
      const std::string& cell = line[at++];
      const bool word = std::holds_alternative<std::string>(p.standard);
      run.settings.add(p.name, word ? Value(cell) : Value(detail::number(cell)));
    }
    run.failure = line.back();
    if (!run.failed()) {
      for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
        run.outcome.values.push_back(detail::number(line[at++]));
        run.exact.push_back(detail::number(line[at++]));
        run.errors.push_back(detail::number(line[at++]));
      }
      run.outcome.particle_steps = detail::number(line[at++]);
      run.outcome.seconds = detail::number(line[at++]);
      run.relative_seconds = detail::number(line[at++]);
      run.outcome.bytes = static_cast<std::size_t>(detail::number(line[at]));
    }
    sweep.runs.push_back(std::move(run));
  }
  hmps::require(!sweep.runs.empty() && sweep.standard().settings == scene.standard() && !sweep.standard().failed(),
                "tradeoff: the table of ", scene.name, " does not begin with its standard; sweep the scene again");
  return sweep;
}

}  // namespace tradeoff
