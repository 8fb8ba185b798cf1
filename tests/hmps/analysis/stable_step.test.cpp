// SPDX-License-Identifier: MIT
#include "hmps/analysis/stable_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/contact/contact.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/viscous.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace stable_step_test {

using namespace hmps;

/// Particles on a line of spacing 1 mm, each held to the next by a spring (N/m3 per m) along x, and
/// by a weaker one across: the force density on particle i is s (u_{i+1} - u_i) - s (u_i - u_{i-1}),
/// with damping of the same form. Eigenvalues are known: 4 s / rho sin^2(pi m / (2 n)), m < n.
template <class T, int D>
struct Chain {
  std::size_t n = 40;
  double spacing = 1e-3;
  double stiffness = 1e9;
  double damping = 0;

  [[nodiscard]] std::vector<Vector<T, D>> positions() const {
    std::vector<Vector<T, D>> x(n, Vector<T, D>::Zero());
    for (std::size_t i = 0; i < n; ++i) x[i][0] = static_cast<T>(spacing * static_cast<double>(i));
    return x;
  }
  [[nodiscard]] double largest_eigenvalue() const {
    const double count = static_cast<double>(n);
    const double sine = std::sin(std::numbers::pi * (count - 1) / (2 * count));
    return 4 * sine * sine;
  }
  template <class F>
  void operator()(const VectorView<const T, D>& x, const VectorView<const T, D>& v, const VectorView<F, D>& f) const {
    for (std::size_t i = 0; i < n; ++i) {
      for (int c = 0; c < D; ++c) {
        double sum = 0;
        for (const int side : {-1, 1}) {
          if ((i == 0 && side < 0) || (i + 1 == n && side > 0)) continue;
          const std::size_t j = side < 0 ? i - 1 : i + 1;
          const double rest = c == 0 ? side * spacing : 0.0;
          const double weight = c == 0 ? 1.0 : 0.1;
          sum += weight * stiffness * (static_cast<double>(x(j, c)) - static_cast<double>(x(i, c)) - rest);
          sum += weight * damping * (static_cast<double>(v(j, c)) - static_cast<double>(v(i, c)));
        }
        f(i, c) = static_cast<T>(static_cast<double>(f(i, c)) + sum);
      }
    }
  }
};

template <class T, int N>
struct Kind {
  using Scalar = T;
  static constexpr int D = N;
};
using Kinds = testing::Types<Kind<double, 2>, Kind<double, 3>, Kind<float, 2>, Kind<float, 3>>;

template <class K>
struct StableStepOf : testing::Test {
  /// The accuracy of the linear force in T: the rounding of positions relative to trial displacements.
  static constexpr double exactness = sizeof(typename K::Scalar) > 4 ? 1e-6 : 2e-3;
};
TYPED_TEST_SUITE(StableStepOf, Kinds);

void expect_safe(const StableStep& found, double limit, double exactness) {
  EXPECT_TRUE(found.converged);
  // The Rayleigh quotient errs to one side, and by no more than the residual asked for (2 %).
  EXPECT_GT(found.limit, limit * (1 - exactness));
  EXPECT_LT(found.limit, limit * 1.02);
  EXPECT_LT(found.step, limit);
  EXPECT_GT(found.step, 0.9 * limit);
}

TYPED_TEST(StableStepOf, ChainOfSpringsIsBelowItsExactLimit) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  for (const std::size_t n : {2u, 3u, 10u, 400u}) {
    Chain<T, D> chain{.n = n};
    auto x = chain.positions();
    std::vector<Vector<T, D>> v(n, Vector<T, D>::Zero());
    const double density = 1000;
    const double omega = std::sqrt(chain.stiffness / density * chain.largest_eigenvalue());
    const StableStep found = stable_step(chain, vectors(x), vectors(v), density, {.spacing = chain.spacing});
    SCOPED_TRACE(n);
    expect_safe(found, 2 / omega, TestFixture::exactness);
    EXPECT_NEAR(found.omega, omega, 0.02 * omega);
    EXPECT_EQ(found.damping, 0.0);
  }
}

