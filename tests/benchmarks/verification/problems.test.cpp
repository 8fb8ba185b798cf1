// SPDX-License-Identifier: MIT
// The verification suite at sizes of seconds.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "verification/page.hpp"
#include "verification/problems.hpp"
#include "verification/results.hpp"
#include "verification/support.hpp"

namespace problems_test {

using namespace verification;

std::vector<double> errors_of(const Problem& problem, int size, const Method& method) {
  const Trial trial = solve(problem, size, method);
  EXPECT_EQ(trial.failure, "") << problem.name;
  std::vector<double> errors;
  for (std::size_t q = 0; q < problem.quantities.size(); ++q)
    errors.push_back(problem.quantities[q].error(trial.measured.values[q]));
  return errors;
}

/// Where the strain is the same everywhere the method is right at any spacing. The bounds stand with the problems: some
/// roundings where nothing is solved, a multiple of the tolerance of the relaxation where something is.
TEST(Verification, IsExactForUniformStrain) {
  for (const Problem& problem : {affine_patch(), rigid_motion(), uniaxial_stress(), equibiaxial_stress(),
                                 simple_shear(), long_wall(), dispersion()})
    for (const Method& method : problem.methods) {
      const auto errors = errors_of(problem, problem.sizes.front(), method);
      for (std::size_t q = 0; q < errors.size(); ++q) {
        if (problem.quantities[q].bound > 0) {
          EXPECT_LE(std::abs(errors[q]), problem.quantities[q].bound)
              << problem.name << ", " << problem.quantities[q].name << ", " << method.name;
        }
      }
    }
}

/// A problem whose error falls with the spacing at least as fast as h^order, and where.
struct Falling {
  Problem (*problem)();
  const Method& method;
  int coarse, fine;
  double order;  ///< what docs/measured/verification.md has for these and finer spacings, rounded down to a half
};

/// The tolerance of the finer run is the error of the coarser one times the ratio of the spacings to the power of
/// the measured order.
TEST(Verification, ErrorsFallAtTheMeasuredOrder) {
  for (const Falling& one : {Falling{free_bar, paper, 3, 5, 2},
                             {bending_column, paper, 3, 5, 2},
                             {oscillating_plate, paper, 3, 5, 1.5},
                             {cantilever, paper, 3, 5, 1},
                             {bonded_shear, paper, 4, 6, 0.5},
                             {torsion, paper, 5, 8, 2},
                             {cooks_membrane, shear_wave, 12, 24, 1},
                             {sphere_on_block, paper, 6, 8, 1}}) {
    const Problem problem = one.problem();
    const Trial coarse = solve(problem, one.coarse, one.method), fine = solve(problem, one.fine, one.method);
    const double before = std::abs(problem.quantities[0].error(coarse.measured.values[0]));
    const double after = std::abs(problem.quantities[0].error(fine.measured.values[0]));
    EXPECT_LE(after, before * std::pow(fine.measured.spacing / coarse.measured.spacing, one.order)) << problem.name;
    EXPECT_GT(before, problem.quantities[0].resolution()) << problem.name << ": the test cannot fail";
  }
}

TEST(Verification, ShearWaveModulusIsMoreAccurateThanThePapers) {
  for (const auto& [make, size] : {std::pair<Problem (*)(), int>{free_bar, 4},
                                   {bending_column, 4},
                                   {bonded_shear, 5},
                                   {cantilever, 5},
                                   {oscillating_plate, 4},
                                   {thick_cylinder, 20}}) {
    const Problem problem = make();
    EXPECT_LT(std::abs(errors_of(problem, size, shear_wave)[0]), std::abs(errors_of(problem, size, paper)[0]))
        << problem.name;
  }
}
// Whatever their bulk modulus, three particles and more bend with 4/3 mu, two with mu. The last quantity is the
// torsion, whose error `bar_stabiliser` reduces to a third.
TEST(Verification, NearlyIncompressibleThinBarsVibrateCorrectly) {
  const Problem problem = rubber_bar();
  const auto errors_of_bending = [&](int size, const Method& method) {
    std::vector<double> errors = errors_of(problem, size, method);
    errors.pop_back();
    return errors;
  };
  for (const int size : {3, 4}) {
    for (const double error : errors_of_bending(size, mean_dilatation)) EXPECT_LT(std::abs(error), 0.02) << size;
    for (const double error : errors_of_bending(size, bar_mean_dilatation)) EXPECT_LT(std::abs(error), 0.04) << size;
    const double waves = errors_of(problem, size, mean_dilatation).back();
    EXPECT_GT(waves, 0.08) << size;
    EXPECT_LT(std::abs(errors_of(problem, size, bar_mean_dilatation).back()), waves / 3) << size;
  }
  for (const double error : errors_of_bending(2, soft)) EXPECT_LT(std::abs(error), 0.05);
  for (const int size : {2, 3})
    for (const double error : errors_of(problem, size, paper)) EXPECT_GT(error, 0.15) << size;
}
TEST(Verification, OneLayerOfHeldParticlesHoldsAFaceBetterThanTwo) {
  for (const auto& [make, size] : {std::pair<Problem (*)(), int>{oscillating_plate, 4},
                                   {bonded_shear, 5},
                                   {bending_column, 4},
                                   {cooks_membrane, 16}}) {
    const Problem problem = make();
    EXPECT_LT(std::abs(errors_of(problem, size, shear_wave)[0]), std::abs(errors_of(problem, size, two_layers)[0]))
        << problem.name;
  }
}

TEST(Order, IsThatOfAPowerLaw) {
  EXPECT_NEAR(order_between(0.2, 0.04, 0.1, 0.01), 2, 1e-12);
  EXPECT_NEAR(order_between(0.2, -0.02, 0.1, 0.01), 1, 1e-12);
  std::vector<double> spacings{0.5, 0.2, 0.1, 0.05}, errors;
  for (const double h : spacings) errors.push_back(-3 * std::pow(h, 1.5));
  EXPECT_NEAR(fitted_order(spacings, errors, 0), 1.5, 1e-12);
  // What lies within the answer's own error does not count.
  errors.back() *= 2;
  EXPECT_NEAR(fitted_order(spacings, errors, 0.07), 1.5, 1e-12);
  EXPECT_TRUE(std::isnan(fitted_order(spacings, errors, 0.2)));
  EXPECT_EQ(order_text({spacings, {1, -0.5, 0.2, 0.1}}, 0), "changes sign");
  EXPECT_EQ(order_text({spacings, errors}, 0.2), "within the answer's own error");
}

TEST(Table, IsReadBackAsItWasWritten) {
  Solved solved{rigid_motion(), {}};
  for (const int size : {6, 12}) solved.trials.push_back(solve(solved.problem, size, shear_wave));
  solved.trials.push_back(solved.trials.back());
  Trial& broken = solved.trials.back();
  broken.size = 18;
  broken.failure = "it \"broke\", alas";
  broken.measured.values.assign(2, std::nan(""));
  const auto back = read_trials(solved.problem, csv({solved}));
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(back[k].size, solved.trials[k].size);
    EXPECT_EQ(back[k].measured.spacing, solved.trials[k].measured.spacing);
    EXPECT_EQ(back[k].measured.particles, solved.trials[k].measured.particles);
    EXPECT_EQ(back[k].measured.values, solved.trials[k].measured.values);
  }
  EXPECT_EQ(back[2].failure, broken.failure);
  EXPECT_NE(page_of({{solved.problem, back}}).find("failed: it \"broke\", alas"), std::string::npos);
}

TEST(Support, DisplacementsAreRightForALinearField) {
  Body<3> body(0.1, cells<3>(0.1, {4, 3, 2}, 1));
  hmps::Matrix<double, 3> G;
  G << 0.1, 0.2, -0.3, 0.4, -0.1, 0.2, 0.0, 0.3, 0.5;
  const hmps::Vector<double, 3> shift(1, 2, 3);
  for (std::size_t i = 0; i < body.size(); ++i) body.position[i] += shift + G * body.reference[i];
  for (const hmps::Vector<double, 3>& point :
       {hmps::Vector<double, 3>(0.4, 0.3, 0.2), hmps::Vector<double, 3>(0, 0.15, 0.1),
        hmps::Vector<double, 3>(0.23, 0, 0)})
    EXPECT_LT((displacement_at<3>(body, {4, 3, 2}, point) - shift - G * point).norm(), 1e-12);
}

TEST(Support, CrossingsMeasureAPeriod) {
  Crossings crossings;
  int steps = 0;
  while (crossings.add(0.01 * steps, std::sin(0.01 * steps + 0.3), 3)) ++steps;
  EXPECT_NEAR(crossings.span(), 2 * std::acos(-1.0), 1e-5);
}

}  // namespace problems_test
