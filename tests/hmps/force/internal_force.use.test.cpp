// SPDX-License-Identifier: MIT
// The internal force as users call it: on state of any layout, with laws and terms of their own.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/message_of.hpp"
#include "../../reference/two_threads.hpp"
#include "../bonds/bonds_of_a_scene.hpp"
#include "equations.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/viscous.hpp"
#include "hmps/time/symplectic_euler.hpp"

namespace internal_force_use_test {

using namespace equations;
using bonds_of_a_scene::error_of;
using bonds_of_a_scene::has;
using Lattice = hmps::LatticeBonds<float, 3>;

scenes::Scene<3> scene_of(const std::string& name) {
  for (auto& scene : scenes::all<3>())
    if (scene.name == name) return scene;
  throw std::runtime_error(name);
}
const hmps::MooneyRivlin<double> law{1700, 1500, 1e4};

// The layout of the user's memory does not matter: the same numbers give the same bits.
TEST(InternalForce, WorksOnTheUsersOwnMemory) {
  for (const char* name : {"box whose rows are long in the first direction", "shuffled"}) {
    const auto scene = scene_of(name);
    const std::size_t n = scene.x.size();
    const auto bonds = make_bonds<Lattice>(scene);
    auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(2e4), hmps::viscous(1000, 2e-3));
    Vectors<3> expected(n);
    force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(expected));

    struct Particle {
      std::array<double, 3> x;
      int body;
      double v[3];
      Eigen::Vector3f f;
    };
    std::vector<Particle> structs(n);
    std::array<std::vector<double>, 9> arrays;
    for (auto& a : arrays) a.resize(n);
    Eigen::Matrix3Xd columns(3, n), f_columns(3, n);
    std::vector<double> memory(n * 11);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto d = static_cast<Eigen::Index>(c);
        structs[i].x[c] = arrays[c][i] = columns(d, static_cast<Eigen::Index>(i)) = scene.x[i][d];
        structs[i].v[c] = arrays[3 + c][i] = memory[11 * i + 1 + c] = scene.v[i][d];
      }
    force(hmps::vectors(structs, &Particle::x), hmps::vectors(structs, &Particle::v),
          hmps::vectors(structs, &Particle::f));
    force(hmps::vectors(arrays[0], arrays[1], arrays[2]), hmps::vectors(arrays[3], arrays[4], arrays[5]),
          hmps::vectors(arrays[6], arrays[7], arrays[8]));
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(structs[i].f, expected[i].cast<float>()) << i;
      for (int d = 0; d < 3; ++d) ASSERT_EQ(arrays[6 + static_cast<std::size_t>(d)][i], expected[i][d]) << i;
    }
    force(hmps::vectors(columns), hmps::vectors<3>(memory.data() + 1, n, 11 * sizeof(double)),
          hmps::vectors(f_columns));
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(f_columns.col(static_cast<Eigen::Index>(i)), expected[i]) << i;
  }
}

// On a lattice the order of the user's particles does not matter either.
TEST(InternalForce, DoesNotDependOnTheOrderOfTheParticles) {
  const auto scene = scene_of("L");
  const std::size_t n = scene.x.size();
  std::vector<hmps::Index> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = static_cast<hmps::Index>(i);
  scenes::Random(8).shuffle(order);
  auto shuffled = scene;
  for (std::size_t i = 0; i < n; ++i) {
    shuffled.reference[i] = scene.reference[order[i]];
    shuffled.x[i] = scene.x[order[i]];
  }
  const auto evaluate = [](const auto& s) {
    const auto bonds = make_bonds<hmps::LatticeBonds<double, 3>>(s);
    auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(2e4));
    Vectors<3> f(s.x.size());
    force(hmps::vectors(s.x), hmps::vectors(f));
    return f;
  };
  const auto f = evaluate(scene), g = evaluate(shuffled);
  double largest = 0;
  for (const auto& value : f) largest = std::max(largest, value.norm());
  // The lattice hangs on particle 0, so that r0 is rounded alike; u is not: another state's rounding.
  for (std::size_t i = 0; i < n; ++i) ASSERT_LE((f[order[i]] - g[i]).norm(), 1e-9 * largest) << i;
}

