// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/recovered_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "../../reference/scenes.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/deformation_gradient.hpp"

namespace recovered_gradient_test {

using Point = hmps::Vector<double, 3>;
using Tensor = hmps::Matrix<double, 3>;

/// Layers of 13 x 9 particles a metre apart, off the lattice by up to `jitter`; z = 0 is the middle of the wall.
std::vector<Point> wall(int layers, double jitter = 0) {
  scenes::Random random(3);
  const auto off = [&] { return random(-jitter, jitter); };
  std::vector<Point> points;
  for (int a = 0; a < 13; ++a)
    for (int b = 0; b < 9; ++b)
      for (int c = 0; c < layers; ++c) points.emplace_back(a + off(), b + off(), c - 0.5 * (layers - 1) + off());
  return points;
}

struct Gradients {
  std::vector<Tensor> plain, recovered;
  Gradients(const std::vector<Point>& reference, const std::vector<Point>& x) : plain(x.size()), recovered(x.size()) {
    const hmps::BondList<double, 3> bonds(hmps::vectors(reference), {.spacing = 1});
    hmps::deformation_gradient(bonds, hmps::vectors(x), hmps::matrices(plain));
    hmps::recovered_gradients(bonds, hmps::vectors(x), hmps::matrices(recovered));
  }
};

TEST(RecoveredGradients, AreExactForAffineMotion) {
  Tensor F;
  F << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, -0.2, 0.1, 1.1;
  for (const int layers : {2, 5}) {
    const auto reference = wall(layers, 0.2);
    auto x = reference;
    for (Point& point : x) point = F * point + Point(3, -2, 1);
    for (const Tensor& found : Gradients(reference, x).recovered) EXPECT_LE((found - F).norm(), 1e-11);
  }
}

TEST(RecoveredGradients, AreExactForAffineMotionInThePlaneAndOnALattice) {
  scenes::Scene<2> scene;
  scene.reference = scenes::box<2>(scenes::extent<2>(9, 5, 1));
  hmps::Matrix<double, 2> F;
  F << 1.2, 0.3, -0.1, 0.9;
  auto x = scene.reference;
  for (auto& point : x) point = F * point;
  std::vector<hmps::Matrix<float, 2>> found(x.size());
  const hmps::LatticeBonds<float, 2> bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  hmps::recovered_gradients(bonds, hmps::vectors(x), hmps::matrices(found));
  for (const auto& own : found) EXPECT_LE((own.cast<double>() - F).norm(), 1e-5);
}

// A wall is bent along x, as a beam of an incompressible material. The strain along it is that at the outermost
// particles; across two layers it is their mean, and that of more layers is in between.
TEST(RecoveredGradients, HoldTheBendingOfThinWalls) {
  const double bend = 1e-3;
  struct Expected {
    int layers;
    double plain, recovered, across;
  };
  for (const auto& [layers, plain, recovered, across] :
       {Expected{2, 0.652, 0.987, 0}, Expected{3, 0.826, 0.994, -0.25}, Expected{4, 0.884, 0.996, -0.333}}) {
    const auto reference = wall(layers);
    auto x = reference;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Point r = reference[i] - Point(6, 4, 0);
      x[i] += bend * Point(-r[0] * r[2], r[1] * r[2] / 2, (r[0] * r[0] + (r[2] * r[2] - r[1] * r[1]) / 2) / 2);
    }
    const Gradients found(reference, x);
    const auto middle = static_cast<std::size_t>((6 * 9 + 4) * layers);  // of the lowest layer
    const double strain = bend * 0.5 * (layers - 1);
    EXPECT_NEAR((found.plain[middle](0, 0) - 1) / strain, plain, 2e-3) << layers << " layers";
    EXPECT_NEAR((found.recovered[middle](0, 0) - 1) / strain, recovered, 2e-3) << layers << " layers";
    EXPECT_NEAR((found.recovered[middle](1, 1) - 1) / strain, -0.5 * recovered, 2e-3) << layers << " layers";
    EXPECT_NEAR((found.recovered[middle](2, 2) - 1) / strain, across, 4e-3) << layers << " layers";
  }
}

TEST(RecoveredGradients, HoldTheBendingOfASheetInThePlane) {
  std::vector<hmps::Vector<double, 2>> reference;
  for (int a = 0; a < 13; ++a)
    for (int c = 0; c < 3; ++c) reference.emplace_back(a, c - 1);
  auto x = reference;
  for (auto& r : x) r += 1e-3 * hmps::Vector<double, 2>(-(r[0] - 6) * r[1], (r[0] - 6) * (r[0] - 6) / 2);
  const hmps::BondList<double, 2> bonds(hmps::vectors(reference), {.spacing = 1});
  std::vector<hmps::Matrix<double, 2>> plain(x.size()), recovered(x.size());
  hmps::deformation_gradient(bonds, hmps::vectors(x), hmps::matrices(plain));
  hmps::recovered_gradients(bonds, hmps::vectors(x), hmps::matrices(recovered));
  EXPECT_LT(plain[18](0, 0) - 1, 0.9e-3);
  EXPECT_NEAR(recovered[18](0, 0) - 1, 1e-3, 2e-5);
}

TEST(RecoveredGradients, AmplifyNoiseLittle) {
  double most = 0;
  for (const double jitter : {0.0, 0.1, 0.3})
    for (const int layers : {2, 5}) {
      const auto reference = wall(layers, jitter);
      scenes::Random random(9);
      auto x = reference;
      for (Point& point : x) point += 1e-3 * Point(random(-1, 1), random(-1, 1), random(-1, 1));
      const Gradients found(reference, x);
      double plain = 0, recovered = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        plain += (found.plain[i] - Tensor::Identity()).squaredNorm();
        recovered += (found.recovered[i] - Tensor::Identity()).squaredNorm();
      }
      most = std::max(most, std::sqrt(recovered / plain));
    }
  EXPECT_GT(most, 2);
  EXPECT_LT(most, 3);
}

// Three neighbours determine a linear function and no more; a particle without bonds does not deform.
TEST(RecoveredGradients, AreThoseOfEquation11WhereNeighboursAreFew) {
  const std::vector<Point> reference{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), Point(50, 0, 0)};
  auto x = reference;
  for (Point& point : x) point += 0.1 * Point(point[1], point[0] - point[2], point[0] * point[1]);
  const hmps::BondList<double, 3> bonds(hmps::vectors(reference), {.spacing = 1, .unbonded = true});
  std::vector<Tensor> plain(5), recovered(5);
  hmps::deformation_gradient(bonds, hmps::vectors(x), hmps::matrices(plain));
  hmps::recovered_gradients(bonds, hmps::vectors(x), hmps::matrices(recovered));
  for (std::size_t i = 0; i < 5; ++i) EXPECT_LE((recovered[i] - plain[i]).norm(), 1e-12) << "particle " << i;
}

TEST(RecoveredGradients, RefuseViewsOfTheWrongSize) {
  const auto reference = wall(2);
  const hmps::BondList<double, 3> bonds(hmps::vectors(reference), {.spacing = 1});
  std::vector<Tensor> few(reference.size() - 1);
  EXPECT_THROW(hmps::recovered_gradients(bonds, hmps::vectors(reference), hmps::matrices(few)), hmps::InputError);
}

}  // namespace recovered_gradient_test