TYPED_TEST(StableStepOf, ReportsProgress) {
  using T = typename TypeParam::Scalar;
  Chain<T, TypeParam::D> chain;
  const auto x = chain.positions();
  const std::vector<Vector<T, TypeParam::D>> v(chain.n, Vector<T, TypeParam::D>::Zero());
  std::vector<double> limits;
  const auto progress = [&](const StableStep& now) {
    EXPECT_EQ(static_cast<std::size_t>(now.iterations), limits.size() + 1);
    limits.push_back(now.limit);
    if (limits.size() == 3) throw std::runtime_error("enough");
  };
  EXPECT_THROW(
      (void)stable_step(chain, vectors(x), vectors(v), 1000.0, {.spacing = chain.spacing, .progress = progress}),
      std::runtime_error);
  ASSERT_EQ(limits.size(), 3u);
  EXPECT_GT(limits[0], limits[2]);
}

TYPED_TEST(StableStepOf, DampedChainIsBelowTheJointLimit) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  // Stiffness and damping share their eigenvectors, so one mode decides: dt^2 k + 2 dt c = 4.
  for (const double damping : {1e3, 1e6, 1e8}) {
    Chain<T, D> chain{.n = 60, .damping = damping};
    auto x = chain.positions();
    std::vector<Vector<T, D>> v(chain.n, Vector<T, D>::Zero());
    const double density = 1000;
    const double k = chain.stiffness / density * chain.largest_eigenvalue();
    const double c = damping / density * chain.largest_eigenvalue();
    const double limit = (std::sqrt(c * c + 4 * k) - c) / k;
    const StableStep found = stable_step(chain, vectors(x), vectors(v), density, {.spacing = chain.spacing});
    SCOPED_TRACE(damping);
    expect_safe(found, limit, TestFixture::exactness);
    EXPECT_NEAR(found.damping, c, 0.03 * c);
  }
}

TYPED_TEST(StableStepOf, LightParticleIsFoundAndNamed) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  Chain<T, D> chain{.n = 2000};
  auto x = chain.positions();
  std::vector<Vector<T, D>> v(chain.n, Vector<T, D>::Zero());
  std::vector<T> density(chain.n, T(1000));
  density[1234] = T(100);
  const StableStep found = stable_step(chain, vectors(x), vectors(v), scalars(density), {.spacing = chain.spacing});
  EXPECT_EQ(found.particle, 1234u);
  EXPECT_GT(found.share, 0.5);
  EXPECT_LT(found.participation, 3.0);
  // A light mass m among masses M on a chain: the localised mode has omega^2 = 4 s / (m (2 - m / M)).
  const double omega = std::sqrt(4 * chain.stiffness / (100 * (2 - 0.1)));
  expect_safe(found, 2 / omega, TestFixture::exactness);
}

TYPED_TEST(StableStepOf, StepAboveTheLimitBlowsUpAndBelowHolds) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  Chain<T, D> chain{.n = 30, .damping = 3e5};
  auto x0 = chain.positions();
  std::vector<Vector<T, D>> v0(chain.n, Vector<T, D>::Zero());
  const StableStep found = stable_step(chain, vectors(x0), vectors(v0), 1000.0, {.spacing = chain.spacing});
  const auto speed_after = [&](double dt) {
    auto x = x0;
    auto v = v0;
    for (std::size_t i = 0; i < chain.n; ++i) v[i][0] = static_cast<T>(1e-6 * detail::noise(i));
    std::vector<Vector<T, D>> f(chain.n);
    for (int step = 0; step < 2000; ++step) {
      for (auto& force : f) force.setZero();
      chain(VectorView<const T, D>(vectors(x)), VectorView<const T, D>(vectors(v)), vectors(f));
      for (std::size_t i = 0; i < chain.n; ++i) {
        v[i] += f[i] * static_cast<T>(dt / 1000.0);
        x[i] += v[i] * static_cast<T>(dt);
      }
    }
    double fastest = 0;
    for (const auto& velocity : v) {
      const auto speed = static_cast<double>(velocity.norm());
      fastest = std::isfinite(speed) ? std::max(fastest, speed) : std::numeric_limits<double>::infinity();
      if (!std::isfinite(speed)) break;
    }
    return fastest;
  };
  EXPECT_LT(speed_after(found.step), 1e-2);
  EXPECT_GT(speed_after(1.1 * found.step), 1e2);
}

