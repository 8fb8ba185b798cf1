// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "hmps/core/error.hpp"

namespace hmps_test {

/// The message of the `Error` that `call` throws; empty if it throws none.
template <class Error = hmps::InputError, class Call>
[[nodiscard]] std::string message_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace hmps_test
