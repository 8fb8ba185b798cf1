// SPDX-License-Identifier: MIT
// A second translation unit with the same headers: what they define must be inline.
#include <hmps/hmps.hpp>

double second(const hmps::VectorView<const double, 3>& positions) {
  double sum = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) sum += positions[i].sum();
  return sum;
}
