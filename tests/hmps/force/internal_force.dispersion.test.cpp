// SPDX-License-Identifier: MIT
// Plane waves in the infinite lattice, verification by an exact linear result: with
//   a = sum w r^2 / 3,  g = sum w sin(k.r) r_x / a,  q = (2 / a) sum w (1 - cos k.r)
// a wave along x has rho omega^2 = m g^2 + E_hat (q - g^2), where m is lambda + 2 mu for the longitudinal
// and mu for a transverse one.
#include <gtest/gtest.h>

#include <cmath>

#include "../../reference/scenes.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"

namespace internal_force_dispersion_test {

TEST(Dispersion, IsExactOnTheLattice) {
  constexpr double l0 = scenes::Scene<3>::spacing, lambda = 2e6, mu = 6.7e3, modulus = 2e4;
  // The force on the particle in the middle reaches two layers of neighbours: all are inside.
  const auto reference = scenes::box<3>({7, 7, 7});
  const std::size_t middle = 3 * 49 + 3 * 7 + 3;
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  auto force =
      hmps::internal_force(bonds, hmps::elastic(hmps::LinearElastic<double>{lambda, mu}), hmps::artificial(modulus));
  for (const double wavelengths : {40.0, 10.0, 5.0, 3.0, 2.0}) {
    const double k = 2 * std::acos(-1.0) / (wavelengths * l0);
    double a = 0, g = 0, q = 0;
    bonds.for_each_bond(middle, [&](auto, const auto& r, double w) {
      a += w * r.squaredNorm() / 3;
      g += w * std::sin(k * r[0]) * r[0];
      q += 2 * w * (1 - std::cos(k * r[0]));
    });
    g /= a;
    q /= a;
    for (int direction = 0; direction < 3; ++direction) {
      const double stiffness = (direction == 0 ? lambda + 2 * mu : mu) * g * g + modulus * (q - g * g);
      const double amplitude = 1e-3 * l0;
      scenes::Points<3> x = reference, f(x.size());
      for (auto& p : x) p[direction] += amplitude * std::cos(k * (p[0] - reference[middle][0]));
      force(hmps::vectors(x), hmps::vectors(f));
      // Positions of 0.1 m are rounded to 1e-17 m: relative to the amplitude, times the largest modulus.
      const double rounding = 100 * 1e-17 * 2e6 / (l0 * l0);
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(f[middle][d], d == direction ? -stiffness * amplitude : 0, rounding) << wavelengths << ' ' << d;
      EXPECT_GT(stiffness * amplitude, 10 * rounding) << "the test cannot fail";
    }
  }
}

}  // namespace internal_force_dispersion_test
