// SPDX-License-Identifier: MIT
#include "hmps/core/detail/central_gradient.hpp"

#include <gtest/gtest.h>

namespace central_gradient_test {

using hmps::detail::central_gradient;
using Point = hmps::Vector<double, 3>;

TEST(CentralGradient, IsExactForAQuadraticFunction) {
  const auto function = [](const Point& x) { return 3 * x[0] * x[0] - x[0] * x[1] + 5 * x[2]; };
  const Point g = central_gradient(function, Point(2, 3, 1), 0.25);
  EXPECT_LE((g - Point(9, -2, 5)).norm(), 1e-13);
}

TEST(CentralGradient, LooksAsFarAsItIsTold) {
  const auto step = [](const hmps::Vector<double, 2>& x) { return x[1] > 0.3 ? 1.0f : 0.0f; };
  EXPECT_EQ(central_gradient(step, hmps::Vector<double, 2>(0, 0), 0.25).norm(), 0);
  EXPECT_EQ((central_gradient(step, hmps::Vector<double, 2>(0, 0), 0.5)), (hmps::Vector<double, 2>(0, 1)));
}

}  // namespace central_gradient_test
