// SPDX-License-Identifier: MIT
#include "hmps/core/types.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace types_test {

template <class T>
class Types : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Types, Scalars);

// Stored types must have the same layout in every translation unit, whatever it is compiled for.
TYPED_TEST(Types, HaveTheLayoutOfAnArray) {
  EXPECT_EQ(sizeof(hmps::Vector<TypeParam, 2>), 2 * sizeof(TypeParam));
  EXPECT_EQ(sizeof(hmps::Vector<TypeParam, 3>), 3 * sizeof(TypeParam));
  EXPECT_EQ(sizeof(hmps::Vector<TypeParam, 4>), 4 * sizeof(TypeParam));
  EXPECT_EQ(sizeof(hmps::Matrix<TypeParam, 2>), 4 * sizeof(TypeParam));
  EXPECT_EQ(sizeof(hmps::Matrix<TypeParam, 3>), 9 * sizeof(TypeParam));
  EXPECT_EQ(alignof(hmps::Vector<TypeParam, 4>), alignof(TypeParam));
  EXPECT_EQ(alignof(hmps::Matrix<TypeParam, 2>), alignof(TypeParam));
  EXPECT_EQ(alignof(hmps::Matrix<TypeParam, 3>), alignof(TypeParam));
}

TYPED_TEST(Types, MatricesAreColumnMajor) {
  hmps::Matrix<TypeParam, 3> m;
  for (int k = 0; k < 9; ++k) m.data()[k] = static_cast<TypeParam>(k);
  EXPECT_EQ(m(1, 0), TypeParam(1));
  EXPECT_EQ(m(0, 1), TypeParam(3));
}

static_assert(std::is_unsigned_v<hmps::Index> && sizeof(hmps::Index) == 4);

}  // namespace types_test
