// SPDX-License-Identifier: MIT
#include "hmps/terms/edge_stabiliser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "hmps/analysis/relaxation.hpp"
#include "hmps/analysis/stable_step.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/particles/fitted.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/artificial_tension.hpp"
#include "hmps/terms/bar_stabiliser.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/shear_wave_modulus.hpp"
#include "hmps/terms/thin_wall_stabiliser.hpp"

namespace edge_stabiliser_test {

using Vector = hmps::Vector<double, 3>;

TEST(EdgeStabiliser, IsThatOfABarAtAnEdgeAndThatOfTheWallElsewhere) {
  const double wave = hmps::shear_wave_modulus(3.0);
  const auto chosen = hmps::edge_stabiliser(std::vector<double>{wave, wave, wave}, std::vector<float>{0, 0.5, 1});
  const auto bar = hmps::bar_stabiliser(3.0);
  EXPECT_EQ(chosen.moduli[0], wave);
  EXPECT_EQ(chosen.tension[0], 0);
  EXPECT_DOUBLE_EQ(chosen.moduli[1], (wave + bar.modulus) / 2);
  EXPECT_DOUBLE_EQ(chosen.tension[1], bar.tension / 2);
  EXPECT_DOUBLE_EQ(chosen.moduli[2], bar.modulus);
  EXPECT_DOUBLE_EQ(chosen.tension[2], bar.tension);
}

TEST(EdgeStabiliser, NamesTheInvalidArgument) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto error = [](const std::vector<double>& moduli, const std::vector<double>& edges) -> std::string {
    try {
      (void)hmps::edge_stabiliser(moduli, edges);
    } catch (const hmps::InputError& caught) {
      return caught.what();
    }
    return "";
  };
  EXPECT_NE(error({1, 1}, {0}).find("2 particles"), std::string::npos);
  for (const double bad : {-1e-3, 1.001, nan, infinity})
    EXPECT_NE(error({1, 1}, {0, bad}).find("the edge at particle 1 is"), std::string::npos) << bad;
  for (const double bad : {-1.0, 0.0, nan, infinity})
    EXPECT_NE(error({1, bad}, {0, 0}).find("E_hat of particle 1 is"), std::string::npos) << bad;
  EXPECT_EQ(error({1, 1}, {0, 1}), "");
}

/// A strip of 18 x 4.8 mm with two layers, `length` long between held pieces, turned against the axes.
struct Strip {
  static constexpr double l0 = 2.4e-3, width = 18e-3, wall = 4.8e-3, length = 36e-3;
  hmps::MooneyRivlin<> law = hmps::MooneyRivlin<>::from_young(100e3, 1e6);
  hmps::Matrix<double, 3> axes = Eigen::AngleAxisd(0.6, Vector(0.3, -0.5, 0.8).normalized()).matrix();
  hmps::FittedParticles<double, 3> body;
  std::size_t moving = 0, held = 0;
  hmps::ThinWallStabiliser<double> walls;

  Strip() {
    const double clamp = length / 2 - l0 / 2;
    body = fit(-clamp, clamp);
    moving = body.size();
    body.append(fit(-clamp - 3 * l0, -clamp));
    held = body.size();
    body.append(fit(clamp, clamp + 3 * l0));
    walls = hmps::thin_wall_stabiliser(body.layers, body.layer_spacings, l0, law.bulk_modulus(), law.shear_modulus());
  }
  [[nodiscard]] hmps::FittedParticles<double, 3> fit(double from, double to) const {
    const hmps::Box<double, 3> part{Vector(from, -width / 2, -wall / 2), Vector(to, width / 2, wall / 2)};
    return hmps::fit_particles(hmps::rotated(part, axes),
                               hmps::Box<double, 3>{Vector::Constant(-0.04), Vector::Constant(0.04)}, l0);
  }
  template <class... Terms>
  [[nodiscard]] auto force(const hmps::BondList<double, 3>& bonds, const Terms&... terms) const {
    return hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>{law.c1, law.c2, walls.bulk.law / 2}),
                                hmps::mean_dilatation<2>(walls.bulk.mean), terms...);
  }
  /// The torque in Nm of `force` at which the ends are turned by 0.02 against each other.
  template <class Force>
  [[nodiscard]] double torque(Force force) const {
    std::vector<Vector> x = body.positions, v(x.size(), Vector::Zero()), f = v;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vector X = axes.transpose() * body.positions[i];
      x[i] += axes * Vector(0, -X[2], X[1]) * (0.02 * std::clamp(X[0] / length, -0.5, 0.5));
    }
    hmps::relax(force, hmps::vectors(x), hmps::vectors(v), hmps::vectors(f), 1000.0,
                {.spacing = l0, .tolerance = 1e-3, .load = 5e-3, .moves = [&](std::size_t i) { return i < moving; }});
    force(hmps::vectors(x), hmps::vectors(v), hmps::vectors(f));
    Vector sum = Vector::Zero();
    for (std::size_t i = held; i < x.size(); ++i) sum += std::pow(l0, 3) * x[i].cross(f[i]);
    return -sum.dot(axes.col(0));
  }
  template <class Force>
  [[nodiscard]] double step(Force force) const {
    const std::vector<Vector> v(body.size(), Vector::Zero());
    return hmps::stable_step(force, hmps::vectors(body.positions), hmps::vectors(v), 1000.0, {.spacing = l0}).limit;
  }
};

// The answer of finite elements is 13.17 uNm (bodies.py of benchmarks/fitted, with another length of the strip). The
// stabiliser of the wall alone misses it by 6 %. In nearly incompressible tissue the step stays.
TEST(EdgeStabiliser, LetsANarrowStripTwist) {
  const Strip strip;
  const hmps::BondList<double, 3> bonds(hmps::vectors(strip.body.positions), {.spacing = Strip::l0});
  const auto [E_hat, tension] = hmps::edge_stabiliser(strip.walls.moduli, strip.body.edges);
  const auto of_wall = strip.force(bonds, hmps::artificial(hmps::scalars(strip.walls.moduli)));
  const auto of_edges =
      strip.force(bonds, hmps::artificial(hmps::scalars(E_hat)), hmps::artificial_tension(hmps::scalars(tension)));
  constexpr double answer = 13.17e-6;
  EXPECT_GT(strip.torque(of_wall), 1.05 * answer);
  EXPECT_NEAR(strip.torque(of_edges), answer, 0.035 * answer);
  EXPECT_NEAR(strip.step(of_edges) / strip.step(of_wall), 1, 0.03);
}

}  // namespace edge_stabiliser_test