/// W = mu (C - 1) : (C - 1) / 4: an example of a user-defined law.
struct OwnLaw {
  double mu;
  template <class T, int D>
  hmps::Matrix<T, D> second_piola_kirchhoff(const hmps::Matrix<T, D>& C, const T&) const {
    hmps::Matrix<T, D> S;
    for (int k = 0; k < D * D; ++k) S(k % D, k / D) = T(mu) * (C(k % D, k / D) - T(k % D == k / D ? 1 : 0));
    return S;
  }
};
/// Springs with the stiffness of a particle and that of its neighbour, w (k_i + k_j) r_ij.
struct OwnSprings {
  hmps::ScalarView<const float> stiffness;
  template <class K, int D>
  void couple(const hmps::BlockOfParticles<K, D>& at, hmps::Coupling<K, D>& coupling) const {
    coupling.c += at(stiffness);
  }
};
/// d (v_j - v_i) w with a number that the user chooses.
struct OwnDamping {
  template <class K, int D>
  double damping(const hmps::Blocks<K, D>&) const {
    return 250;
  }
};

template <class B>
class OwnParts : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<double, 3>, hmps::BondList<float, 3>>;
TYPED_TEST_SUITE(OwnParts, Models);

TYPED_TEST(OwnParts, JoinTheSweeps) {
  using K = typename TypeParam::Scalar;
  const auto scene = scene_of("box with holes");
  const std::size_t n = scene.x.size();
  const auto bonds = make_bonds<TypeParam>(scene);
  std::vector<float> stiffness(n);
  for (std::size_t i = 0; i < n; ++i) stiffness[i] = 1e6f * (1 + static_cast<float>(i % 5));
  Vectors<3> f(n);
  std::vector<hmps::Matrix<double, 3>> F(n);
  auto force =
      hmps::internal_force(bonds, hmps::elastic(OwnLaw{3000}), hmps::record(hmps::matrices(F)),
                           OwnSprings{hmps::scalars(stiffness)}, hmps::viscous(density, viscosity), OwnDamping{});
  force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(f));

  const Expected<3> plain(scene, Materials(n), bonds.standard_lambda(), bonds.standard_density());
  std::vector<Eigen::Vector3d> expected(n, Eigen::Vector3d::Zero());
  plain.body.elastic(
      plain.F,
      [](std::size_t, const Eigen::Matrix3d& G) -> Eigen::Matrix3d {
        return 3000 * (G.transpose() * G - Eigen::Matrix3d::Identity());
      },
      expected);
  for (std::size_t i = 0; i < n; ++i)
    plain.body.for_each_bond(i, [&](const auto& b) {
      expected[i] += b.w * double(stiffness[i] + stiffness[b.j]) * (plain.x[b.j] - plain.x[i]);
      expected[i] += b.w * 250 * (plain.v[b.j] - plain.v[i]);
    });
  const Tolerance<K, 3> tolerance(scene);
  // Springs: c r is summed as c r0 + c u; 26 bonds of up to 2e7 Pa/m2 at 2 l0.
  const double springs = 26 * 2e7 * scene.spacing * tolerance.gradient;
  EXPECT_LE(largest_difference<3>(f, [&](std::size_t i) { return expected[i] + plain.viscous[i]; }),
            tolerance.elastic + tolerance.viscous + springs + 250 * 100 * std::numeric_limits<K>::epsilon());
  for (std::size_t i = 0; i < n; ++i) ASSERT_LE((F[i] - plain.F[i]).norm(), tolerance.gradient);
}

TEST(InternalForce, OfNoTermsIsZeroAndKeepsNoScratch) {
  const auto scene = scene_of("box");
  const auto bonds = make_bonds<Lattice>(scene);
  auto force = hmps::internal_force(bonds);
  Vectors<3> f(scene.x.size(), hmps::Vector<double, 3>::Ones());
  force(hmps::vectors(scene.x), hmps::vectors(f));
  for (const auto& value : f) ASSERT_EQ(value, (hmps::Vector<double, 3>::Zero()));
  EXPECT_EQ(force.bytes(), 0u);
  EXPECT_EQ(&force.bonds(), &bonds);
}