TEST(StableStep, DoesNotChangeTheStateAndRepeats) {
  Chain<double, 3> chain;
  auto x = chain.positions();
  std::vector<Vector<double, 3>> v(chain.n, Vector<double, 3>::Constant(0.5));
  const auto x_before = x;
  const auto v_before = v;
  const auto first = stable_step(chain, vectors(x), vectors(v), 1000.0, {.spacing = chain.spacing});
  const auto backwards = [](std::size_t n, auto&& body) {
    for (std::size_t i = n; i-- > 0;) body(i);
  };
  const auto second = stable_step(chain, vectors(x), vectors(v), 1000.0, {.spacing = chain.spacing}, backwards);
  EXPECT_EQ(x, x_before);
  EXPECT_EQ(v, v_before);
  EXPECT_EQ(first.step, second.step);
  EXPECT_EQ(first.particle, second.particle);
  EXPECT_EQ(first.iterations, second.iterations);
}

TEST(StableStep, IgnoresFixedParticles) {
  Chain<double, 2> chain{.n = 50};
  auto x = chain.positions();
  std::vector<Vector<double, 2>> v(chain.n, Vector<double, 2>::Zero());
  // One particle between fixed ones: omega^2 = 2 s / rho.
  const auto found = stable_step(chain, vectors(x), vectors(v), 1000.0,
                                 {.spacing = chain.spacing, .moves = [](std::size_t i) { return i == 20; }});
  expect_safe(found, 2 / std::sqrt(2 * chain.stiffness / 1000), 1e-6);
  EXPECT_EQ(found.particle, 20u);
  EXPECT_NEAR(found.share, 1.0, 1e-12);
  EXPECT_THROW((void)stable_step(chain, vectors(x), vectors(v), 1000.0,
                                 {.spacing = chain.spacing, .moves = [](std::size_t) { return false; }}),
               InputError);
}

// Forces of particles with different volumes are symmetric only when multiplied by the volumes; the motion itself
// decides.
TEST(StableStep, HoldsForParticlesOfDifferentVolumes) {
  constexpr double l0 = 1e-3, rho = 1000;
  std::vector<Vector<double, 2>> X;
  std::vector<double> volumes;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 8; ++j) {
      X.emplace_back(l0 * i, l0 * j);
      volumes.push_back(l0 * l0 * (0.5 + (7 * i + 5 * j) % 11 / 10.0));
    }
  const BondList<double, 2> bonds(vectors(X), {.spacing = l0}, scalars(volumes));
  auto force = internal_force(bonds, elastic(MooneyRivlin<>{1700, 1500, 1e4}), artificial(2e4), viscous(rho, 2e-4));
  auto x = X, v = X, f = X;
  for (auto& speed : v) speed.setZero();
  const auto found = stable_step(force, vectors(x), vectors(v), rho, {.spacing = l0});
  /// The largest displacement in spacings after a jolt of a billionth.
  const auto moved = [&](double dt) {
    x = X;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i][0] += 1e-9 * l0 * static_cast<double>(i % 3);
      v[i].setZero();
    }
    double most = 0;
    for (int step = 0; step < 400 && most < 1; ++step) {
      force(vectors(x), vectors(v), vectors(f));
      kick(vectors(v), vectors(f), rho, dt);
      drift(vectors(x), vectors(v), dt);
      for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - X[i]).norm() / l0);
    }
    return most;
  };
  EXPECT_LT(moved(0.99 * found.limit), 1e-6);
  EXPECT_GT(moved(1.03 * found.limit), 1e-3);
}

TEST(StableStep, RefreshFollowsAChangeInFewEvaluations) {
  // Springs of a slowly softening and then stiffening chain with a light particle, whose limit is known.
  Chain<double, 3> chain{.n = 2000};
  auto x = chain.positions();
  std::vector<Vector<double, 3>> v(chain.n, Vector<double, 3>::Zero());
  std::vector<double> density(chain.n, 1000.0);
  density[1234] = 100;
  StableStepSettings settings{.spacing = chain.spacing};
  StableStep found = stable_step(chain, vectors(x), vectors(v), scalars(density), settings);
  const int cold = found.evaluations;
  for (int k = 1; k <= 20; ++k) {
    chain.stiffness *= k < 10 ? 0.95 : 1.1;
    const std::vector<double> mode = found.mode;
    settings.start = mode;
    settings.seed = static_cast<std::uint64_t>(k + 1);
    found = stable_step(chain, vectors(x), vectors(v), scalars(density), settings);
    SCOPED_TRACE(k);
    EXPECT_EQ(found.particle, 1234u);
    expect_safe(found, 2 / std::sqrt(4 * chain.stiffness / (100 * (2 - 0.1))), 1e-6);
    EXPECT_LE(found.evaluations, 14);
    EXPECT_LT(found.evaluations, cold);
  }
}

