// SPDX-License-Identifier: MIT
#include "hmps/terms/shear_wave_modulus.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "sheets.hpp"

namespace shear_wave_modulus_test {

using namespace sheets;

TEST(ShearWaveModulus, IsFourThirdsOfTheShearModulus) {
  EXPECT_DOUBLE_EQ(hmps::shear_wave_modulus(3.0), 4.0);
  EXPECT_FLOAT_EQ(hmps::shear_wave_modulus(3.0F), 4.0F);
}

// With this modulus the frequency of long shear waves inside a body is exact to fourth order, with others to second,
// whatever the radius and the direction.
TEST(ShearWaveModulus, RaisesTheOrderOfShearWavesFromTwoToFour) {
  for (const double radius : {1.75, 2.3}) {
    const int reach = 2 * static_cast<int>(radius);
    std::vector<Vector> points;
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        for (int z = -reach; z <= reach; ++z) points.emplace_back(x, y, z);
    const hmps::BondList<double, 3> bonds(hmps::vectors(points), {.spacing = 1, .radius_ratio = radius});
    const std::size_t middle = points.size() / 2;
    for (const Vector& along : {Vector(1, 0, 0), Vector(1, 1, 0), Vector(2, 1, 0)})
      for (const double modulus : {hmps::shear_wave_modulus(1.0), 2.0}) {
        auto force = hmps::internal_force(bonds, hmps::elastic(material(30)), hmps::artificial(modulus));
        const auto error = [&](double k) {
          std::vector<Vector> x = points, f(points.size());
          for (auto& p : x) p[2] += std::cos(k * along.normalized().dot(p));
          force(hmps::vectors(x), hmps::vectors(f));
          return std::abs(std::sqrt(-f[middle][2]) / k - 1);
        };
        const double order = std::log2(error(0.2) / error(0.1));
        // The next term of the error is smaller by k^2 m, which changes the order by less than 0.1 here.
        EXPECT_NEAR(order, modulus == 2.0 ? 2 : 4, 0.1) << radius << ' ' << along.transpose() << ' ' << modulus;
      }
  }
}

// Prints the table in docs/theory.md.
TEST(ShearWaveModulus, BendsSheetsOfThreeParticlesAndMoreWithinTwoPerCent) {
  std::printf("| kappa/mu | layers | E_hat = 0 | E/2 | 4/3 mu | E | 4/3 mu, 45 degrees | 4/3 mu, kh = 1.5 |\n");
  for (const double bulk : {3.0, 30.0, 300.0})
    for (const int layers : {2, 3, 4, 5, 8}) {
      const double young = 9 * bulk / (3 * bulk + 1), h = layers;
      const Sheet sheet(layers, 1.75);
      const auto error = [&](double kh, const Vector& along, double modulus) {
        return sheet.bending(kh / h * along.normalized(), hmps::elastic(material(bulk)), hmps::artificial(modulus)) /
                   plate(kh / h, h, bulk) -
               1;
      };
      const Vector x(1, 0, 0), diagonal(1, 1, 0);
      const double chosen = error(slender, x, hmps::shear_wave_modulus(1.0));
      const double turned = error(slender, diagonal, hmps::shear_wave_modulus(1.0));
      std::printf("| %.0f | %d | %+.1f | %+.1f | %+.1f | %+.1f | %+.1f | %+.1f |\n", bulk, layers,
                  100 * error(slender, x, 0), 100 * error(slender, x, young / 2), 100 * chosen,
                  100 * error(slender, x, young), 100 * turned, 100 * error(1.5, x, hmps::shear_wave_modulus(1.0)));
      // Sheets of an even number of layers lock when their volume is stiff, with any stabiliser: see docs/theory.md.
      if (layers < 3 || (layers % 2 == 0 && bulk > 3)) continue;
      EXPECT_LT(std::abs(chosen), 0.02) << bulk << ' ' << layers;
      EXPECT_LT(std::abs(turned), 0.02) << bulk << ' ' << layers;
      EXPECT_GT(error(slender, x, young), 0.02) << "the paper's choice would pass too";
    }
}

// Motions of a few spacings cost energy, while without a stabiliser some cost none; and no motion is stiffer than with
// the paper's E, so that the stable step is no smaller.
TEST(ShearWaveModulus, LeavesNoSpuriousModeAndNoSmallerStep) {
  for (const double bulk : {3.0, 300.0})
    for (const int layers : {2, 3, 5}) {
      const Sheet sheet(layers, 1.75);
      const auto extremes = [&](double modulus) {
        double least = std::numeric_limits<double>::infinity(), largest = 0;
        for (int a = 0; a <= 4; ++a)
          for (int b = 0; b <= a; ++b) {
            const double pi = std::acos(-1.0);
            if (a < 2) continue;  // wavelengths above four spacings
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> modes(
                sheet.stiffness({pi * a / 4, pi * b / 4, 0}, hmps::elastic(material(bulk)), hmps::artificial(modulus)),
                Eigen::EigenvaluesOnly);
            least = std::min(least, modes.eigenvalues().minCoeff());
            largest = std::max(largest, modes.eigenvalues().maxCoeff());
          }
        return std::pair(least, largest);
      };
      const auto none = extremes(0), chosen = extremes(hmps::shear_wave_modulus(1.0)),
                 paper = extremes(9 * bulk / (3 * bulk + 1));
      EXPECT_GT(chosen.first, 0.5) << bulk << ' ' << layers;
      EXPECT_LT(none.first, 0.5) << bulk << ' ' << layers;
      EXPECT_LT(chosen.second, paper.second) << bulk << ' ' << layers;
    }
}

}  // namespace shear_wave_modulus_test
