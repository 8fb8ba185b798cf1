// SPDX-License-Identifier: MIT
#include "hmps/core/view_types.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace view_types_test {

using hmps::VectorView;
static_assert(std::is_convertible_v<VectorView<double, 3>, VectorView<const double, 3>>);
static_assert(!std::is_convertible_v<VectorView<const double, 3>, VectorView<double, 3>>);

// Two components in separate memory, of which every third number counts; the view runs backwards.
TEST(ViewTypes, FindComponentsByBaseAndStride) {
  std::vector<double> memory(20);
  for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = static_cast<double>(k);
  const VectorView<double, 2> view({&memory[9], &memory[19]}, 4, -3 * static_cast<std::ptrdiff_t>(sizeof(double)));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(view(i, 0), 9 - 3 * static_cast<double>(i));
    EXPECT_EQ(view[i], (hmps::Vector<double, 2>(view(i, 0), view(i, 1))));
  }
  const auto part = view.part(1, 2);
  EXPECT_EQ(part.size(), 2u);
  part.set(1, hmps::Vector<double, 2>(-1, -2));
  EXPECT_EQ(memory[3], -1);
  EXPECT_EQ(memory[13], -2);
  part.add(1, hmps::Vector<double, 2>(1, 1));
  EXPECT_EQ(memory[13], -1);
}

TEST(ViewTypes, SetAndAddTensorsColumnMajor) {
  std::vector<Eigen::Matrix2d> tensors(2, Eigen::Matrix2d::Zero());
  const hmps::MatrixView<double, 2> view({&tensors[0](0, 0), &tensors[0](1, 0), &tensors[0](0, 1), &tensors[0](1, 1)},
                                         2, sizeof(Eigen::Matrix2d));
  view.set(1, (Eigen::Matrix2d() << 1, 2, 3, 4).finished());
  view.add(1, (Eigen::Matrix2d() << 10, 20, 30, 40).finished());
  EXPECT_EQ(tensors[1], (Eigen::Matrix2d() << 11, 22, 33, 44).finished());
  EXPECT_EQ(tensors[0], Eigen::Matrix2d::Zero());
}

TEST(ViewTypes, RefuseAPartBeyondTheirEnd) {
  std::vector<double> memory(10);
  const VectorView<double, 2> view({&memory[0], &memory[1]}, 5, 16);
  EXPECT_EQ(view.part(5, 0).size(), 0u);
  EXPECT_EQ(view.part(2, 3).size(), 3u);
  EXPECT_THROW((void)view.part(2, 4), hmps::InputError) << "an end in place of a number";
  EXPECT_THROW((void)view.part(6, 0), hmps::InputError);
  EXPECT_THROW((void)view.part(1, static_cast<std::size_t>(-1)), hmps::InputError);
}

}  // namespace view_types_test
