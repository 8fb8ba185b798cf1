// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "numbers.hpp"

/// Validators for the numbers of a command line. CLI11 alone reads 0x1 as one and 010 as eight, and accepts inf and
/// nan.
namespace examples {

/// A finite number in decimal notation.
[[nodiscard]] inline CLI::Validator is_decimal() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        return decimal<double>(text) ? std::string() : "'" + text + "' is not a number in decimal notation";
      },
      "");
}

/// The same within [low, high], with a message that contains the unit.
[[nodiscard]] inline CLI::Validator within(double low, double high, const std::string& what) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const auto value = decimal<double>(text);
        if (!value) return "'" + text + "' is not a number in decimal notation";
        return *value >= low && *value <= high ? std::string() : what + " (" + text + " was given)";
      },
      "");
}

/// An integer in decimal notation within [low, high]. Use it with `transform`: it removes leading zeros and signs,
/// which CLI11 reads as another notation.
[[nodiscard]] inline CLI::Validator whole_within(long low, long high, const std::string& what) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const auto value = decimal<long>(text);
        if (!value) return "'" + text + "' is not a whole number in decimal notation";
        if (*value < low || *value > high) return what + " (" + text + " was given)";
        text = std::to_string(*value);
        return {};
      },
      "");
}

}  // namespace examples