// One object serves any number of states in turn: no state affects the next.
TEST(InternalForce, KeepsNoState) {
  const auto scene = scene_of("thin sheet");
  const auto bonds = make_bonds<Lattice>(scene);
  auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(2e4));
  Vectors<3> f(scene.x.size()), g(scene.x.size());
  force(hmps::vectors(scene.x), hmps::vectors(f));
  auto broken = scene.x;
  broken[7][1] = std::numeric_limits<double>::quiet_NaN();
  force(hmps::vectors(broken), hmps::vectors(g));
  EXPECT_TRUE(std::isnan(g[7][1]));
  force(hmps::vectors(scene.x), hmps::vectors(g));
  EXPECT_EQ(f, g);
}

// Particles that move get the same force to the bit, and what cannot affect them is not evaluated.
TEST(InternalForce, LeavesOutWhatOnlyPrescribedParticlesNeed) {
  const auto scene = scene_of("box whose rows are long in the first direction");
  const auto bonds = make_bonds<Lattice>(scene);
  const std::size_t n = scene.x.size();
  double middle = 0;
  for (const auto& X : scene.reference) middle += X[1] / static_cast<double>(n);
  const auto moves = [&](std::size_t i) { return scene.reference[i][1] > middle; };

  std::vector<Eigen::Matrix3d> F(n), G(n, Eigen::Matrix3d::Constant(-7));
  const auto compose = [&](auto& gradients) {
    return hmps::internal_force(bonds, hmps::record(hmps::matrices(gradients)), hmps::elastic(law),
                                hmps::artificial(2e4), hmps::viscous(1000, 2e-3));
  };
  auto whole = compose(F), part = compose(G);
  part.restrict_to(moves);
  Vectors<3> expected(n), found(n, Eigen::Vector3d::Constant(-7));
  whole(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(expected));
  part(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(found));

  std::size_t unwritten = 0, unseen = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (moves(i)) {
      ASSERT_EQ(found[i], expected[i]) << i;
      bonds.for_each_bond(i, [&](std::size_t j, const auto&, float) { ASSERT_EQ(G[j], F[j]) << j; });
    }
    unwritten += found[i] == Eigen::Vector3d::Constant(-7);
    unseen += G[i] == Eigen::Matrix3d::Constant(-7);
  }
  EXPECT_GT(unwritten, n / 3);
  EXPECT_GT(unseen, n / 8);

  part.restrict_to([](std::size_t) { return true; });
  part(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(found));
  EXPECT_EQ(found, expected);
}

TEST(InternalForce, ClearsANaNBeforeRestriction) {
  using Point = hmps::Vector<double, 2>;
  for (int columns = 2; columns < 7; ++columns)
    for (int rows = 2; rows < 12; ++rows) {
      std::vector<Point> reference;
      for (int a = 0; a < columns; ++a)
        for (int b = 0; b < rows; ++b) reference.emplace_back(1e-3 * a, 1e-3 * b);
      const std::size_t n = reference.size();
      const hmps::LatticeBonds<double, 2> bonds(hmps::vectors(reference), {.spacing = 1e-3});
      auto x = reference;
      for (Point& place : x) place[0] *= 1.01;
      const auto compose = [&] { return hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(2e4)); };
      auto force = compose(), other = compose();
      std::vector<Point> expected(n), found(n);
      const std::vector<Point> broken(n, Point::Constant(std::numeric_limits<double>::quiet_NaN()));
      other(hmps::vectors(x), hmps::vectors(expected));
      force(hmps::vectors(broken), hmps::vectors(found));
      force.restrict_to([&](std::size_t i) { return i < n / 2; });
      force(hmps::vectors(x), hmps::vectors(found));
      for (std::size_t i = 0; i < n / 2; ++i) ASSERT_EQ(found[i], expected[i]) << columns << " x " << rows;
    }
}

