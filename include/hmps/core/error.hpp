// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "hmps/core/language.hpp"

#if defined(min) || defined(max)
#error "hmps: min and max are macros: define NOMINMAX before <windows.h> is included"
#endif

namespace hmps {

/// Base of every exception that the library throws. The message names the particle, the value
/// and the remedy.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What the caller handed over cannot be worked with: thrown at the door, before any result.
struct InputError : Error {
  using Error::Error;
};

/// The simulation itself left the range in which it means anything (inverted particle, NaN,
/// a speed beyond the speed of sound): thrown while running.
struct StateError : Error {
  using Error::Error;
};

/// Joins its arguments into one message; numbers are written with nine digits, which
/// tell any two floats apart.
template <class... Parts>
[[nodiscard]] std::string message(const Parts&... parts) {
  std::ostringstream text;
  text.precision(9);
  ((text << parts), ...);
  return text.str();
}

/// Throws an `InputError` made of `parts` unless `condition` holds.
template <class... Parts>
void require(bool condition, const Parts&... parts) {
  if (!condition) throw InputError(message(parts...));
}

}  // namespace hmps
