// SPDX-License-Identifier: MIT
#include "hmps/analysis/step_causes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/viscous.hpp"
#include "reference/scenes.hpp"

namespace step_causes_test {

using namespace hmps;

constexpr double density = 1000, young = 20e3, spacing = scenes::Scene<3>::spacing;

/// A cube of soft tissue, the parts of its force, and a wall of springs under its lowest layer.
struct Cube {
  scenes::Points<3> reference = scenes::box<3>({6, 6, 6}), v{reference.size(), Vector<double, 3>::Zero()};
  LatticeBonds<double, 3> bonds{vectors(reference), {.spacing = spacing}};
  double modulus, viscosity, penalty;
  InternalForce<LatticeBonds<double, 3>, Elastic<MooneyRivlin<>>> elastic_part{
      bonds, elastic(MooneyRivlin<>::from_young(young, 1e6))};
  InternalForce<LatticeBonds<double, 3>, Artificial<double>> stabiliser{bonds, artificial(modulus)};
  InternalForce<LatticeBonds<double, 3>, Viscous> viscous_part{bonds, viscous(density, viscosity)};
  struct Wall {
    double penalty, base;
    void operator()(const VectorView<const double, 3>& x, const VectorView<const double, 3>&,
                    const VectorView<double, 3>& f) const {
      for (std::size_t i = 0; i < x.size(); ++i)
        if (x(i, 2) < base + spacing / 2) f(i, 2) -= penalty * (x(i, 2) - base);
    }
  } wall{penalty, reference[0][2]};

  Cube(double e_hat, double nu, double k) : modulus(e_hat), viscosity(nu), penalty(k) {}