// Eq. (2) in the last sweep gives the same as the force followed by `kick`, whatever the layout.
TEST(InternalForce, KickEqualsForceAndKick) {
  for (const char* name : {"box whose rows are long in the first direction", "shuffled"}) {
    const auto scene = scene_of(name);
    const std::size_t n = scene.x.size();
    const auto bonds = make_bonds<Lattice>(scene);
    auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(2e4), hmps::viscous(1000, 2e-3));
    constexpr double dt = 1e-5;
    std::vector<double> rho(n);
    for (std::size_t i = 0; i < n; ++i) rho[i] = i % 2 ? 1000 : 1500;
    Vectors<3> f(n), expected = scene.v, v = scene.v;
    force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(f));
    hmps::kick(hmps::vectors(expected), hmps::vectors(f), hmps::scalars(rho), dt);
    force.kick(hmps::vectors(scene.x), hmps::vectors(v), hmps::scalars(rho), dt);
    // The same bits, except where a compiler contracts operations in only one of the two loops.
    double speed = 0;
    for (const auto& each : expected) speed = std::max(speed, each.norm());
    EXPECT_GT(largest_difference<3>(expected, [&](std::size_t i) { return scene.v[i]; }), 1e-3 * speed);
    EXPECT_LE(largest_difference<3>(v, [&](std::size_t i) { return expected[i]; }), 4e-16 * speed);

    std::array<std::vector<float>, 3> columns;
    for (auto& column : columns) column.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c) columns[c][i] = static_cast<float>(scene.v[i][static_cast<Eigen::Index>(c)]);
    force.kick(hmps::vectors(scene.x), hmps::vectors(columns[0], columns[1], columns[2]), 1000, dt);
    for (std::size_t i = 0; i < n; i += 2)  // of the density 1500 above
      for (std::size_t c = 0; c < 3; ++c) {
        const auto d = static_cast<Eigen::Index>(c);
        // Rounded to float twice.
        EXPECT_NEAR(columns[c][i], scene.v[i][d] + 1.5 * (expected[i][d] - scene.v[i][d]), 1e-7 * speed);
      }
  }
}

TEST(InternalForce, RefusesToKickByABadStepOrDensity) {
  const auto scene = scene_of("shuffled");
  const auto bonds = make_bonds<Lattice>(scene);
  auto force = hmps::internal_force(bonds, hmps::elastic(law));
  auto v = scene.v;
  const auto x = hmps::vectors(scene.x);
  EXPECT_TRUE(has(error_of([&] { force.kick(x, hmps::vectors(v), 1000, -1e-5); }), "time step is -1e-05"));
  EXPECT_TRUE(has(error_of([&] { force.kick(x, hmps::vectors(v), 0, 1e-5); }), "density is 0 kg/m3"));
  v.pop_back();
  EXPECT_TRUE(has(error_of([&] { force.kick(x, hmps::vectors(v), 1000, 1e-5); }), "velocities"));
}

TEST(InternalForce, RefusesViewsOfTheWrongSize) {
  const auto scene = scene_of("box");
  const auto bonds = make_bonds<Lattice>(scene);
  const std::size_t n = scene.x.size();
  auto force = hmps::internal_force(bonds, hmps::viscous(1000, 2e-3));
  Vectors<3> right(n), wrong(n - 1);
  const auto r = hmps::vectors(right), w = hmps::vectors(wrong);
  const std::string sizes = " holds " + std::to_string(n - 1) + " particles but " + std::to_string(n) + " are needed";
  EXPECT_TRUE(has(error_of([&] { force(w, r, r); }), "positions" + sizes));
  EXPECT_TRUE(has(error_of([&] { force(r, w, r); }), "velocities" + sizes));
  EXPECT_TRUE(has(error_of([&] { force(r, r, w); }), "forces" + sizes));
}