TEST(StableStep, RefreshesSeeAModeThatAppearsElsewhere) {
  Chain<double, 3> chain{.n = 2000};
  auto x = chain.positions();
  std::vector<Vector<double, 3>> v(chain.n, Vector<double, 3>::Zero());
  std::vector<double> density(chain.n, 1000.0);
  density[1234] = 100;
  StableStepSettings settings{.spacing = chain.spacing};
  StableStep found = stable_step(chain, vectors(x), vectors(v), scalars(density), settings);
  density[77] = 40;
  const double limit = 2 / std::sqrt(4 * chain.stiffness / (40 * (2 - 0.04)));
  int refreshes = 0;
  for (; refreshes < 50 && found.particle != 77; ++refreshes) {
    const std::vector<double> mode = found.mode;
    settings.start = mode;
    ++settings.seed;
    found = stable_step(chain, vectors(x), vectors(v), scalars(density), settings);
  }
  EXPECT_LE(refreshes, 3);  // of one before it happened, at a stiffness 2.5 times that of the earlier mode
  expect_safe(found, limit, 1e-6);
}

TEST(StableStep, HasNoLimitWithoutForces) {
  std::vector<Vector<double, 2>> x(5, Vector<double, 2>::Zero());
  const auto nothing = [](const auto&, const auto&, const auto&) {};
  const auto found = stable_step(nothing, vectors(x), vectors(x), 1000.0, {.spacing = 1.0});
  EXPECT_EQ(found.limit, std::numeric_limits<double>::infinity());
  EXPECT_EQ(found.step, std::numeric_limits<double>::infinity());
}

TEST(StableStep, DampingAloneLimitsToTwoOverItsRate) {
  std::vector<Vector<double, 2>> x(5, Vector<double, 2>::Zero());
  const auto drag = [](const auto&, const auto& v, const auto& f) {
    for (std::size_t i = 0; i < v.size(); ++i) f.set(i, v[i] * (-3000.0));
  };
  const auto found = stable_step(drag, vectors(x), vectors(x), 1000.0, {.spacing = 1.0});
  EXPECT_NEAR(found.limit, 2.0 / 3.0, 1e-6);
}

TEST(StableStep, BadInputIsRefused) {
  Chain<double, 2> chain{.n = 4};
  auto x = chain.positions();
  std::vector<Vector<double, 2>> v(4, Vector<double, 2>::Zero()), few(3, Vector<double, 2>::Zero());
  EXPECT_THROW((void)stable_step(chain, vectors(x), vectors(v), 1000.0, {}), InputError);
  EXPECT_THROW((void)stable_step(chain, vectors(x), vectors(few), 1000.0, {.spacing = 1e-3}), InputError);
  EXPECT_THROW((void)stable_step(chain, vectors(x), vectors(v), -1.0, {.spacing = 1e-3}), InputError);
  EXPECT_THROW((void)stable_step(chain, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3, .margin = 1.0}), InputError);
  EXPECT_THROW((void)stable_step(chain, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3, .tolerance = 0}), InputError);
  const std::vector<double> other(6, 0.1);
  EXPECT_THROW((void)stable_step(chain, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3, .start = other}), InputError);
  EXPECT_THROW((void)stable_step(chain, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3, .refresh_iterations = 0}),
               InputError);
  const auto broken = [](const auto&, const auto&, const auto& f) { f(2, 0) = std::nan(""); };
  try {
    (void)stable_step(broken, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3});
    FAIL() << "a force of NaN went unnoticed";
  } catch (const StateError& error) {
    EXPECT_NE(std::string(error.what()).find("particle 2"), std::string::npos) << error.what();
  }
}

