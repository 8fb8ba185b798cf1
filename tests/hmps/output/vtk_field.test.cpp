// SPDX-License-Identifier: MIT
#include "hmps/output/vtk_field.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace vtk_field_test {

using namespace hmps;

template <class T>
std::vector<T> numbers(const VtkField& field) {
  std::vector<T> values(field.bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), field.bytes.data(), field.bytes.size());
  return values;
}

TEST(VtkField, HoldsNumbersInSinglePrecisionUnlessAsked) {
  std::vector<double> j{1, 0.1};
  const VtkField coarse = vtk_field("J", scalars(j)), exact = vtk_field<double>("J", scalars(j));
  EXPECT_EQ(coarse.type, "Float32");
  EXPECT_EQ(numbers<float>(coarse), (std::vector<float>{1.f, 0.1f}));
  EXPECT_EQ(exact.type, "Float64");
  EXPECT_EQ(numbers<double>(exact), j);
  EXPECT_EQ(exact.size(), 2u);
}

TEST(VtkField, RefusesWhatOverflowsAndKeepsWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> j{1, 1e300};
  EXPECT_THROW((void)vtk_field("J", scalars(j)), InputError);
  EXPECT_EQ(numbers<double>(vtk_field<double>("J", scalars(j))), j);
  std::vector<Matrix<double, 2>> stress{Matrix<double, 2>::Constant(-1e200)};
  EXPECT_THROW((void)vtk_field("s", matrices(stress)), InputError);
  j = {std::numeric_limits<double>::quiet_NaN(), -infinity};
  const auto written = numbers<float>(vtk_field("J", scalars(j)));
  EXPECT_TRUE(std::isnan(written[0]));
  EXPECT_EQ(written[1], -infinity);
}

TEST(VtkField, HoldsASetOfParticles) {
  const ParticleSet held(3, std::vector<Index>{0, 2});
  const VtkField field = vtk_field("held", held);
  EXPECT_EQ(field.name, "held");
  EXPECT_EQ(field.type, "UInt8");
  EXPECT_EQ(numbers<std::uint8_t>(field), (std::vector<std::uint8_t>{1, 0, 1}));
}

TEST(VtkField, HoldsWholeNumbersThatFit) {
  std::vector<std::uint8_t> organ{0, 255};
  EXPECT_EQ(vtk_field("organ", scalars(organ)).type, "Int32");
  EXPECT_EQ(numbers<std::int32_t>(vtk_field("organ", scalars(organ))), (std::vector<std::int32_t>{0, 255}));
  std::vector<std::uint32_t> large{7, 3000000000u};
  EXPECT_THROW((void)vtk_field("organ", scalars(large)), InputError);
  std::vector<std::int64_t> low{std::int64_t{-3000000000}};
  EXPECT_THROW((void)vtk_field("organ", scalars(low)), InputError);
  std::vector<std::uint64_t> huge{~std::uint64_t{0}};
  EXPECT_THROW((void)vtk_field("organ", scalars(huge)), InputError);
}

TEST(VtkField, HoldsVectorsAndTensorsInSpaceRowByRow) {
  std::vector<std::array<float, 2>> v{{1, 2}};
  EXPECT_EQ(numbers<float>(vtk_field("v", vectors(v))), (std::vector<float>{1, 2, 0}));
  std::vector<Matrix<double, 3>> stress(1);
  stress[0] << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  EXPECT_EQ(numbers<float>(vtk_field("s", matrices(stress))), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  std::vector<Matrix<double, 2>> flat(1);
  flat[0] << 1, 2, 3, 4;
  EXPECT_EQ(numbers<float>(vtk_field("s", matrices(flat))), (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(vtk_field("s", matrices(flat)).components, 4);
  EXPECT_EQ(vtk_field("s", matrices(flat)).size(), 1u);
}

}  // namespace vtk_field_test