// Unchecked, this writes beyond the end of the user's array.
TEST(InternalForce, RefusesARecordOfTheWrongSizeWhenItIsMade) {
  const auto scene = scene_of("box");
  const auto bonds = make_bonds<Lattice>(scene);
  std::vector<hmps::Matrix<double, 3>> F(bonds.size() - 1);
  const std::string text = error_of([&] { (void)hmps::internal_force(bonds, hmps::record(hmps::matrices(F))); });
  EXPECT_TRUE(has(text, "deformation gradients to record holds " + std::to_string(F.size()))) << text;
}

TEST(InternalForce, RefusesForcesInTheMemoryOfTheState) {
  const auto scene = scene_of("box");
  const auto bonds = make_bonds<Lattice>(scene);
  Vectors<3> x = scene.x, v = scene.v;
  auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::viscous(1000, 2e-3));
  const auto X = hmps::vectors(x), V = hmps::vectors(v);
  EXPECT_TRUE(has(error_of([&] { force(X, V, X); }), "forces and positions are the same memory"));
  EXPECT_TRUE(has(error_of([&] { force(X, V, V); }), "forces and velocities are the same memory"));
  EXPECT_TRUE(has(error_of([&] { force.kick(X, X, 1e3, 1e-6); }), "positions and velocities are the same memory"));
  Vectors<3> f(x.size());
  EXPECT_TRUE(has(error_of([&] { force(X, X, hmps::vectors(f)); }), "positions and velocities are the same memory"));
  EXPECT_TRUE(x == scene.x && v == scene.v);
}

// A vector of bodies moves them when it grows: the force follows the bonds to their new place.
TEST(InternalForce, FollowsBondsThatAreMoved) {
  const auto scene = scene_of("box");
  std::vector<Lattice> bodies;
  bodies.push_back(make_bonds<Lattice>(scene));
  auto force = hmps::internal_force(bodies[0], hmps::elastic(law));
  const std::size_t n = scene.x.size();
  Vectors<3> before(n), after(n);
  force(hmps::vectors(scene.x), hmps::vectors(before));
  const Lattice* const old = &bodies[0];
  bodies.reserve(bodies.capacity() + 7);
  ASSERT_NE(&bodies[0], old);
  force(hmps::vectors(scene.x), hmps::vectors(after));
  EXPECT_EQ(&force.bonds(), &bodies[0]);
  EXPECT_TRUE(before == after);
}

TEST(InternalForce, RejectsDestroyedBonds) {
  const auto scene = scene_of("box");
  Vectors<3> f(scene.x.size());
  auto bonds = std::make_unique<Lattice>(make_bonds<Lattice>(scene));
  auto force = hmps::internal_force(*bonds, hmps::elastic(law));
  const auto evaluate = [&] { force(hmps::vectors(scene.x), hmps::vectors(f)); };
  EXPECT_NO_THROW(evaluate());
  *bonds = make_bonds<Lattice>(scene_of("L"));
  EXPECT_TRUE(has(error_of(evaluate), "bonds of this force no longer exist"));
  auto second = hmps::internal_force(*bonds, hmps::elastic(law));
  const Lattice moved = std::move(*bonds);
  EXPECT_EQ(&second.bonds(), &moved);
  EXPECT_TRUE(has(error_of([&] { (void)hmps::internal_force(*bonds, hmps::elastic(law)); }), "hold no particle"));
  bonds.reset();
  EXPECT_EQ(&second.bonds(), &moved);
}

// Only a force without damping may be called without velocities.
template <class Force>
concept WithoutVelocities = requires(Force& force, const hmps::VectorView<double, 3>& x) {
  force(x, x);
};
static_assert(WithoutVelocities<hmps::InternalForce<Lattice, hmps::Artificial<double>>>);
static_assert(!WithoutVelocities<hmps::InternalForce<Lattice, hmps::Viscous>>);

