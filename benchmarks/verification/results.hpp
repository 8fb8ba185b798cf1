// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"
#include "report/table.hpp"
#include "report/text.hpp"
#include "verification/problem.hpp"

/// The results of the problems: runs, the file with the table of all runs, orders of convergence.
namespace verification {

/// A problem and its runs, in the order of methods and sizes.
struct Solved {
  Problem problem;
  std::vector<Trial> trials;
};

/// One run. If it breaks down, the trial contains the reason.
[[nodiscard]] inline Trial solve(const Problem& problem, int size, const Method& method) {
  Trial trial{method.name, size, {}, 0};
  const std::clock_t start = std::clock();
  try {
    trial.measured = problem.run(size, method);
  } catch (const hmps::Error& error) {
    trial.failure = error.what();
    trial.measured.values.assign(problem.quantities.size(), std::nan(""));
  }
  trial.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  examples::require(trial.measured.values.size() == problem.quantities.size(), "verification: ", problem.name, " gave ",
                    trial.measured.values.size(), " values for ", problem.quantities.size(), " quantities");
  return trial;
}

/// The table of all runs.
[[nodiscard]] inline std::string csv(const std::vector<Solved>& all) {
  using report::in_full, report::in_quotes;
  std::string text =
      "problem,method,size,spacing (m),particles,quantity,unit,value,answer,source,uncertainty,error "
      "(%),seconds,failure\n";
  for (const Solved& solved : all)
    for (const Trial& trial : solved.trials)
      for (std::size_t q = 0; q < solved.problem.quantities.size(); ++q) {
        const Quantity& quantity = solved.problem.quantities[q];
        const double value = trial.measured.values[q];
        text +=
            report::csv_line({in_quotes(solved.problem.name), in_quotes(trial.method), std::to_string(trial.size),
                              in_full(trial.measured.spacing), std::to_string(trial.measured.particles),
                              in_quotes(quantity.name), in_quotes(quantity.unit), in_full(value),
                              in_full(quantity.answer), quantity.source, in_full(quantity.uncertainty),
                              in_full(100 * quantity.error(value)), in_full(trial.seconds), in_quotes(trial.failure)});
      }
  return text;
}

/// The trials of `problem` in a table that `csv` wrote. Runs of other methods, sizes or quantities are left out.
[[nodiscard]] inline std::vector<Trial> read_trials(const Problem& problem, std::string_view table) {
  const auto lines = report::read_csv(table);
  std::vector<Trial> trials;
  for (const Method& method : problem.methods)
    for (const int size : problem.sizes) {
      Trial trial{method.name, size, {}, 0};
      for (const Quantity& quantity : problem.quantities)
        for (const auto& line : lines) {
          if (line.size() != 14 || line[0] != problem.name || line[1] != method.name ||
              line[2] != std::to_string(size) || line[5] != quantity.name)
            continue;
          trial.measured.spacing = std::stod(line[3]);
          trial.measured.particles = static_cast<std::size_t>(std::stoul(line[4]));
          trial.measured.values.push_back(std::stod(line[7]));
          trial.seconds = std::stod(line[12]);
          trial.failure = line[13];
        }
      if (trial.measured.values.size() == problem.quantities.size()) trials.push_back(trial);
    }
  return trials;
}

/// Errors of one quantity by one method against spacings, from coarse to fine.
struct Curve {
  std::vector<double> spacings, errors;

  [[nodiscard]] double order(double resolution) const { return fitted_order(spacings, errors, resolution); }
  [[nodiscard]] bool empty() const { return errors.empty(); }
};

enum class Sizes { all, odd, even };

[[nodiscard]] inline Curve curve(const Solved& solved, const std::string& method, std::size_t quantity, Sizes sizes) {
  Curve found;
  for (const Trial& trial : solved.trials) {
    if (trial.method != method || !trial.failure.empty()) continue;
    if (sizes != Sizes::all && (trial.size % 2 == 1) != (sizes == Sizes::odd)) continue;
    found.spacings.push_back(trial.measured.spacing);
    found.errors.push_back(solved.problem.quantities[quantity].error(trial.measured.values[quantity]));
  }
  return found;
}

/// The order of a curve as text, or the reason why there is none.
[[nodiscard]] inline std::string order_text(const Curve& curve, double resolution) {
  std::size_t counted = 0;
  bool above = false, below = false;
  for (const double error : curve.errors) {
    if (!(std::abs(error) > resolution)) continue;
    ++counted;
    (error > 0 ? above : below) = true;
  }
  if (counted < 3) return counted < curve.errors.size() ? "within the answer's own error" : "-";
  if (above && below) return "changes sign";
  return report::places(curve.order(resolution), 1);
}

}  // namespace verification
