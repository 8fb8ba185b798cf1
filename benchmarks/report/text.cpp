// SPDX-License-Identifier: MIT
#include "report/text.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace report {
namespace {

std::string printed(const char* format, int count, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, count, value);
  return text;
}

}  // namespace

std::string digits(double value, int count) { return printed("%.*g", count, value); }
std::string places(double value, int count) { return printed("%.*f", count, value); }

std::string rounded(double value, int count) {
  char text[64];
  // Fixed notation where it is readable: 123000 rather than 1.23e+05.
  const double size = std::abs(value);
  if (size >= std::pow(10, count) && size < 1e7) {
    const double unit = std::pow(10, std::floor(std::log10(size)) + 1 - count);
    value = std::round(value / unit) * unit;
    count = 9;
  }
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, count).ptr;
  return {text, end};
}

std::string counted(double number) {
  if (number >= 1e9) return rounded(number / 1e9) + " G";
  if (number >= 1e6) return rounded(number / 1e6) + " M";
  return number >= 1e3 ? rounded(number / 1e3) + " k" : rounded(number);
}
std::string bytes(double number) {
  return number >= 1e6 ? rounded(number / 1e6) + " MB" : rounded(number / 1e3) + " kB";
}

std::string wrapped(const std::string& text, const std::string& indent) {
  std::istringstream words(text);
  std::string all, line;
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > 120) {
      all += line + '\n';
      line = indent + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
  }
  return all + line + '\n';
}
std::string bullets(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += wrapped("- " + sentence, "  ");
  return text.empty() ? "- nothing\n" : text;
}

std::string compiler() {
#ifdef __clang__
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "an unnamed processor";
}

}  // namespace report
