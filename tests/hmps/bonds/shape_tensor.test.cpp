// SPDX-License-Identifier: MIT
#include "hmps/bonds/shape_tensor.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>

#include "hmps/bonds/weight.hpp"

namespace shape_tensor_test {

/// The neighbours in a cubic lattice of spacing one for which `inside` holds.
template <int D, class Inside>
hmps::ShapeTensor<D> lattice(Inside&& inside) {
  hmps::ShapeTensor<D> shape;
  for (int k = 0; k < (D == 3 ? 27 : 9); ++k) {
    hmps::Vector<double, D> r0;
    for (int d = 0, rest = k; d < D; ++d, rest /= 3) r0[d] = rest % 3 - 1;
    if (r0.norm() > 0 && inside(r0)) shape.add(r0, hmps::PaperWeight{}(r0.norm(), 1.75));
  }
  return shape;
}

// The number density and lambda of Eq. (21), the eigenvalues of A of Eq. (12), in a cubic lattice of
// r_e = 1.75 l0: sums over 6 faces, 12 edges and 8 corners.
TEST(ShapeTensor, HasTheKnownSumsOnAFullLattice) {
  const auto shape = lattice<3>([](const auto&) { return true; });
  const double w1 = 0.75, w2 = 1.75 / std::sqrt(2.0) - 1, w3 = 1.75 / std::sqrt(3.0) - 1;
  EXPECT_EQ(shape.neighbours, 26);
  EXPECT_NEAR(shape.weight, 6 * w1 + 12 * w2 + 8 * w3, 1e-14);
  EXPECT_NEAR(shape.weight, 7.432146, 5e-7);
  EXPECT_NEAR(shape.A.trace() / shape.weight, 1.405677, 5e-7);
  EXPECT_NEAR(shape.support(), 2 * w1 + 8 * w2 + 8 * w3, 1e-14);
  EXPECT_LT(shape.asymmetry.norm(), 1e-14);
  EXPECT_LT((shape.inverse(0) * shape.A - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(ShapeTensor, SupportDistinguishesSurfacesFromTheInterior) {
  EXPECT_NEAR(lattice<3>([](const auto&) { return true; }).support(), 3.48, 0.005);
  EXPECT_NEAR(lattice<3>([](const auto& r) { return r[0] <= 0; }).support(), 1.74, 0.005);
  EXPECT_NEAR(lattice<3>([](const auto& r) { return r.maxCoeff() <= 0; }).support(), 0.75, 0.3);
}

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const hmps::InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(ShapeTensor, RefusesNeighbourhoodsThatDoNotSpanSpace) {
  const auto refused = [](const auto& shape, const char* count) {
    const std::string text = error_of([&] { (void)shape.inverse(17); });
    EXPECT_NE(text.find("particle 17 has " + std::string(count) + " neighbour"), std::string::npos) << text;
    EXPECT_NE(text.find("remove weakly supported particles"), std::string::npos) << text;
  };
  refused(hmps::ShapeTensor<3>(), "0");
  refused(lattice<3>([](const auto& r) { return r[1] == 0 && r[2] == 0; }), "2");
  refused(lattice<3>([](const auto& r) { return r[2] == 0; }), "8");
  refused(lattice<3>([](const auto& r) { return r[0] == 1 && r[1] == 0 && r[2] == 0; }), "1");
  refused(lattice<2>([](const auto& r) { return r[0] == r[1]; }), "2");
  EXPECT_NO_THROW((void)lattice<2>([](const auto& r) { return r.maxCoeff() <= 0; }).inverse(0));
  EXPECT_NO_THROW((void)lattice<3>([](const auto& r) { return r.maxCoeff() <= 0; }).inverse(0));
}

}  // namespace shape_tensor_test
