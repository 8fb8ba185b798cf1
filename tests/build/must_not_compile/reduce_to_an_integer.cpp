// SPDX-License-Identifier: MIT
// expect: reduce starts from an integer, to which its terms would be rounded
#include <functional>

#include "hmps/core/executor.hpp"

int main() {
  return hmps::reduce(
      10, 0, [](std::size_t) { return 0.5; }, std::plus<>{});
}