// The length of an edge in place of the volume of its cube.
TEST(InternalForce, RejectsAnEnergyOfInvalidVolumes) {
  const auto scene = scene_of("box");
  const auto bonds = make_bonds<Lattice>(scene);
  const auto force = hmps::internal_force(bonds, hmps::elastic(law));
  const double l0 = scenes::Scene<3>::spacing;
  EXPECT_NO_THROW((void)force.energy(hmps::vectors(scene.x), l0 * l0 * l0));
  for (const double volume : {l0, l0 * l0, 1e9 * l0 * l0 * l0, 1e-3 * l0 * l0 * l0})
    EXPECT_TRUE(has(error_of([&] { (void)force.energy(hmps::vectors(scene.x), volume); }), "l0^3 on a lattice"))
        << volume;
  const std::vector<double> in_mm3(scene.x.size(), 1e9 * l0 * l0 * l0);
  EXPECT_TRUE(
      has(error_of([&] { (void)force.energy(hmps::vectors(scene.x), hmps::scalars(in_mm3)); }), "l0^3 on a lattice"));
}

struct Bursting {
  double mu;
  template <class T, int D>
  auto second_piola_kirchhoff(const hmps::Matrix<T, D>& C, const T&) const {
    hmps::Matrix<T, D> S = C;
    for (int k = 0; k < D * D; ++k)
      S(k % D, k / D) = (C(k % D, k / D) - T(k % D == k / D ? 1.F : 0.F)) * T(static_cast<float>(mu));
    return S;
  }
};
// With the sign of the stress reversed, a body was NaN within some thousand steps.
TEST(InternalForce, RejectsALawWhoseStressFallsAsTheStrainGrows) {
  const auto bonds = make_bonds<Lattice>(scene_of("box"));
  EXPECT_NO_THROW((void)hmps::internal_force(bonds, hmps::elastic(Bursting{7e3})));
  EXPECT_TRUE(has(error_of([&] { (void)hmps::internal_force(bonds, hmps::elastic(Bursting{-7e3})); }),
                  "a stress that falls where the strain grows"));
}

// The bonds must outlive the force.
template <class B>
concept TakesTemporaryBonds = requires(B&& bonds) {
  hmps::internal_force(std::move(bonds));
};
static_assert(!TakesTemporaryBonds<Lattice>);

struct Pull {
  double strength;
  template <class T, int D>
  T tension(const hmps::BondState<T, D>& bond) const {
    return T(static_cast<float>(strength)) * bond.weight() / bond.elongation();
  }
};
// Reported when the force is made, not by a state that is NaN many steps later.
TEST(InternalForce, RefusesAPairTermThatIsNotFinite) {
  const auto bonds = make_bonds<Lattice>(scene_of("shuffled"));
  const auto text =
      hmps_test::message_of([&] { (void)hmps::internal_force(bonds, Pull{std::numeric_limits<double>::quiet_NaN()}); });
  EXPECT_NE(text.find("a pair term pulls particle"), std::string::npos) << text;
  EXPECT_NO_THROW((void)hmps::internal_force(bonds, Pull{1}));  // infinite at rest only
}

/// A law that refuses every state from some time on.
struct Refusing {
  const bool* refuses;
  template <class T, int D>
  hmps::Matrix<T, D> second_piola_kirchhoff(const hmps::Matrix<T, D>& C, const T&) const {
    if (*refuses) throw hmps::StateError("the law of the user refuses this state");
    return T(1e3) * (C - hmps::Matrix<T, D>::Identity());
  }
};

TEST(InternalForce, KeepsTheErrorOfALawFromTheUsersThreads) {
  std::vector<Eigen::Vector3d> x;
  for (int k = 0; k < 216; ++k) x.emplace_back(1e-3 * (k / 36), 1e-3 * (k / 6 % 6), 1e-3 * (k % 6));
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(x), {.spacing = 1e-3});
  bool refuses = false;
  auto force = hmps::internal_force(bonds, hmps::elastic(Refusing{&refuses}));
  refuses = true;
  std::vector<Eigen::Vector3d> f(x.size());
  const std::string error = hmps_test::message_in_two_threads<hmps::StateError>(
      [&](const auto& execute) { force(hmps::vectors(x), hmps::vectors(f), execute); });
  EXPECT_EQ(error, "the law of the user refuses this state");
}

}  // namespace internal_force_use_test
