// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "verification/method.hpp"

/// Problems with known answers: what is asked, what is right, and what the method says at some spacings.
namespace verification {

/// What is compared. The error is relative to the right answer, so that it is negative where too little comes out, or
/// to `scale` where that is given.
struct Quantity {
  std::string name;        ///< in a sentence: "the sag of the end"
  std::string unit;        ///< in which it is shown
  double answer;           ///< the right one, in that unit
  std::string source;      ///< exact, beam theory, finite elements, published
  double uncertainty = 0;  ///< of the answer, in its unit: no smaller error means anything
  double scale = 0;        ///< what the error is a share of, in its unit, if not of the answer
  double bound = 0;        ///< what no error exceeds at any size, if the method should be right; else 0

  [[nodiscard]] double error(double value) const { return (value - answer) / (scale > 0 ? scale : answer); }
  [[nodiscard]] double resolution() const { return uncertainty / (scale > 0 ? scale : std::abs(answer)); }
};

/// What a run gave: the spacing and the quantities in the order of `Problem::quantities`.
struct Measured {
  double spacing;  ///< m
  std::size_t particles;
  std::vector<double> values;
};

/// A problem. An aggregate, so that one of your own is a function that fills it in.
struct Problem {
  std::string name;   ///< of the table, the panel and --only
  std::string title;  ///< of the section
  std::string text;   ///< what is simulated, how, and what it is compared with
  std::vector<Quantity> quantities;
  std::string across;      ///< what the sizes count, such as "particles across the height"
  std::vector<int> sizes;  ///< to be run, growing: the larger, the finer
  std::vector<Method> methods;
  std::function<Measured(int size, const Method&)> run;
  bool parity = false;      ///< whether odd and even sizes form two sequences
  std::string remark = "";  ///< where it is wrong, and why
};

/// A problem at one size by one method. `failure` says why there is none.
struct Trial {
  std::string method;
  int size;
  Measured measured;
  double seconds;  ///< of one processor
  std::string failure = "";
};

/// The order of convergence between two spacings: log(e1 / e2) / log(h1 / h2). Not a number where an error is zero.
[[nodiscard]] inline double order_between(double coarse, double coarse_error, double fine, double fine_error) {
  return std::log(std::abs(coarse_error / fine_error)) / std::log(coarse / fine);
}

/// The exponent p of the fit |error| = c h^p by least squares of logarithms over all points whose error exceeds
/// `resolution`. Not a number where there are fewer than three.
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
