// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace hmps_test {

/// An executor that runs every loop from its end: what depends on the order of work differs from `hmps::Serial`.
struct Backwards {
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    for (std::size_t i = n; i-- > 0;) body(i);
  }
};

}  // namespace hmps_test