// Earlier, the error said that a finite force is not finite.
TEST(StableStep, NamesDensitiesAndModesThatAreTooSmallOrTooLarge) {
  std::vector<Vector<double, 3>> x{{0, 0, 0}, {1e-3, 0, 0}};
  const std::vector<Vector<double, 3>> v(2, Vector<double, 3>::Zero());
  const auto springs = [&](const auto& at, const auto&, const auto& f) {
    for (std::size_t i = 0; i < 2; ++i) f.set(i, Vector<double, 3>(-1e6 * (at[i] - x[i])));
  };
  const auto said = [&](double density, const StableStepSettings& settings) {
    try {
      (void)stable_step(springs, vectors(x), vectors(v), density, settings);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const std::string light = said(1e-300, {.spacing = 1e-3});
  EXPECT_NE(light.find("a stiffness at particle 0, whose density is 1e-300 kg/m3"), std::string::npos) << light;
  const std::string large = said(1000, {.spacing = 1e-3, .start = std::vector<double>(6, 1e300)});
  EXPECT_NE(large.find("number 0 of the mode that stable_step starts from is 1e+300"), std::string::npos) << large;
}

TEST(StableStep, RefusesAnEmptyFunction) {
  const std::vector<Vector<double, 2>> x{{0, 0}, {1e-3, 0}}, v(2, Vector<double, 2>::Zero());
  ForceFunction<double, 2> force;
  EXPECT_THROW((void)stable_step(force, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3}), InputError);
  force = [](const auto&, const auto&, const auto&) {};
  EXPECT_NO_THROW((void)stable_step(force, vectors(x), vectors(v), 1000.0, {.spacing = 1e-3}));
}

/// A lattice of `along` x 5 x 5 particles.
std::vector<Vector<double, 3>> block(int along, double l0) {
  const Box<double, 3> box{Vector<double, 3>::Zero(), Vector<double, 3>(along * l0, 5 * l0, 5 * l0)};
  return fill_lattice(box, l0, Vector<double, 3>(Vector<double, 3>::Constant(l0 / 2)));
}

/// Earlier, trial motions had the size that suits the positions, and vanished in the rounding of float bonds: viscosity
/// was missed in moving bodies.
TEST(StableStep, SeesViscosityThroughFloatBondsOfAMovingBody) {
  const double l0 = 1.2e-3, rho = 1000;
  const std::vector<Vector<double, 3>> X = block(6, l0);
  const LatticeBonds<double, 3> exact(vectors(X), {.spacing = l0});
  const LatticeBonds<float, 3> coarse(vectors(X), {.spacing = l0});
  for (const double nu : {2e-3, 0.2}) {
    const auto step = [&](const auto& bonds, double speed, double angle) {
      std::vector<Vector<double, 3>> x = X, v(X.size(), speed * Vector<double, 3>(3, -2, 1));
      for (Vector<double, 3>& at : x) at = Eigen::AngleAxisd(angle, Vector<double, 3>::UnitY()) * at;
      auto force =
          internal_force(bonds, elastic(MooneyRivlin<>::from_young(20e3, 1e6)), artificial(10e3), viscous(rho, nu));
      return stable_step(force, vectors(x), vectors(v), rho, {.spacing = l0});
    };
    const StableStep right = step(exact, 0, 0);
    EXPECT_NEAR(right.perturbation, 1e-5, 1e-12);
    for (const double speed : {0., 0.1, 1., 10.})
      for (const double angle : {0., 2.}) {
        const StableStep found = step(coarse, speed, angle);
        EXPECT_TRUE(found.converged) << speed;
        EXPECT_NEAR(found.limit, right.limit, 0.01 * right.limit) << speed << " m/s, turned by " << angle;
        EXPECT_NEAR(found.damping, right.damping, 0.02 * right.damping) << speed << " m/s, turned by " << angle;
      }
  }
}

/// Viscosity alone: no stiffness says how large trial velocities may be.
TEST(StableStep, SeesViscosityAloneThroughFloatBondsOfAMovingBody) {
  const double l0 = 1.2e-3, rho = 1000;
  const std::vector<Vector<double, 3>> X = block(5, l0);
  const LatticeBonds<float, 3> bonds(vectors(X), {.spacing = l0});
  auto force = internal_force(bonds, viscous(rho, 0.02));
  const auto limit = [&](double speed) {
    const std::vector<Vector<double, 3>> v(X.size(), speed * Vector<double, 3>(3, -2, 1));
    return stable_step(force, vectors(X), vectors(v), rho, {.spacing = l0}).limit;
  };
  const double right = limit(0);
  EXPECT_LT(right, 1e-4);
  for (const double speed : {1e-3, 1., 30.}) EXPECT_NEAR(limit(speed), right, 0.01 * right) << speed;
}

TEST(StableStep, ResolvesFloatContactFarFromTheOrigin) {
  const double l0 = 1.2e-3, rho = 1000;
  const auto limit = [&]<class S>(S, double away) {
    std::vector<Vector<double, 3>> x;
    const Vector<double, 3> origin = Vector<double, 3>::Constant(away), middle = Vector<double, 3>::Constant(l0 / 2);
    std::vector<Index> below, above;
    for (const double z : {0., 4.}) {
      const Box<double, 3> box{Vector<double, 3>(0, 0, z * l0), Vector<double, 3>(6 * l0, 6 * l0, (z + 4) * l0)};
      for (const Vector<double, 3>& at : fill_lattice(box, l0, middle)) {
        (z > 0 ? above : below).push_back(static_cast<Index>(x.size()));
        x.push_back(origin + at - (z > 0 ? 0.1 * l0 : 0) * Vector<double, 3>::UnitZ());
      }
    }
    MetaballContact<S, 3> contact({.spacing = l0, .density = rho, .stiffness = PenaltyStiffness::fixed(3e12)});
    contact.add_pair(contact.add_organ({"below", below, below}), contact.add_organ({"above", above, above}));
    const std::vector<Vector<double, 3>> v(x.size(), Vector<double, 3>::Zero());
    const auto force = [&](const auto& at, const auto& speed, const auto& f) { contact.add(at, speed, f, 1e-6); };
    return stable_step(force, vectors(x), vectors(v), rho, {.spacing = l0}).limit;
  };
  const double right = limit(0.0, 0);
  for (const double away : {0., 0.5, 5.}) EXPECT_NEAR(limit(0.0F, away), right, 0.01 * right) << away;
}

// Friction with a spring also answers the way from the previous trial state, which is not stiffness.
TEST(StableStep, KeepsShortTrialMotionsForFrictionWithAMemory) {
  const double l0 = 1e-3, rho = 1000;
  std::vector<Vector<double, 3>> x;
  const auto add = [&](int across, double from, double height) {
    for (int i = 0; i < across; ++i)
      for (int j = 0; j < across; ++j)
        for (int k = 0; k < 3; ++k) x.push_back(l0 * Vector<double, 3>(from + i, from + j, height + k));
  };
  add(8, 0, 0);
  const std::size_t first = x.size(), all = first + 48;
  add(4, 1.8, 2.99);
  std::vector<Index> plate, block;
  for (std::size_t i = 0; i < all; ++i)
    if (i < first ? x[i][2] > 0.5 * l0 : x[i][2] < 4.5 * l0)
      (i < first ? plate : block).push_back(static_cast<Index>(i));
  const LatticeBonds<double, 3> below(vectors(x).part(0, first), {.spacing = l0}),
      above(vectors(x).part(first, all - first), {.spacing = l0});
  const auto tissue = MooneyRivlin<>::from_young(20e3, 50e3);
  auto force_below = internal_force(below, elastic(tissue)), force_above = internal_force(above, elastic(tissue));
  const std::vector<Vector<double, 3>> v(all, Vector<double, 3>::Zero());
  const auto found = [&](double perturbation) {
    MetaballContact<double, 3> contact({.spacing = l0, .density = rho, .friction = 0.3});
    contact.add_pair(contact.add_organ({"plate", plate, plate}), contact.add_organ({"block", block, block}));
    const auto force = [&](const auto& at, const auto& speed, const auto& f) {
      force_below(at.part(0, first), speed.part(0, first), f.part(0, first));
      force_above(at.part(first, all - first), speed.part(first, all - first), f.part(first, all - first));
      contact.add(at, speed, f, 1e-4);
    };
    return stable_step(force, vectors(x), vectors(v), rho, {.spacing = l0, .perturbation = perturbation});
  };
  const StableStep right = found(1e-5), chosen = found(0);
  EXPECT_TRUE(chosen.converged);
  EXPECT_NEAR(chosen.perturbation, 1e-5, 1e-12);
  EXPECT_NEAR(chosen.limit, right.limit, 0.005 * right.limit);
}

}  // namespace stable_step_test
