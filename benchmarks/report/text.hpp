// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

/// What the studies write: numbers, sentences and tables, pages of Markdown, charts, and the command line for all that.
namespace report {

/// A number in at most `count` significant digits: 0.021, 1e+03.
[[nodiscard]] std::string digits(double value, int count = 3);
/// A number with `count` digits behind the point: 0.021, 1000.000.
[[nodiscard]] std::string places(double value, int count = 3);
/// A number in at most `count` significant digits, without an exponent below ten millions: 0.021, 123000.
[[nodiscard]] std::string rounded(double value, int count = 3);
/// A number with its thousands in letters: 3.3 M, 120 k.
[[nodiscard]] std::string counted(double number);
/// A number of bytes: 7.6 MB, 12 kB.
[[nodiscard]] std::string bytes(double number);

/// `text` in lines of at most 120 characters, all but the first of them behind `indent`, and a newline.
[[nodiscard]] std::string wrapped(const std::string& text, const std::string& indent = "");
/// `sentences` as a list of Markdown.
[[nodiscard]] std::string bullets(const std::vector<std::string>& sentences);

/// The compiler of this program and its version.
[[nodiscard]] std::string compiler();
/// The name that the system gives the processor.
[[nodiscard]] std::string processor();

}  // namespace report
