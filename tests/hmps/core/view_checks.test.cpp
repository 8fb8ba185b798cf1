// SPDX-License-Identifier: MIT
#include "hmps/core/view_checks.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace view_checks_test {

using hmps::VectorView;

template <class View>
std::string error_of(const View& view) {
  try {
    hmps::require_size(view, view.size(), "velocities");
  } catch (const hmps::InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ViewChecks, RefuseNull) {
  double number = 0;
  EXPECT_TRUE(
      has(error_of(VectorView<double, 2>({nullptr, nullptr}, 3, 16)), "velocities has 3 particles but a null address"));
  EXPECT_TRUE(has(error_of(VectorView<double, 2>({&number, nullptr}, 1, 16)), "null"));
  EXPECT_EQ(error_of(VectorView<double, 2>({nullptr, nullptr}, 0, 0)), "nothing was thrown");
}

TEST(ViewChecks, RefuseWhatIsNotAligned) {
  alignas(8) char memory[64] = {};
  const auto at = [&](std::size_t byte) { return reinterpret_cast<const double*>(memory + byte); };
  EXPECT_TRUE(has(error_of(VectorView<const double, 2>({at(4), at(16)}, 1, 8)), "not aligned"));
  EXPECT_TRUE(has(error_of(VectorView<const double, 2>({at(0), at(8)}, 2, 12)), "stride (12 bytes)"));
  EXPECT_EQ(error_of(VectorView<const double, 2>({at(0), at(8)}, 1, 12)), "nothing was thrown");
}

// One value for all particles may be read, but not written.
TEST(ViewChecks, RefuseToWriteManyParticlesToOnePlace) {
  double numbers[2] = {1, 2};
  const VectorView<double, 2> written({&numbers[0], &numbers[1]}, 5, 0);
  EXPECT_TRUE(has(error_of(written), "stride of 0 bytes"));
  EXPECT_EQ(error_of(VectorView<const double, 2>(written)), "nothing was thrown");
  EXPECT_EQ(error_of(VectorView<double, 2>({&numbers[0], &numbers[1]}, 1, 0)), "nothing was thrown");
  EXPECT_EQ(error_of(VectorView<double, 1>({&numbers[1]}, 2, -8)), "nothing was thrown");
}

TEST(ViewChecks, RefuseTwoViewsOfOneArray) {
  std::vector<double> a(6), b(6);
  const VectorView<double, 3> x({&a[0], &a[1], &a[2]}, 2, 24), y({&b[0], &b[1], &b[2]}, 2, 24);
  EXPECT_NO_THROW(hmps::require_apart(x, "positions", y, "velocities"));
  EXPECT_THROW(hmps::require_apart(x, "positions", VectorView<const double, 3>(x), "velocities"), hmps::InputError);
}

TEST(ViewChecks, RefuseToWriteSeveralComponentsToOnePlace) {
  std::vector<double> a(24), b(6);
  const auto at = [&](std::size_t k) { return a.data() + k; };
  EXPECT_TRUE(has(error_of(VectorView<double, 3>({at(0), b.data(), b.data()}, 6, 8)), "components lie in one place"))
      << "one array for two components";
  EXPECT_TRUE(has(error_of(VectorView<double, 3>({at(0), at(1), at(2)}, 6, 8)), "components lie in one place"))
      << "the stride of one number for vectors";
  EXPECT_TRUE(has(error_of(VectorView<double, 2>({at(4), at(4)}, 1, 0)), "components lie in one place"));
  EXPECT_TRUE(has(error_of(VectorView<double, 2>({at(20), at(18)}, 2, -16)), "components lie in one place"));
  EXPECT_EQ(error_of(VectorView<const double, 3>({at(0), b.data(), b.data()}, 6, 8)), "nothing was thrown")
      << "zeros may be shared";
  EXPECT_EQ(error_of(VectorView<double, 3>({at(0), at(1), at(2)}, 6, 24)), "nothing was thrown");
  EXPECT_EQ(error_of(VectorView<double, 3>({at(0), at(6), at(12)}, 6, 8)), "nothing was thrown");
  EXPECT_EQ(error_of(VectorView<double, 2>({at(5), at(11)}, 6, -8)), "nothing was thrown");
}

}  // namespace view_checks_test
