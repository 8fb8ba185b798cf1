// SPDX-License-Identifier: MIT
#include "hmps/output/position_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace position_field_test {

using namespace hmps;

/// A body of 6 x 5 x 4 particles `spacing` apart from `corner` on.
template <class T>
std::vector<Vector<T, 3>> body(double spacing, const Vector<double, 3>& corner) {
  std::vector<Vector<T, 3>> x;
  for (int i = 0; i < 120; ++i)
    x.push_back((corner + spacing * Vector<double, 3>(i / 20, i / 4 % 5, i % 4)).template cast<T>());
  return x;
}

TEST(PositionField, KeepsDistinctPointsDistinct) {
  for (const double spacing : {1e-3, 2e-5}) {
    const auto x = body<double>(spacing, {1000, -1000, 0});
    const VtkField field = position_field("position", vectors(x));
    ASSERT_EQ(field.type, "Float64");
    EXPECT_EQ(field.bytes, vtk_field<double>("position", vectors(x)).bytes);
  }
}

TEST(PositionField, UsesSinglePrecisionWhereItSuffices) {
  for (const double spacing : {1e-3, 2e-5, 1e3}) {
    const auto x = body<double>(spacing, {0.03, 0, 0});
    EXPECT_EQ(position_field("position", vectors(x)).type, "Float32") << spacing;
  }
  const auto given = body<float>(1e-3, {1000, 0, 0});  // has no more digits
  EXPECT_EQ(position_field("position", vectors(given)).type, "Float32");
  const std::vector<Vector<double, 2>> none, one{{1e6, 0}}, twice(2, {1e6, 0});
  for (const auto* points : {&none, &one, &twice})
    EXPECT_EQ(position_field("position", vectors(*points)).type, "Float32");
}

TEST(PositionField, MeasuresTheSpacingOfBodiesThatAreApartAndOfListsInAnyOrder) {
  auto x = body<double>(1e-3, {0, 0, 0});
  const auto other = body<double>(1e-3, {1000, 0, 0});
  x.insert(x.end(), other.begin(), other.end());
  EXPECT_NEAR(detail::typical_spacing(vectors(x)), 1e-3, 1e-9);
  EXPECT_EQ(position_field("position", vectors(x)).type, "Float64");
  std::vector<Vector<double, 2>> line;
  for (int i = 0; i < 10000; ++i) line.push_back({1e-3 * i, 1});
  std::mt19937 order(1);
  std::shuffle(line.begin(), line.end(), order);
  EXPECT_NEAR(detail::typical_spacing(vectors(line)), 1e-3, 1e-6);
  auto block = body<double>(1e-3, {0, 0, 0});
  std::shuffle(block.begin(), block.end(), order);
  EXPECT_NEAR(detail::typical_spacing(vectors(block)), 1e-3, 1e-9);
}

TEST(PositionField, UsesDoubleBeyondSinglePrecision) {
  const std::vector<Vector<double, 2>> large{{0, 0}, {1e300, 0}}, tiny{{0, 0}, {1e-44, 0}};
  EXPECT_EQ(position_field("position", vectors(large)).type, "Float64");
  EXPECT_EQ(position_field("position", vectors(tiny)).type, "Float64");
}

}  // namespace position_field_test
