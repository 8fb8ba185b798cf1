// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "verification/method.hpp"

/// Problems with known answers: the quantities, the right answers, and the results of the method at some spacings.
namespace verification {

/// A quantity that is compared. The error is relative to the right answer, and negative if the result is too small; or
/// it is relative to `scale`, if that is given.
struct Quantity {
  std::string name;        ///< as used in a sentence: "the sag of the end"
  std::string unit;        ///< for display
  double answer;           ///< the right one, in that unit
  std::string source;      ///< exact, beam theory, finite elements, published
  double uncertainty = 0;  ///< of the answer, in its unit; smaller errors have no meaning
  double scale = 0;        ///< reference of the error in its unit, if that is not the answer
  double bound = 0;        ///< of the error at all sizes, if the method should be right; otherwise 0

  [[nodiscard]] double error(double value) const { return (value - answer) / (scale > 0 ? scale : answer); }
  [[nodiscard]] double resolution() const { return uncertainty / (scale > 0 ? scale : std::abs(answer)); }
};

/// The result of a run: the spacing and the quantities in the order of `Problem::quantities`.
struct Measured {
  double spacing;  ///< m
  std::size_t particles;
  std::vector<double> values;
};

/// A problem. It is an aggregate: to make one of your own, write a function that fills it in.
struct Problem {
  std::string name;   ///< for the table, the panel and --only
  std::string title;  ///< of the section
  std::string text;   ///< what is simulated, how, and with what it is compared
  std::vector<Quantity> quantities;
  std::string across;      ///< what the sizes count, such as "particles across the height"
  std::vector<int> sizes;  ///< to be run, in increasing order: the larger, the finer
  std::vector<Method> methods;
  std::function<Measured(int size, const Method&)> run;
  bool parity = false;      ///< whether odd and even sizes form two sequences
  std::string remark = "";  ///< where the method is wrong, and why
};

/// The run of a problem at one size by one method. `failure` is the reason if there is no result.
struct Trial {
  std::string method;
  int size;
  Measured measured;
  double seconds;  ///< of processor time
  std::string failure = "";
};

/// The order of convergence between two spacings: log(e1 / e2) / log(h1 / h2). NaN if an error is zero.
[[nodiscard]] inline double order_between(double coarse, double coarse_error, double fine, double fine_error) {
  return std::log(std::abs(coarse_error / fine_error)) / std::log(coarse / fine);
}

/// The exponent p of the fit |error| = c h^p by least squares of logarithms over all points whose error exceeds
/// `resolution`. NaN if there are fewer than three such points.
[[nodiscard]] inline double fitted_order(const std::vector<double>& spacings, const std::vector<double>& errors,
                                         double resolution) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < spacings.size(); ++k) {
    if (!(std::abs(errors[k]) > resolution)) continue;
    const double x = std::log(spacings[k]), y = std::log(std::abs(errors[k]));
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return n < 3 ? std::nan("") : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace verification
