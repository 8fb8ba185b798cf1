// SPDX-License-Identifier: MIT
#include "hmps/laws/check_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "hmps/laws/continued.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/laws/saint_venant_kirchhoff.hpp"

namespace check_law_test {

using hmps::check_law;

/// Saint Venant-Kirchhoff's law without Poisson's effect, W = mu E : E, with typical mistakes of users.
struct Own {
  double factor = 2;  // of mu E in S
  double rest = 0;    // Pa, in S and in W
  template <class T, int D>
  hmps::Matrix<T, D> second_piola_kirchhoff(const hmps::Matrix<T, D>& C, const T&) const {
    hmps::Matrix<T, D> S;
    for (int k = 0; k < D * D; ++k) {
      const T unit(k % D == k / D ? 1.0 : 0.0);
      S(k % D, k / D) = T(factor * 1e3) * (C(k % D, k / D) - unit) * T(0.5) + T(rest) * unit;
    }
    return S;
  }
  template <class T, int D>
  T energy(const hmps::Matrix<T, D>& C, const T&) const {
    T sum(0);
    for (int k = 0; k < D * D; ++k) {
      const T strain = (C(k % D, k / D) - T(k % D == k / D ? 1.0 : 0.0)) * T(0.5);
      sum += T(1e3) * strain * strain + T(k % D == k / D ? rest : 0) * strain;
    }
    return sum;
  }
};

template <int D>
std::string error_of(const Own& law, const hmps::LawCheckSettings& settings = {}) {
  try {
    check_law<D>(law, settings);
  } catch (const hmps::InputError& error) {
    return error.what();
  }
  return {};
}

template <int D>
void pass_all() {
  check_law<D>(hmps::MooneyRivlin<>::from_young(20e3, 1e6));
  check_law<D>(hmps::NeoHookean<>::from_young_poisson(20e3, 0.49));
  check_law<D>(hmps::SaintVenantKirchhoff<>::from_young_poisson(20e3, 0.3));
  check_law<D>(hmps::LinearElastic<>::from_young_poisson(20e3, 0.3));
  check_law<D>(hmps::Continued{hmps::MooneyRivlin<>::from_young(20e3, 1e6), 0.9});
  check_law<D>(Own{});
}
TEST(CheckLaw, PassesTheLawsOfTheLibrary) {
  EXPECT_NO_THROW(pass_all<2>());
  EXPECT_NO_THROW(pass_all<3>());
}

TEST(CheckLaw, NamesAFactorThatOnlyOneFormulaHas) {
  EXPECT_NE(error_of<3>({.factor = 1}).find("is not the derivative of its energy: at F = "), std::string::npos);
  EXPECT_NE(error_of<2>({.factor = 2.00001}).find("is not the derivative"), std::string::npos);
  EXPECT_EQ(error_of<2>({.factor = 2.00001}, {.tolerance = 1e-4}), "");
}

TEST(CheckLaw, NamesAnUnintendedStressAtRest) {
  EXPECT_NE(error_of<3>({.rest = 1}).find("at F = 1, so that a body deforms before any load"), std::string::npos);
  EXPECT_EQ(error_of<3>({.rest = 1}, {.prestressed = true}), "");
}

TEST(CheckLaw, RejectsNonFiniteValuesAndSettingsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of<3>({.factor = nan}), "");
  EXPECT_NE(error_of<3>({.rest = nan}, {.prestressed = true}), "");
  for (const double strain : {0.0, -0.1, 0.3, nan})
    EXPECT_NE(error_of<3>({}, {.strain = strain}).find("must be above 0"), std::string::npos) << strain;
}

// Five for five per cent would pass every law.
TEST(CheckLaw, RejectsATolerancePerCent) {
  for (const double tolerance : {5.0, 0.2, 0.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(error_of<3>({}, {.tolerance = tolerance}).find("at most 0.1"), std::string::npos) << tolerance;
}

}  // namespace check_law_test
