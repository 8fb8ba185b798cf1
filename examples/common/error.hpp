// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>

#include <hmps/core/error.hpp>

namespace examples {

/// Joins its arguments into one message. Numbers have nine digits, which distinguish any two floats.
template <class... Parts>
[[nodiscard]] std::string message(const Parts&... parts) {
  std::ostringstream text;
  text.precision(9);
  (text << ... << parts);
  return text.str();
}

/// Throws an `InputError` with the message `parts` unless `condition` holds.
template <class... Parts>
void require(bool condition, const Parts&... parts) {
  if (!condition) throw hmps::InputError(message(parts...));
}

}  // namespace examples
