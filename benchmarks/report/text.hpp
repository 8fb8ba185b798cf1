// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

/// The output of the studies: numbers, sentences and tables, pages of Markdown and charts; and their common command
/// line.
namespace report {

/// A number with at most `count` significant digits: 0.021, 1e+03.
[[nodiscard]] std::string digits(double value, int count = 3);
/// A number with `count` digits after the point: 0.021, 1000.000.
[[nodiscard]] std::string places(double value, int count = 3);
/// A number with at most `count` significant digits, without an exponent below ten million: 0.021, 123000.
[[nodiscard]] std::string rounded(double value, int count = 3);
/// A number with a letter for thousands or millions: 3.3 M, 120 k.
[[nodiscard]] std::string counted(double number);
/// A number of bytes: 7.6 MB, 12 kB.
[[nodiscard]] std::string bytes(double number);

/// `text` in lines of at most 120 characters, all but the first after `indent`, and a newline.
[[nodiscard]] std::string wrapped(const std::string& text, const std::string& indent = "");
/// `sentences` as a Markdown list.
[[nodiscard]] std::string bullets(const std::vector<std::string>& sentences);

/// The compiler of this program with its version.
[[nodiscard]] std::string compiler();
/// The name of the processor, as the system reports it.
[[nodiscard]] std::string processor();

}  // namespace report
