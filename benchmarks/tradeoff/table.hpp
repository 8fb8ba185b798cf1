// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "common/error.hpp"
#include "report/table.hpp"
#include "tradeoff/sweep.hpp"

/// A sweep as a table of comma-separated values, from which it can be restored without running anything.
namespace tradeoff {

/// All runs, one per line: settings in SI units, values, right answers, errors in per cent, costs, reason of a failure.
[[nodiscard]] inline std::string csv(const Scene& scene, const Sweep& sweep) {
  using report::in_full, report::in_quotes;
  report::Cells head;
  for (const Parameter& p : scene.parameters) head.push_back(p.name);
  for (const Quantity& q : scene.quantities)
    for (const std::string& what :
         {q.unit.empty() ? "" : " (" + q.unit + ")", std::string(", right answer"), std::string(", error (%)")})
      head.push_back(in_quotes(q.name + what));
  for (const char* cost : {"particle_steps", "seconds", "seconds_over_standard", "bytes", "failure"})
    head.emplace_back(cost);
  std::string text = report::csv_line(head);
  for (const Trial& run : sweep.runs) {
    report::Cells row;
    for (const Parameter& p : scene.parameters) {
      const Value& value = run.settings.at(p.name);
      const auto* word = std::get_if<std::string>(&value);
      row.push_back(word != nullptr ? *word : in_full(std::get<double>(value)));
    }
    if (run.failed()) {
      row.resize(row.size() + 3 * scene.quantities.size() + 4);
      row.push_back(in_quotes(run.failure));
    } else {
      for (std::size_t q = 0; q < scene.quantities.size(); ++q)
        for (const double value : {run.outcome.values[q], run.exact[q], run.errors[q]}) row.push_back(in_full(value));
      for (const double cost : {run.outcome.particle_steps, run.outcome.seconds, run.relative_seconds})
        row.push_back(in_full(cost));
      row.push_back(std::to_string(run.outcome.bytes));
      row.emplace_back();
    }
    text += report::csv_line(row);
  }
  return text;
}

/// Reads what `csv` wrote. Throws `InputError` if the table is not one of this scene.
[[nodiscard]] inline Sweep read_csv(const Scene& scene, std::string_view text) {
  const auto lines = report::read_csv(text);
  const std::size_t width = scene.parameters.size() + 3 * scene.quantities.size() + 5;
  Sweep sweep;
  for (std::size_t n = 1; n < lines.size(); ++n) {
    const auto& line = lines[n];
    examples::require(line.size() == width, "tradeoff: line ", n + 1, " of the table of ", scene.name, " has ",
                      line.size(), " fields instead of ", width, "; sweep the scene again");
    Trial run;
    std::size_t at = 0;
    for (const Parameter& p : scene.parameters) {
      const std::string& cell = line[at++];
      const bool word = std::holds_alternative<std::string>(p.standard);
      run.settings.add(p.name, word ? Value(cell) : Value(report::number(cell)));
    }
    run.failure = line.back();
    if (!run.failed()) {
      for (std::size_t q = 0; q < scene.quantities.size(); ++q) {
        run.outcome.values.push_back(report::number(line[at++]));
        run.exact.push_back(report::number(line[at++]));
        run.errors.push_back(report::number(line[at++]));
      }
      run.outcome.particle_steps = report::number(line[at++]);
      run.outcome.seconds = report::number(line[at++]);
      run.relative_seconds = report::number(line[at++]);
      run.outcome.bytes = static_cast<std::size_t>(report::number(line[at]));
    }
    sweep.runs.push_back(std::move(run));
  }
  examples::require(!sweep.runs.empty() && sweep.standard().settings == scene.standard() && !sweep.standard().failed(),
                    "tradeoff: the table of ", scene.name, " does not begin with its standard; sweep the scene again");
  return sweep;
}

}  // namespace tradeoff