  [[nodiscard]] auto whole() {
    return [this, sum = reference](const auto& x, const auto& velocity, const auto& f) mutable {
      const auto add = [&](auto& part) {
        part(x, velocity, vectors(sum));
        for (std::size_t i = 0; i < sum.size(); ++i) f.add(i, sum[i]);
      };
      add(elastic_part);
      add(stabiliser);
      add(viscous_part);
      wall(x, velocity, f);
    };
  }
  [[nodiscard]] std::vector<StepCause> causes(StableStep& found) {
    auto force = whole();
    const StableStepSettings settings{.spacing = spacing};
    found = stable_step(force, vectors(reference), vectors(v), density, settings);
    return step_causes(found, vectors(reference), vectors(v), density, settings, NamedForce{"elastic", elastic_part},
                       NamedForce{"stabiliser", stabiliser}, NamedForce{"viscosity", viscous_part},
                       NamedForce{"contact", wall});
  }
};

TEST(StepCauses, TheStiffestPartIsNamedAndSharesAddUpToOne) {
  struct Case {
    double e_hat, nu, k;
    const char* cause;
  };
  for (const Case& c : {Case{young, 2e-3, 1, "elastic"}, Case{1000 * young, 2e-3, 1, "stabiliser"},
                        Case{young, 5, 1, "viscosity"}, Case{young, 2e-3, 5e14, "contact"}}) {
    SCOPED_TRACE(c.cause);
    Cube cube(c.e_hat, c.nu, c.k);
    StableStep found;
    const auto causes = cube.causes(found);
    ASSERT_EQ(causes.size(), 4u);
    EXPECT_EQ(causes[0].name, c.cause);
    EXPECT_GT(causes[0].share, 0.5);
    double sum = 0, k = 0, rate = 0;
    for (const StepCause& cause : causes) {
      sum += cause.share;
      k += cause.stiffness;
      rate += cause.damping;
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    EXPECT_NEAR(k, found.omega * found.omega, 1e-5 * k);
    EXPECT_NEAR(rate, found.damping, 1e-5 * rate);
    const std::string text = describe(found, causes, relative_support(cube.bonds, found.particle));
    EXPECT_NE(text.find(std::string(": ") + c.cause), std::string::npos) << text;
    EXPECT_NE(text.find("particle " + std::to_string(found.particle)), std::string::npos) << text;
  }
}

TEST(StepCauses, SupportIsOneInsideAHalfAtAFaceAndLessAtEdges) {
  const auto points = scenes::box<3>({7, 7, 7});
  const LatticeBonds<double, 3> lattice(vectors(points), {.spacing = spacing});
  const BondList<float, 3> list(vectors(points), {.spacing = spacing});
  const std::size_t inside = 3 * 49 + 3 * 7 + 3, face = 3 * 7 + 3, corner = 0;
  EXPECT_NEAR(relative_support(lattice, inside), 1.0, 1e-12);
  EXPECT_NEAR(relative_support(lattice, face), 0.5, 1e-12);
  EXPECT_NEAR(relative_support(list, inside), 1.0, 1e-6);
  EXPECT_NEAR(relative_support(list, face), 0.5, 1e-6);
  // For the corner's 7 bonds, with w at 1, sqrt 2 and sqrt 3 spacings, A = a 1 + b (ones - 1): the least eigenvalue is
  // a - b.
  const double w1 = 0.75, w2 = 1.75 / std::sqrt(2.0) - 1, w3 = 1.75 / std::sqrt(3.0) - 1;
  const double a = w1 + 2 * w2 + w3, b = w2 + w3, full = 2 * w1 + 8 * w2 + 8 * w3;
  EXPECT_NEAR(relative_support(lattice, corner), (a - b) / full, 1e-12);
  EXPECT_THROW((void)relative_support(lattice, points.size()), InputError);
}

TEST(StepCauses, BadInputIsRejectedAndNoLimitHasNoCause) {
  Cube cube(young, 2e-3, 1);
  const StableStepSettings settings{.spacing = spacing};
  StableStep unknown{.limit = 1e-5};
  EXPECT_THROW((void)step_causes(unknown, vectors(cube.reference), vectors(cube.v), density, settings,
                                 NamedForce{"elastic", cube.elastic_part}),
               InputError);
  const auto nothing = [](const auto&, const auto&, const auto&) {};
  const auto free = stable_step(nothing, vectors(cube.reference), vectors(cube.v), density, settings);
  EXPECT_TRUE(
      step_causes(free, vectors(cube.reference), vectors(cube.v), density, settings, NamedForce{"nothing", nothing})
          .empty());
}

// It makes trial displacements a thousand times as large.
// Earlier, velocities that are NaN passed, and a position that is NaN was blamed on particle 0.
TEST(StepCausesMisuse, NamesTheParticleWhosePositionOrVelocityIsNotFinite) {
  Cube cube(0, 0, 1e9);
  const StableStep found =
      stable_step(cube.wall, vectors(cube.reference), vectors(cube.v), density, {.spacing = spacing});
  const auto said = [&] {
    try {
      (void)step_causes(found, vectors(cube.reference), vectors(cube.v), density, {.spacing = spacing},
                        NamedForce{"wall", cube.wall});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  cube.v[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(said().find("velocity of particle 3"), std::string::npos) << said();
  cube.v[3][1] = 0;
  cube.reference[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(said().find("position of particle 3"), std::string::npos) << said();
}

TEST(StepCausesMisuse, ASpacingInMillimetresIsRefused) {
  Cube cube(5e3, 2e-3, 1e12);
  const auto x = vectors(cube.reference), v = vectors(cube.v);
  const StableStep found = stable_step(cube.elastic_part, x, v, density, {.spacing = spacing});
  const NamedForce part{"elastic", cube.elastic_part};
  EXPECT_THROW((void)stable_step(cube.elastic_part, x, v, density, {.spacing = 1e3 * spacing}), InputError);
  EXPECT_THROW((void)step_causes(found, x, v, density, {.spacing = 1e3 * spacing}, part), InputError);
}

TEST(StepCausesMisuse, IsRefused) {
  const std::vector<Vector<double, 3>> x(2, Vector<double, 3>::Ones()), v(2, Vector<double, 3>::Zero());
  const auto spring = [](const auto& at, const auto&, const auto& f) {
    for (std::size_t i = 0; i < f.size(); ++i) f.set(i, Vector<double, 3>(-1e6 * at[i]));
  };
  StableStep found = stable_step(spring, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3});
  EXPECT_NEAR(found.limit, 2 / std::sqrt(1e3), 1e-6);
  ForceFunction<double, 3> empty;
  const NamedForce whole{"whole", spring};
  EXPECT_EQ(step_causes(found, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3}, whole).size(), 1u);
  EXPECT_THROW((void)step_causes(found, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3}, whole, whole), InputError)
      << "the force twice";
  EXPECT_THROW((void)step_causes(found, vectors(x), vectors(v), 1.0, {.spacing = 1e-3}, whole), InputError)
      << "another density";
  const NamedForce missing{"missing", empty};
  EXPECT_THROW((void)step_causes(found, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3}, missing), InputError);
  // Trial displacements that vanish in the rounding of the positions.
  EXPECT_THROW((void)stable_step(spring, vectors(x), vectors(v), 1000.0, {.spacing = 1e-12}), InputError);
  StableStep halved = found;
  for (double& amplitude : halved.mode) amplitude /= 2;
  EXPECT_THROW((void)step_causes(halved, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3}, whole), InputError)
      << "a mode of another length";
  found.mode.assign(6, 0.0);
  const NamedForce part{"spring", spring};
  EXPECT_THROW((void)step_causes(found, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3}, part), InputError);
  found.mode[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)step_causes(found, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3}, part), InputError);
  EXPECT_THROW((void)stable_step(spring, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3, .start = found.mode}),
               InputError);
}

}  // namespace step_causes_test
