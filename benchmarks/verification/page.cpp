// SPDX-License-Identifier: MIT
#include "verification/page.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/chart.hpp"
#include "report/text.hpp"

namespace verification {
namespace page_detail {
namespace {

using report::Cells, report::Colour, report::Panel, report::wrapped;

std::string percent(double error) {
  if (!std::isfinite(error)) return "failed";
  const std::string number = report::digits(100 * error, 2) + " %";
  return error > 0 ? '+' + number : number;
}

/// The result of a method for a quantity: the largest error if the method should be right at any spacing, otherwise the
/// error at the finest spacing and the order.
std::string verdict(const Solved& solved, const std::string& method, std::size_t q) {
  const Quantity& quantity = solved.problem.quantities[q];
  const Curve all = curve(solved, method, q, Sizes::all);
  if (all.empty()) return "-";
  if (quantity.bound > 0) {
    double worst = 0;
    for (const double error : all.errors) worst = std::max(worst, std::abs(error));
    return report::digits(worst, 2) + " at most";
  }
  const auto part = [&](Sizes sizes, const char* name) {
    const Curve c = curve(solved, method, q, sizes);
    if (c.empty()) return std::string();
    const std::string order = order_text(c, quantity.resolution());
    return name + percent(c.errors.back()) + (order == "-" ? "" : "; " + order);
  };
  if (!solved.problem.parity) return part(Sizes::all, "");
  return part(Sizes::odd, "odd ") + "<br>" + part(Sizes::even, "even ");
}

/// The order of the error of quantity `q` between two trials, if both are meaningful and have the same sign.
std::string order_of(const Quantity& quantity, std::size_t q, const Trial* before, const Trial& trial) {
  if (before == nullptr || !before->failure.empty()) return "-";
  const double earlier = quantity.error(before->measured.values[q]), error = quantity.error(trial.measured.values[q]);
  if (!(earlier * error > 0 && std::min(std::abs(earlier), std::abs(error)) > quantity.resolution())) return "-";
  return report::places(order_between(before->measured.spacing, earlier, trial.measured.spacing, error), 1);
}

/// All runs of a problem, with the order between two sizes (of the same parity where that matters).
std::string table(const Solved& solved) {
  const Problem& problem = solved.problem;
  report::Table runs{.header = {"Method", problem.across, "Particles"}};
  for (const Quantity& quantity : problem.quantities) {
    runs.header.push_back(quantity.name + (quantity.unit == "1" ? "" : " (" + quantity.unit + ")"));
    runs.header.emplace_back("error");
    if (quantity.bound == 0) runs.header.emplace_back("order");
  }
  for (std::size_t k = 0; k < solved.trials.size(); ++k) {
    const Trial& trial = solved.trials[k];
    Cells row{trial.method, std::to_string(trial.size), std::to_string(trial.measured.particles)};
    if (!trial.failure.empty()) row.push_back("failed: " + trial.failure);
    const std::size_t back = problem.parity ? 2 : 1;
    const Trial* before =
        k >= back && solved.trials[k - back].method == trial.method ? &solved.trials[k - back] : nullptr;
    for (std::size_t q = 0; trial.failure.empty() && q < problem.quantities.size(); ++q) {
      const Quantity& quantity = problem.quantities[q];
      const double value = trial.measured.values[q], error = quantity.error(value);
      row.push_back(report::digits(value, 5));
      row.push_back(quantity.bound > 0 ? report::digits(error, 2) : percent(error));
      if (quantity.bound == 0) row.push_back(order_of(quantity, q, before, trial));
    }
    runs.rows.push_back(std::move(row));
  }
  return runs.markdown();
}

/// `seconds`: duration of all runs.
std::string preface(double seconds) {
  std::string text = "# Problems with known answers\n\n";
  text += wrapped(
      "This page, its picture and `verification.csv` beside it are written by `benchmarks/verification/run` from "
      "runs of the library's components; nothing in them is typed by hand. `--only NAME` reruns one problem, "
      "`--quick` runs all problems at small sizes, and `--help` lists the other options. The page shows where the "
      "method is right and where it is not.");
  text += '\n' +
          report::bullets(
              {"**Error**: relative to the answer, with its sign. Where the strain is the same everywhere, the "
               "result should be right at any spacing, to the tolerance of the relaxation; for such problems the "
               "table gives the largest error.",
               "**Order**: the exponent p in |error| = c h^p, fitted to all spacings at which the error exceeds that "
               "of the answer itself. No order is given where the error changes sign. The tables of the problems "
               "give the order between successive spacings.",
               "**Odd and even** numbers of particles across are listed separately where their results differ: "
               "nearly incompressible sheets with an even number of layers lock (see [theory.md](../theory.md)).",
               "**Static problems** are solved by `relax`. Two-dimensional problems are in plane strain.",
               "**Geometry**: particles lie at the centres of cells. A body of height h has n = h / l0 particles "
               "across it, and the outermost lie half a spacing inside its faces. Displacements of faces are "
               "extrapolated from the two nearest layers.",
               "**A fixed face** is represented by one layer of held particles half a spacing behind it. The layer "
               "holds the body about half a spacing too far back, which is an error of first order. With two layers, "
               "as in `examples/first_program.cpp`, the error is mostly larger. The tables contain both.",
               "**E_hat**: the paper's choice E, and `shear_wave_modulus`, 4/3 of the shear modulus. Where the "
               "volume is stiff, the latter also with `mean_dilatation` and the shares of `split_bulk_modulus`."});
  text += '\n' + wrapped(
                     "Problems 7, 8 and 25 to 27 of the list from which these problems are taken are covered by "
                     "tests: energy by `tests/hmps/time/symplectic_euler.test.cpp`, the largest step by "
                     "`tests/hmps/analysis/stable_step.test.cpp` and [stability.md](stability.md), incline and slide "
                     "by `tests/hmps/contact/incline.test.cpp`, and sticking by "
                     "`tests/hmps/contact/penalty.test.cpp`.");
  return text + '\n' +
         wrapped("All runs together took " + report::digits(seconds / 60, 2) +
                 " minutes on one core of this "
                 "machine.") +
         '\n';
}

/// The methods that the picture shows, and their colours.
const std::vector<std::pair<Method, Colour>> drawn{{paper, Colour::hex(0xc0392b)},
                                                   {shear_wave, Colour::hex(0x1f5f99)},
                                                   {two_layers, Colour::hex(0x9cc4e0)},
                                                   {mean_dilatation, Colour::hex(0x2e8b57)}};

double drawn_error(const Quantity& quantity, const Trial& trial) {
  return std::max(std::abs(quantity.error(trial.measured.values[0])), 1e-5);
}

void draw_problem(const Solved& solved, Panel panel) {
  const Problem& problem = solved.problem;
  const Quantity& quantity = problem.quantities[0];
  double least = 1e300, most = 0, nearest = 1e300, farthest = 0;
  for (const Trial& trial : solved.trials) {
    if (!trial.failure.empty()) continue;
    least = std::min(least, drawn_error(quantity, trial)), most = std::max(most, drawn_error(quantity, trial));
    nearest = std::min(nearest, 1.0 / trial.size), farthest = std::max(farthest, 1.0 / trial.size);
  }
  if (farthest == 0) return;
  const double bottom = panel.y + panel.height;
  const auto across = report::Axis::logarithmic(nearest, farthest, panel.x, panel.x + panel.width);
  const auto up = report::Axis::logarithmic(std::max(least, most * 1e-3), most, bottom, panel.y);
  const auto clamped = [&](double error) { return std::clamp(up(std::max(error, 1e-9)), panel.y, bottom); };
  if (const double sure = clamped(quantity.resolution()); quantity.resolution() > 0)
    panel.canvas.rectangle(panel.x, sure, panel.width, bottom - sure, Colour::hex(0xf2ecd9));
  for (const double t : up.ticks()) panel.tick_up(up(t), report::digits(100 * t, 2) + " %");
  for (const int size : problem.sizes) panel.tick_across(across(1.0 / size), std::to_string(size));
  panel.frame();
  panel.canvas.text(panel.x, panel.y - 8, problem.title, 12, panel.ink, report::Anchor::left, true);
  panel.caption(quantity.name + ", over " + problem.across, 28, 9.5);
  for (const auto& [method, colour] : drawn)
    for (const bool odd : {true, false}) {
      report::Points points;
      for (const Trial& trial : solved.trials)
        if (trial.method == method.name && trial.failure.empty() && (!problem.parity || (trial.size % 2 == 1) == odd))
          points.emplace_back(across(1.0 / trial.size), clamped(drawn_error(quantity, trial)));
      panel.curve(points, colour, 1.5, 2.5, odd ? std::vector<double>{} : std::vector<double>{4, 3});
      if (!problem.parity) break;
    }
}

}  // namespace
}  // namespace page_detail

std::string summary(const std::vector<Solved>& all) {
  using namespace page_detail;
  report::Table answers{
      .header = {"Problem", "Quantity", "Answer", "Source", paper.name, shear_wave.name, mean_dilatation.name}};
  for (const Solved& solved : all)
    for (std::size_t q = 0; q < solved.problem.quantities.size(); ++q) {
      const Quantity& quantity = solved.problem.quantities[q];
      std::string answer = report::digits(quantity.answer, 5);
      if (quantity.uncertainty > 0) answer += " +- " + report::digits(quantity.uncertainty, 2);
      if (quantity.unit != "1") answer += ' ' + quantity.unit;
      answers.rows.push_back({q == 0 ? solved.problem.title : "", quantity.name, answer, quantity.source,
                              verdict(solved, paper.name, q), verdict(solved, shear_wave.name, q),
                              verdict(solved, mean_dilatation.name, q)});
    }
  return answers.markdown();
}

std::string page_of(const std::vector<Solved>& all) {
  using namespace page_detail;
  double seconds = 0;
  for (const Solved& solved : all)
    for (const Trial& trial : solved.trials) seconds += trial.seconds;
  std::string page =
      preface(seconds) + summary(all) + "\n![Error over the number of particles across](images/verification.png)\n";
  for (const Solved& solved : all) {
    page += "\n## " + solved.problem.title + "\n\n" + wrapped(solved.problem.text) + '\n' + table(solved);
    if (!solved.problem.remark.empty()) page += '\n' + wrapped(solved.problem.remark);
  }
  return page;
}

void draw(const std::vector<Solved>& all, const std::filesystem::path& path) {
  using namespace page_detail;
  constexpr double left = 52, top = 30, width = 210, height = 150, right = 14, below = 44, legend = 56;
  constexpr int columns = 4;
  constexpr auto ink = Colour::hex(0x222222);
  std::vector<const Solved*> shown;
  for (const Solved& solved : all)
    if (solved.problem.quantities[0].bound == 0 && !solved.trials.empty()) shown.push_back(&solved);
  const int rows = (static_cast<int>(shown.size()) + columns - 1) / columns;
  examples::Canvas canvas(static_cast<int>(columns * (left + width + right)),
                          static_cast<int>(legend + rows * (top + height + below)));
  double at = left;
  for (const auto& [method, colour] : drawn) {
    canvas.line(at, 20, at + 24, 20, colour, 2);
    canvas.text(at + 30, 24, method.name, 12, ink);
    at += 60 + canvas.text_width(method.name, 12);
  }
  canvas.text(left, 44, "dashed: even numbers of particles; shaded: within the answer's own error", 12, ink);
  for (std::size_t p = 0; p < shown.size(); ++p) {
    const auto column = static_cast<double>(p % columns), row = static_cast<double>(p / columns);
    draw_problem(*shown[p], {.canvas = canvas,
                             .x = left + column * (left + width + right),
                             .y = legend + top + row * (top + height + below),
                             .width = width,
                             .height = height,
                             .size = 10,
                             .left = 4,
                             .below = 13});
  }
  canvas.save(path);
}

}  // namespace verification
