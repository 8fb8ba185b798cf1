// SPDX-License-Identifier: MIT
#include "hmps/terms/detail/wall_column.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "hmps/bonds/bond_list.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view_types.hpp"
#include "hmps/particles/fitted.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/implicit.hpp"

namespace wall_column_test {

using Vector = hmps::Vector<double, 3>;
using hmps::detail::hexagonal_column;

// The values are from a separate program that sums the same energies over periodic sheets.
TEST(WallColumn, SumsTheTwistOfHexagonalLayers) {
  EXPECT_NEAR(hexagonal_column(2, 1.0, 0.0).artificial(), 1.436, 6e-4);
  EXPECT_NEAR(hexagonal_column(2, 0.75, 0.0).artificial(), 0.934, 6e-4);
  EXPECT_NEAR(hexagonal_column(3, 0.9, 0.0).artificial(), 1.526, 6e-4);
  EXPECT_NEAR(hexagonal_column(4, 1.1, 0.0).artificial(), 1.961, 6e-4);
}

TEST(WallColumn, TwistsRightWithItsOwnModulus) {
  const auto column = hexagonal_column(3, 1.0, 0.14);
  EXPECT_NEAR(column.twist(column.artificial()), 1, 1e-12);
  EXPECT_LT(column.twist(0.0), 0.9);
}

// Two layers cannot thin on one side, and resist with all of the law's bulk modulus. Three can, and hardly resist.
TEST(WallColumn, ReleasesTheThickness) {
  const auto ratio = [](int layers) {
    const auto column = hexagonal_column(layers, 1.0, 0.0);
    return column.plate(1.5, 15, 45) / column.plate(1.5, 5, 55);
  };
  EXPECT_GT(ratio(2), 2);
  EXPECT_LT(ratio(3), 1.15);
}

// With Poisson's ratio zero a strip bends as in plane strain; a strip that keeps its volume is softer than a plate.
TEST(WallColumn, BendsStripsAcross) {
  const auto column = hexagonal_column(6, 1.0, 0.14);
  const double artificial = column.artificial();
  EXPECT_NEAR(column.strip(artificial, 2.0 / 3, 0), column.plate(artificial, 2.0 / 3, 0), 1e-3);
  EXPECT_NEAR(column.strip(artificial, 2.65, 57.35), 1, 0.02);
  EXPECT_NEAR(column.plate(artificial, 2.65, 57.35), 1, 0.02);
}

// The layers that fit_particles makes, summed from their own bonds, are those of the disordered column: hexagonal
// layers without disorder would be 1.8 to 3.5 % too stiff in twist.
TEST(WallColumn, IsThatOfFittedParticles) {
  constexpr double bulk = 60, rim = 4, half = 12;
  for (const auto& [layers, apart] : {std::pair{2, 1.0}, std::pair{3, 1.0}, std::pair{3, 1.1}}) {
    const double thickness = layers * apart;
    hmps::Matrix<double, 3> turn;
    turn << std::sqrt(0.75), 0, -0.5, 0, 1, 0, 0.5, 0, std::sqrt(0.75);
    const hmps::Box<double, 3> sheet{Vector(-half, -half, -thickness / 2), Vector(half, half, thickness / 2)};
    const auto fitted = hmps::fit_particles(hmps::rotated(sheet, turn),
                                            hmps::Box<double, 3>{Vector::Constant(-18), Vector::Constant(18)}, 1.0);
    std::vector<Vector> places;
    for (const Vector& x : fitted.positions) places.push_back(turn.transpose() * x);
    const auto layer_of = [&, count = layers, spacing = apart](const Vector& x) {
      return std::clamp(static_cast<int>(x[2] / spacing + 0.5 * count), 0, count - 1);
    };
    const auto inside = [&](const Vector& x) { return x.head<2>().cwiseAbs().maxCoeff() < half - rim; };
    std::vector<double> count(static_cast<std::size_t>(layers));
    for (const Vector& x : places)
      if (inside(x)) ++count[static_cast<std::size_t>(layer_of(x))];
    const hmps::BondList<double, 3> bonds(hmps::vectors(places), {.spacing = 1});
    const hmps::detail::WallColumn<double> own(layers, apart, [&](const auto& add) {
      for (std::size_t i = 0; i < places.size(); ++i) {
        const int layer = layer_of(places[i]);
        if (!inside(places[i])) continue;
        add(layer, 1 / count[static_cast<std::size_t>(layer)], [&](const auto& bond) {
          bonds.for_each_bond(i, [&](std::size_t j, const auto&, double) {
            bond(places[j] - places[i], places[j][2], layer_of(places[j]));
          });
        });
      }
    });
    const auto column = hexagonal_column(layers, apart, 0.14);
    EXPECT_NEAR(own.twist(column.artificial()), 1, 0.015) << layers;
    for (const double law : {2.0, 4.0}) {
      const double artificial = column.artificial(), rest = bulk - law;
      EXPECT_NEAR(own.plate(artificial, law, rest), column.plate(artificial, law, rest), 0.03) << layers;
      EXPECT_NEAR(own.strip(artificial, law, rest), column.strip(artificial, law, rest), 0.03) << layers;
    }
  }
}

}  // namespace wall_column_test
