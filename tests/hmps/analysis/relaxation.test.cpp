// SPDX-License-Identifier: MIT
#include "hmps/analysis/relaxation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/contact/contact.hpp"
#include "hmps/contact/spring_friction.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/gravity.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/viscous.hpp"

namespace relaxation_test {

using namespace hmps;

constexpr double l0 = 2e-3, density = 1000, gravity = 9.81, young = 20e3;

/// A column of `width`^(D-1) x `height` particles, of which the lowest layer is held.
template <int D>
std::vector<Vector<double, D>> column(int width, int height) {
  std::vector<Vector<double, D>> points;
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < (D == 3 ? width : 1); ++j)
      for (int k = 0; k < height; ++k) {
        Vector<double, D> place = Vector<double, D>::Zero();
        place[0] = i * l0;
        if (D == 3) place[1] = j * l0;
        place[D - 1] = k * l0;
        points.push_back(place);
      }
  return points;
}

/// The state of a body in `T` that stands in a field of gravity along `pull`.
template <class T, int D>
struct Standing {
  std::vector<Vector<double, D>> reference;
  std::vector<Vector<T, D>> position, velocity, load;
  LatticeBonds<double, D> bonds;
  Vector<double, D> pull = Vector<double, D>::Zero();
  double volume = std::pow(l0, D);

  explicit Standing(std::vector<Vector<double, D>> points)
      : reference(std::move(points)), bonds(vectors(reference), {.spacing = l0}) {
    for (const auto& place : reference) position.push_back(place.template cast<T>());
    velocity.assign(position.size(), Vector<T, D>::Ones());  // at rest only after relax
    load = velocity;
    pull[0] = 0.3 * gravity;
    pull[D - 1] = -gravity;
  }
  [[nodiscard]] auto x() { return vectors(position); }
  [[nodiscard]] auto v() { return vectors(velocity); }
  [[nodiscard]] auto f() { return vectors(load); }
  [[nodiscard]] auto moves() const {
    return [this](std::size_t i) { return reference[i][D - 1] > 0.5 * l0; };
  }
  [[nodiscard]] double weight() const {
    double sum = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) sum += moves()(i) ? density * pull.norm() * volume : 0.;
    return sum;
  }
  /// The internal force with the weight.
  template <class Force>
  [[nodiscard]] auto with_weight(Force& force) {
    return [&force, this](const auto& at, const auto& speed, const auto& out) {
      force(at, speed, out);
      for (std::size_t i = 0; i < out.size(); ++i) out.add(i, density * pull);
    };
  }
};

const LinearElastic<> linear = LinearElastic<>::from_young_poisson(young, 0.3);

template <class T, int N>
struct Kind {
  using Scalar = T;
  static constexpr int D = N;
};
using Kinds = testing::Types<Kind<double, 2>, Kind<float, 3>>;
template <class K>
struct RelaxOf : testing::Test {};
TYPED_TEST_SUITE(RelaxOf, Kinds);

/// The solution of a matrix solver for the same particles: the stiffness is the derivative of the force, column by
/// column. With residuals R the error of the displacements is K^-1 R, at most |R| over the least eigenvalue.
TYPED_TEST(RelaxOf, FindsWhatASolverOfTheLinearSystemFinds) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  Standing<T, D> body(column<D>(3, D == 2 ? 6 : 4));
  if (std::is_same_v<T, float>) body.pull *= 100;  // it would sag by a few units in the last place of its positions
  auto force = internal_force(body.bonds, elastic(linear), artificial(young));
  const std::size_t n = body.position.size();
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < n; ++i)
    if (body.moves()(i)) free.push_back(i);
  const auto size = static_cast<Eigen::Index>(free.size() * D);
  Eigen::MatrixXd K(size, size);
  Eigen::VectorXd weight(size);
  std::vector<Vector<double, D>> moved = body.reference, answer(n);
  const auto at = [](std::size_t a, int c) { return static_cast<Eigen::Index>(a) * D + c; };
  for (std::size_t a = 0; a < free.size(); ++a)
    for (int c = 0; c < D; ++c) {
      weight[at(a, c)] = density * body.pull[c];
      moved[free[a]][c] += l0;  // the force is linear: any displacement will do
      force(vectors(moved), vectors(answer));
      moved[free[a]][c] = body.reference[free[a]][c];
      for (std::size_t b = 0; b < free.size(); ++b)
        for (int d = 0; d < D; ++d) K(at(b, d), at(a, c)) = -answer[free[b]][d] / l0;
    }
  const Eigen::VectorXd exact = K.ldlt().solve(weight);
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues()[0];

  const double tolerance = std::is_same_v<T, float> ? 1e-4 : 1e-6;
  std::vector<Relaxation> seen;
  const auto found = relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                           {.spacing = l0,
                            .tolerance = tolerance,
                            .load = body.weight(),
                            .moves = body.moves(),
                            .progress = [&](const Relaxation& now) { seen.push_back(now); }});
  ASSERT_EQ(seen.size(), static_cast<std::size_t>(found.iterations) + 1);
  EXPECT_EQ(seen.back().iterations, found.iterations);
  EXPECT_EQ(seen.back().residual, found.residual);
  EXPECT_EQ(seen.back().step, found.step);
  EXPECT_GT(seen.front().residual, 10 * tolerance);
  EXPECT_LE(found.residual, tolerance);
  EXPECT_GT(found.iterations, 10);
  EXPECT_GT(found.peaks, 1);
  EXPECT_GE(found.evaluations, found.iterations);
  double squares = 0, largest = 0;
  for (std::size_t a = 0; a < free.size(); ++a)
    for (int c = 0; c < D; ++c) {
      const double u = static_cast<double>(body.position[free[a]][c]) - body.reference[free[a]][c];
      squares += std::pow(u - exact[at(a, c)], 2);
      largest = std::max(largest, std::abs(exact[at(a, c)]));
    }
  // The sum of the sizes of the residuals bounds the root of the sum of their squares.
  EXPECT_LE(std::sqrt(squares), tolerance * body.weight() / body.volume / least);
  EXPECT_LT(tolerance * body.weight() / body.volume / least, 0.2 * largest) << "the test cannot fail";
}

TYPED_TEST(RelaxOf, LeavesTheBodyAtRestAndTheRestWhereItWas) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  Standing<T, D> body(column<D>(3, 4));
  auto force = internal_force(body.bonds, elastic(MooneyRivlin<>::from_young(young, 1e5)), artificial(young));
  const auto found = relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                           {.spacing = l0, .tolerance = 0.01, .moves = body.moves()});
  Vector<double, D> reaction = Vector<double, D>::Zero(), weight = reaction;
  double unbalanced = 0, held = 0;
  for (std::size_t i = 0; i < body.position.size(); ++i) {
    EXPECT_EQ(body.velocity[i], (Vector<T, D>::Zero())) << i;
    const Vector<double, D> f = body.load[i].template cast<double>();
    weight += density * body.pull;
    if (body.moves()(i)) {
      unbalanced += f.norm();
    } else {
      EXPECT_EQ(body.position[i], body.reference[i].template cast<T>()) << i;
      held += f.norm();
      reaction += f;
    }
  }
  // By default unbalanced forces are compared with the force that the held particles carry.
  EXPECT_NEAR(found.load / (held * body.volume), 1, 1e-12);
  EXPECT_NEAR(found.residual / (unbalanced / held), 1, 1e-12);
  EXPECT_LE(found.residual, 0.01);
  // Internal forces sum to zero: what is not carried is unbalanced.
  EXPECT_LE((reaction - weight).norm(), unbalanced * (1 + 1e-6) + (std::is_same_v<T, float> ? 1e-3 * held : 0));
}

TYPED_TEST(RelaxOf, EveryExecutorGivesTheSameBits) {
  using T = typename TypeParam::Scalar;
  constexpr int D = TypeParam::D;
  const auto backwards = [](std::size_t n, auto&& body) {
    for (std::size_t i = n; i-- > 0;) body(i);
  };
  const auto settle = [](const auto& execute) {
    Standing<T, D> body(column<D>(3, 4));
    auto force = internal_force(body.bonds, elastic(linear), artificial(young));
    (void)relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                {.spacing = l0, .tolerance = 0.01, .moves = body.moves()}, execute);
    return body.position;
  };
  EXPECT_EQ(settle(Serial{}), settle(backwards));
}

// In float, the rounding of positions makes forces of the size of the weight. Relax may refuse such a body, but must
// not call it at rest before it has sagged.
TEST(Relax, DistinguishesTheWeightOfAFloatBodyFromRounding) {
  const Vector<double, 2> away(0.3, 0);  // where positions are rounded coarsely
  const auto sag = [&]<class T>(T, const double load) {
    Standing<T, 2> body(column<2>(5, 20));
    auto force = internal_force(body.bonds, elastic(MooneyRivlin<>::from_moduli(2e6, 1e4)), artificial(young));
    for (auto& place : body.position) place += away.template cast<T>();
    (void)relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                {.spacing = l0, .load = load, .max_iterations = 20000, .moves = body.moves()});
    double most = 0;
    for (std::size_t i = 0; i < body.position.size(); ++i)
      most = std::max(most, (body.position[i].template cast<double>() - away - body.reference[i]).norm());
    return most;
  };
  const double expected = sag(0.0, Standing<double, 2>(column<2>(5, 20)).weight());
  double found = expected;
  try {
    found = sag(0.F, 0);
  } catch (const StateError& error) {
    EXPECT_NE(std::string(error.what()).find("give a `load`"), std::string::npos) << error.what();
  }
  EXPECT_NEAR(found, expected, 0.1 * expected);
}

/// Half of the column is a hundred times stiffer. Where density follows stiffness the waves are equally fast; the force
/// on a soft particle comes from up to two layers away, so that two layers of them are as heavy as the stiff ones.
TEST(Relax, FindsTheSameWithAnyMassAndFasterWithOneThatFollowsStiffness) {
  Standing<double, 3> body(column<3>(3, 8));
  std::vector<double> modulus(body.position.size()), fictitious;
  for (std::size_t i = 0; i < modulus.size(); ++i) {
    modulus[i] = body.reference[i][2] < 3.5 * l0 ? 2e6 : young;
    fictitious.push_back(density * (body.reference[i][2] < 5.5 * l0 ? 100 : 1));
  }
  const auto stiffness = scalars(modulus);
  auto force = internal_force(body.bonds, elastic([&](const auto& at) {
                                const auto E = at(stiffness);  // nu = 0
                                return LinearElastic{E * 0.0, E * 0.5};
                              }),
                              artificial([&](const auto& at) { return at(stiffness); }));
  const RelaxationSettings settings{.spacing = l0, .tolerance = 1e-5, .load = body.weight(), .moves = body.moves()};
  const auto plain = relax(body.with_weight(force), body.x(), body.v(), body.f(), density, settings);
  const auto end = body.position;
  body.position = body.reference;
  const auto quick = relax(body.with_weight(force), body.x(), body.v(), body.f(), scalars(fictitious), settings);
  EXPECT_GT(quick.step, 8 * plain.step);  // sound crosses a spacing of the stiff half ten times as fast
  EXPECT_LT(2 * quick.iterations, plain.iterations);
  const double sag = (end.back() - body.reference.back()).norm();
  for (std::size_t i = 0; i < end.size(); ++i) EXPECT_LT((body.position[i] - end[i]).norm(), 1e-3 * sag) << i;
}

TEST(Relax, FindsTheSameThroughViscosity) {
  Standing<double, 2> body(column<2>(3, 6));
  auto elastic_only = internal_force(body.bonds, elastic(linear), artificial(young));
  auto viscous_too = internal_force(body.bonds, elastic(linear), artificial(young), viscous(density, 0.02));
  const RelaxationSettings settings{.spacing = l0, .tolerance = 1e-6, .load = body.weight(), .moves = body.moves()};
  (void)relax(body.with_weight(elastic_only), body.x(), body.v(), body.f(), density, settings);
  const auto end = body.position;
  body.position = body.reference;
  const auto found = relax(body.with_weight(viscous_too), body.x(), body.v(), body.f(), density, settings);
  // At rest the damping is gone: the unbalanced forces are those of the elastic body.
  auto check = body.with_weight(elastic_only);
  check(body.x(), body.v(), body.f());
  double unbalanced = 0;
  for (std::size_t i = 0; i < end.size(); ++i) unbalanced += body.moves()(i) ? body.load[i].norm() : 0.;
  EXPECT_NEAR(unbalanced * body.volume / found.load, found.residual, 1e-9);
  const double sag = (end.back() - body.reference.back()).norm();
  for (std::size_t i = 0; i < end.size(); ++i) EXPECT_LT((body.position[i] - end[i]).norm(), 1e-4 * sag) << i;
}

/// The iterations that a column of 3 x 24 particles takes, hung up by its end, with particles that are displaced at
/// random by up to `off` spacings along each axis.
int iterations_of_a_pull(double off) {
  auto points = column<2>(3, 24);
  std::mt19937 random(3);
  for (auto& x : points)
    for (int c = 0; c < 2; ++c)
      x[c] += off * l0 * (2.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1);
  const BondList<double, 2> bonds(vectors(points), {.spacing = l0});
  auto force =
      internal_force(bonds, elastic(linear), artificial(young), hmps::gravity(density, Vector<double, 2>(0, 0.1)));
  std::vector<Vector<double, 2>> x = points, v(points.size(), Vector<double, 2>::Zero()), f = v;
  const double load = density * 0.1 * l0 * l0 * static_cast<double>(points.size());
  return relax(force, vectors(x), vectors(v), vectors(f), density,
               {.spacing = l0,
                .tolerance = 1e-5,
                .load = load,
                .moves = ParticleSet(points.size(), [&](std::size_t i) { return points[i][1] > l0 / 2; })})
      .iterations;
}

/// The statement of docs/fitted.md. By symmetry the pull does not bend the column on a lattice.
TEST(Relax, TakesLongerWhereAPullAlsoBends) {
  const int straight = iterations_of_a_pull(0), uneven = iterations_of_a_pull(0.1);
  EXPECT_GT(uneven, 4 * straight);
  EXPECT_LT(uneven, 5 * straight);
}

/// A hanging column that stretches to twice its length under its weight, applied at once: as it gets thinner its stable
/// step shrinks, and relax has to follow.
TEST(Relax, FollowsTheStableStepThroughALargeStrain) {
  Standing<double, 3> body(column<3>(4, 6));
  body.pull = Vector<double, 3>(0, 0, 4000);
  auto force = internal_force(body.bonds, elastic(MooneyRivlin<>::from_young(young, 1e5)), artificial(young / 2));
  const double before =
      stable_step(force, body.x(), body.v(), density, {.spacing = l0, .margin = 0.1, .moves = body.moves()}).step;
  RelaxationSettings settings{.spacing = l0, .load = body.weight(), .max_iterations = 5000, .moves = body.moves()};
  const auto found = relax(body.with_weight(force), body.x(), body.v(), body.f(), density, settings);
  EXPECT_LE(found.residual, 1e-3);
  EXPECT_GT(body.position.back()[2], 2 * body.reference.back()[2]);
  EXPECT_LT(found.step, 0.8 * before);
  // With the initial step it does not come to rest in twice the time, and reports that.
  body.position = body.reference;
  settings.step = before;
  settings.max_iterations = 2 * found.iterations;
  EXPECT_THROW((void)relax(body.with_weight(force), body.x(), body.v(), body.f(), density, settings), StateError);
}

/// Two oscillators: the first with every step up to its limit of stability, 1 s, the second slow. Stopped without going
/// back to the peak, the first would swing for ever where its period is four steps (a step of 1 / sqrt(2) s), and it
/// would grow near the limit if the first kick were a whole one.
TEST(Relax, ConvergesInEveryModeAtAnyStableStep) {
  for (const double step : {0.1, 0.3, 0.5, std::sqrt(0.5), 0.8, 0.9, 0.99}) {
    std::vector<Vector<double, 2>> x{{1, 0}, {0, 1}}, v = x, f = x;
    const double slow = 0.2;  // rad/s; the first has 2 rad/s
    const auto force = [&](const auto& at, const auto&, const auto& out) {
      for (std::size_t i = 0; i < 2; ++i) out.set(i, -(i == 0 ? 4. : slow * slow) * at[i]);
    };
    const auto found = relax(force, vectors(x), vectors(v), vectors(f), 1.0,
                             {.spacing = 1, .tolerance = 1e-6, .load = 1, .max_iterations = 2000, .step = step});
    EXPECT_LT(x[0].norm(), 1e-6 / 4) << step;
    EXPECT_LT(x[1].norm(), 1e-6 / (slow * slow)) << step;
    // No more than ten periods of the slow one.
    EXPECT_LT(found.iterations * step, 10 * 2 * std::acos(-1.0) / slow) << step;
  }
}

std::string words_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A block, held at its base, that a plate presses and then drags sideways.
template <class Friction>
struct Dragged {
  static constexpr double press = 0.3 * l0, drag = 0.0025 * l0;  // less than the elastic slip at the limit
  static constexpr int drags = 20;
  Relaxation last;
  double normal = 0, along = 0;  // what the plate bears, in N/m

  /// The contact takes the step `dt`.
  Dragged(double dt, double friction) {
    std::vector<Vector<double, 2>> x;
    for (int i = 0; i < 50; ++i) x.push_back(l0 * Vector<double, 2>(i % 10, i / 10));
    for (int i = 0; i < 32; ++i) x.push_back(l0 * Vector<double, 2>(i % 16 - 3, 5 + i / 16));
    const std::size_t n = 50;
    std::vector<Vector<double, 2>> v(x.size(), Vector<double, 2>::Zero()), f = v;
    std::vector<Matrix<double, 2>> gradient(x.size(), Matrix<double, 2>::Identity());
    const auto F = matrices(gradient);
    const LatticeBonds<double, 2> bonds(vectors(std::as_const(x)).part(0, n), {.spacing = l0});
    auto internal = internal_force(bonds, elastic(NeoHookean<>::from_young_poisson(young, 0.3)), record(F.part(0, n)),
                                   artificial(young));
    MetaballContact<double, 2, SmoothMetaball, Friction> contact(
        {.spacing = l0,
         .density = density,
         .friction = friction,
         .stiffness = PenaltyStiffness::fixed(10 * young / (l0 * l0))});
    std::vector<Index> skin, wall;
    for (Index i = 40; i < n; ++i) skin.push_back(i);
    for (Index i = n; i < x.size(); ++i) wall.push_back(i);
    const auto block = contact.add_organ({"block", skin});
    const auto plate = contact.add_organ({"plate", {}, wall, [](Index) { return true; }});
    contact.add_pair(block, plate, {.roles = Roles::only_first_is_slave});
    const auto force = [&](const auto& at, const auto& speed, const auto& out) {
      internal(at.part(0, n), speed.part(0, n), out.part(0, n));
      contact.add(at, speed, F, out, dt);
    };
    const RelaxationSettings settings{
        .spacing = l0, .load = 0.05 * young * 10 * l0, .max_iterations = 5000, .moves = [](std::size_t i) {
          return i >= 10 && i < 50;
        }};
    for (int k = 0; k <= drags; ++k) {
      for (const Index i : wall) x[i] += k == 0 ? Vector<double, 2>(0, -press) : Vector<double, 2>(drag, 0);
      last = relax(force, vectors(x), vectors(v), vectors(f), density, settings);
    }
    for (const Index i : wall) {
      normal += f[i][1] * l0 * l0;
      along -= f[i][0] * l0 * l0;
    }
  }
};

// Earlier, the documentation did not say that contact in relax needs about the step of relax.
TEST(Relax, TakesFrictionThatIsGivenAboutItsOwnStep) {
  const Dragged<CorrectedFriction> smooth(1e-6, 0);
  const double dt = smooth.last.step / 2;
  const Dragged<SpringFriction> sticking(dt, 0.5);
  const Dragged<CorrectedFriction> creeping(dt, 0.5);
  EXPECT_GT(sticking.along, creeping.along + 0.02 * sticking.normal);
  EXPECT_LT(sticking.along, (1 + 1e-6) * 0.5 * sticking.normal);
  // It resists only while something slips.
  EXPECT_NEAR(creeping.along, smooth.along, 0.01 * smooth.normal);
  EXPECT_NEAR(creeping.normal, smooth.normal, 0.01 * smooth.normal);
  const std::string words = words_of([] { (void)Dragged<SpringFriction>(1e-6, 0.5); });
  EXPECT_TRUE(has(words, "damping shortened its step")) << words;
}

TEST(Relax, ReportsFailureToConverge) {
  Standing<double, 2> body(column<2>(3, 6));
  auto force = internal_force(body.bonds, elastic(linear), artificial(young));
  const std::string words = words_of([&] {
    (void)relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                {.spacing = l0, .load = body.weight(), .max_iterations = 20, .moves = body.moves()});
  });
  EXPECT_TRUE(has(words, "relax made 20 iterations")) << words;
  EXPECT_TRUE(has(words, "larger tolerance than 0.001")) << words;
  // The state is kept, and a second call continues from it.
  EXPECT_LT(body.position.back()[1], body.reference.back()[1]);
  const auto found = relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                           {.spacing = l0, .load = body.weight(), .moves = body.moves()});
  EXPECT_LE(found.residual, 1e-3);
}

// Earlier, all permitted iterations were made, and the message asked for more of them.
TEST(Relax, EndsWhereTheForcesOfFloatBondsAreRounding) {
  const auto settle = [](auto scalar) {
    Standing<double, 3> body(column<3>(4, 14));
    const LatticeBonds<decltype(scalar), 3> bonds(vectors(body.reference), {.spacing = l0});
    auto force = internal_force(bonds, elastic(MooneyRivlin<>::from_young(young, 1e6)), artificial(young));
    const auto found = relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                             {.spacing = l0, .load = body.weight(), .moves = body.moves()});
    return found.iterations;
  };
  EXPECT_LT(settle(0.0), 10000);
  const std::string words = words_of([&] { (void)settle(0.F); });
  EXPECT_TRUE(has(words, "no longer decrease")) << words;
  EXPECT_TRUE(has(words, "if bonds or positions are in float, use double, or a larger tolerance than 0.001")) << words;
  const auto at = words.find("relax made ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(std::stoi(words.substr(at + 11)), 20000) << words;
}

// Peaks of the stiffest motion that come every other step do not end a search that gets closer, nor slow ones one that
// does not.
TEST(Relax, StallsOnlyIfFastPeaksNoLongerLowerTheResidual) {
  const auto stalls = [](int steps, double shrink) {
    detail::Stalling stalling;
    Relaxation now{.residual = 1};
    for (now.peaks = 0; now.peaks < 5000; ++now.peaks, now.iterations += steps, now.residual *= shrink)
      if (stalling.update(now)) return true;
    return false;
  };
  EXPECT_TRUE(stalls(2, 1));
  EXPECT_TRUE(stalls(5, 0.9999));  // 10 % in a window
  EXPECT_FALSE(stalls(2, 0.9997));
  EXPECT_FALSE(stalls(7, 1));
}

// A plane of symmetry: along x the column keeps its place, and what holds it there is a reaction, not unbalanced.
TEST(Relax, HoldsSingleComponents) {
  Standing<double, 2> body(column<2>(3, 6));
  auto force = internal_force(body.bonds, elastic(linear), artificial(young));
  const auto middle = [&](std::size_t i) { return std::abs(body.reference[i][0] - l0) < l0 / 2; };
  const auto found =
      relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
            {.spacing = l0, .tolerance = 1e-4, .moves = body.moves(), .moves_along = [&](std::size_t i, int c) {
               return c != 0 || !middle(i);
             }});
  double unbalanced = 0, held = 0, sag = 0;
  for (std::size_t i = 0; i < body.position.size(); ++i) {
    Vector<double, 2> moving = body.load[i], kept = Vector<double, 2>::Zero();
    if (middle(i)) {
      EXPECT_EQ(body.position[i][0], body.reference[i][0]) << i;
      std::swap(moving[0], kept[0]);
    }
    if (!body.moves()(i)) kept += moving, moving.setZero();
    unbalanced += moving.norm();
    held += kept.norm();
    sag = std::max(sag, body.reference[i][1] - body.position[i][1]);
  }
  EXPECT_GT(sag, 1e-4 * l0);
  EXPECT_NEAR(found.load / (held * body.volume), 1, 1e-12);
  EXPECT_NEAR(found.residual / (unbalanced / held), 1, 1e-9);
  EXPECT_LE(found.residual, 1e-4);
  EXPECT_THROW((void)relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                           {.spacing = l0, .load = 1, .moves_along = [](std::size_t, int) { return false; }}),
               InputError);
}

// Earlier, each force density counted by l0^D also where particles have other volumes.
TEST(Relax, WeighsForcesByTheVolumesOfParticles) {
  Standing<double, 2> body(column<2>(3, 6));
  std::vector<double> volumes;
  for (std::size_t i = 0; i < body.position.size(); ++i) volumes.push_back(body.volume * (i % 2 == 0 ? 0.5 : 1.4));
  const BondList<double, 2> bonds(vectors(body.reference), {.spacing = l0}, scalars(volumes));
  auto force = internal_force(bonds, elastic(linear), artificial(young));
  RelaxationSettings settings{.spacing = l0, .moves = body.moves()};
  settings.volume = [&](std::size_t i) { return volumes[i]; };
  const auto found = relax(body.with_weight(force), body.x(), body.v(), body.f(), density, settings);
  double unbalanced = 0, held = 0;
  for (std::size_t i = 0; i < volumes.size(); ++i)
    (body.moves()(i) ? unbalanced : held) += body.load[i].norm() * volumes[i];
  EXPECT_NEAR(found.load / held, 1, 1e-12);
  EXPECT_NEAR(found.residual / (unbalanced / held), 1, 1e-12);
  for (const double bad : {0.0, std::nan(""), l0}) {
    volumes[3] = bad;
    EXPECT_THROW((void)relax(body.with_weight(force), body.x(), body.v(), body.f(), density, settings), InputError);
  }
}

TEST(Relax, ReportsLoadAndStepIfItDoesNotConverge) {
  Standing<double, 2> body(column<2>(3, 6));
  auto damped = internal_force(body.bonds, elastic(linear), artificial(young), viscous(density, 10));
  RelaxationSettings settings{.spacing = l0, .max_iterations = 20, .moves = body.moves()};
  const std::string words =
      words_of([&] { (void)relax(body.with_weight(damped), body.x(), body.v(), body.f(), density, settings); });
  EXPECT_TRUE(has(words, "damping shortened its step")) << words;
  EXPECT_TRUE(has(words, "what the held particles carry")) << words;
}

// A search for the step may go astray, because friction answers trial motions by the order in which they come. The
// force of this test pushes away from rest in all but the first search.
TEST(Relax, KeepsItsStepWhereASearchFindsNone) {
  std::vector<Vector<double, 2>> x{{0, 0}, {1, 0}}, v(2, {0, 0});
  double stiffness = 4;
  const auto force = [&](const auto& at, const auto&, const auto& out) {
    for (std::size_t i = 0; i < 2; ++i) out.set(i, Vector<double, 2>(-stiffness * at[i]));
  };
  detail::RelaxationStep step({.spacing = 1});
  const auto update = [&] { step.update(force, vectors(x), vectors(v), 1.0, 1.0, Serial{}); };
  update();
  const double before = step.value();
  EXPECT_NEAR(before, 0.9, 1e-6);
  stiffness = -4;
  update();
  EXPECT_EQ(step.value(), before);
  stiffness = 16;
  update();
  EXPECT_NEAR(step.value(), 0.45, 1e-6);
  // Without any step before it cannot go on.
  stiffness = -4;
  detail::RelaxationStep other({.spacing = 1});
  const std::string words = words_of([&] { other.update(force, vectors(x), vectors(v), 1.0, 1.0, Serial{}); });
  EXPECT_TRUE(has(words, "no stiffness")) << words;
  EXPECT_TRUE(has(words, "friction")) << words;
}

TEST(Relax, NamesTheParticleWhoseForceIsNotFinite) {
  Standing<double, 2> body(column<2>(3, 6));
  const auto bad = [](const auto&, const auto&, const auto& out) { out(7, 1) = std::nan(""); };
  const std::string words = words_of([&] {
    (void)relax(bad, body.x(), body.v(), body.f(), density,
                {.spacing = l0, .load = 1, .step = 1e-5, .moves = body.moves()});
  });
  EXPECT_TRUE(has(words, "particle 7 ")) << words;
  EXPECT_TRUE(has(words, "coincide")) << words;
  EXPECT_TRUE(has(words, "det F")) << words;
  // Forces of particles that do not move are ignored if the load is given.
  const auto held = [](const auto&, const auto&, const auto& out) { out(0, 1) = std::nan(""); };
  EXPECT_EQ(relax(held, body.x(), body.v(), body.f(), density,
                  {.spacing = l0, .load = 1, .step = 1e-5, .moves = body.moves()})
                .residual,
            0);
  EXPECT_THROW(
      (void)relax(held, body.x(), body.v(), body.f(), density, {.spacing = l0, .step = 1e-5, .moves = body.moves()}),
      StateError);
}

// Earlier, relax reported rest at once: forces times a millionth of the volume do not count.
TEST(Relax, RefusesASpacingInAnotherUnit) {
  Standing<double, 2> body(column<2>(3, 6));
  auto force = internal_force(body.bonds, elastic(linear), artificial(young));
  for (const double spacing : {1e-3 * l0, 1e3 * l0, l0 / 5, 5 * l0}) {
    const std::string words = words_of([&] {
      (void)relax(body.with_weight(force), body.x(), body.v(), body.f(), density,
                  {.spacing = spacing, .load = body.weight(), .moves = body.moves()});
    });
    EXPECT_TRUE(has(words, "the spacing of relax is")) << spacing << words;
  }
}

// The lambda below reads and writes views of the user instead of its arguments: earlier, relax saw no force and
// reported rest.
TEST(Relax, RejectsAForceThatIgnoresItsArguments) {
  Standing<double, 2> body(column<2>(3, 6));
  auto force = internal_force(body.bonds, elastic(linear), artificial(young));
  auto weighed = body.with_weight(force);
  const auto own = [&](const auto&, const auto&, const auto&) { weighed(body.x(), body.v(), body.f()); };
  std::vector<Vector<double, 2>> other(body.load.size(), Vector<double, 2>::Zero());
  const auto start = body.position;
  const std::string words = words_of([&] {
    (void)relax(own, body.x(), body.v(), vectors(other), density,
                {.spacing = l0, .load = body.weight(), .moves = body.moves()});
  });
  EXPECT_TRUE(has(words, "writes nothing")) << words;
  EXPECT_EQ(body.position, start);
  // A body that is already at rest is no error: it has a force as soon as it is displaced.
  const auto springs = [&](const auto& x, const auto&, const auto& f) {
    for (std::size_t i = 0; i < x.size(); ++i) f.set(i, Vector<double, 2>(-1e6 * (x[i] - start[i])));
  };
  EXPECT_EQ(relax(springs, body.x(), body.v(), body.f(), density, {.spacing = l0, .load = 1}).iterations, 0);
}

// Earlier, the body fell until it had moved by ten times its size, or for all permitted iterations, and the message
// asked for more of them or about held particles.
TEST(Relax, ReportsTheNetForceOnABodyThatNothingHolds) {
  Standing<double, 2> body(column<2>(3, 6));
  auto force = internal_force(body.bonds, elastic(linear), artificial(young));
  const double pull = 100;  // N/m3, on the three particles at the end
  const auto pulled = [&](const auto& x, const auto& v, const auto& f) {
    force(x, v, f);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (body.reference[i][1] > 4.5 * l0) f.add(i, Vector<double, 2>(0, pull));
  };
  RelaxationSettings settings{.spacing = l0, .load = 3 * pull * body.volume};
  std::string words = words_of([&] { (void)relax(pulled, body.x(), body.v(), body.f(), density, settings); });
  EXPECT_TRUE(has(words, "nothing has held it so far")) << words;
  EXPECT_TRUE(has(words, "no particle is held against the net force of (")) << words;
  EXPECT_TRUE(has(words, " 0.0012)")) << words;
  EXPECT_TRUE(has(words, "subtract the mean force")) << words;
  // The body has moved by little more than three times its size.
  EXPECT_LT(body.position[0][1], 4 * 6.4 * l0);
  // With too few iterations to see it, the message names the force, too.
  body.position = body.reference;
  settings.max_iterations = 50;
  words = words_of([&] { (void)relax(pulled, body.x(), body.v(), body.f(), density, settings); });
  EXPECT_TRUE(has(words, "the net force of (")) << words;
  EXPECT_TRUE(has(words, "otherwise allow more max_iterations than 50")) << words;
  // Where particles are held along one axis, a force along the other counts.
  body.position = body.reference;
  settings.max_iterations = 100000;
  settings.moves_along = [](std::size_t i, int c) { return c == 1 || i > 5; };
  words = words_of([&] { (void)relax(pulled, body.x(), body.v(), body.f(), density, settings); });
  EXPECT_TRUE(has(words, "the net force of (0 0.0012")) << words;
  // A held particle leaves nothing to report.
  body.position = body.reference;
  settings.moves_along = nullptr;
  settings.moves = body.moves();
  EXPECT_LE(relax(pulled, body.x(), body.v(), body.f(), density, settings).residual, 1e-3);
}

/// A bar along y whose ends two forces turn, across it as it lies at the time, or in the direction x.
struct Turned {
  Standing<double, 2> body{column<2>(3, 12)};
  double push = 100;  // N/m3, on three particles at either end
  std::string words;
  Relaxation found;

  explicit Turned(bool follows) {
    auto internal =
        internal_force(body.bonds, elastic(NeoHookean<>::from_young_poisson(young, 0.3)), artificial(young));
    const std::size_t n = body.position.size();
    const auto force = [&](const auto& x, const auto& v, const auto& f) {
      internal(x, v, f);
      const Vector<double, 2> along = (x[n - 1] - x[n - 12]).normalized();
      const Vector<double, 2> across = follows ? Vector<double, 2>(along[1], -along[0]) : Vector<double, 2>(1, 0);
      for (std::size_t i = 0; i < n; ++i) {
        if (body.reference[i][1] > 10.5 * l0) f.add(i, push * across);
        if (body.reference[i][1] < 0.5 * l0) f.add(i, -push * across);
      }
    };
    words = words_of([&] {
      found = relax(force, body.x(), body.v(), body.f(), density, {.spacing = l0, .load = 6 * push * body.volume});
    });
  }
};

// Earlier, the bar turned until its ends had moved by ten times its length, and the message asked about held particles.
TEST(Relax, ReportsTheNetMomentOnABodyThatNothingHolds) {
  const Turned spinning(true);
  EXPECT_TRUE(has(spinning.words, "nothing has held it so far")) << spinning.words;
  EXPECT_TRUE(has(spinning.words, "and the net moment of (-2.6")) << spinning.words;  // 6 * push * volume * 11 l0 / 2
  EXPECT_TRUE(has(spinning.words, "while the body turns")) << spinning.words;
  // Dead loads turn the bar only until it lies along them.
  const Turned aligned(false);
  EXPECT_EQ(aligned.words, "");
  EXPECT_LE(aligned.found.residual, 1e-3);
  const Vector<double, 2> along =
      aligned.body.position.back() - aligned.body.position[aligned.body.position.size() - 12];
  EXPECT_GT(along[0], 0.99 * along.norm());
}

// A force may hold a body of which every particle moves: the search goes on while it falls on a floor, from twice its
// size.
TEST(Relax, LetsAFreeBodyFallOnAFloor) {
  Standing<double, 2> body(column<2>(3, 6));
  body.pull = Vector<double, 2>(0, -1);
  auto internal = internal_force(body.bonds, elastic(linear), artificial(young));
  auto weighed = body.with_weight(internal);
  const double floor = -12 * l0, stiffness = young / (l0 * l0);
  const auto force = [&](const auto& x, const auto& v, const auto& f) {
    weighed(x, v, f);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i][1] < floor) f.add(i, Vector<double, 2>(0, stiffness * (floor - x[i][1])));
  };
  const double weight = 18 * density * body.volume;
  EXPECT_LE(relax(force, body.x(), body.v(), body.f(), density, {.spacing = l0, .load = weight}).residual, 1e-3);
  EXPECT_NEAR(body.position[0][1], floor, 0.01 * l0);
}

// A force below the tolerance moves it, while something keeps the forces from balancing: here a pair of forces that
// turns at each evaluation. Earlier, the message spoke of float and the tolerance only.
TEST(Relax, SaysThatABodyThatDoesNotComeToRestMovesAsAWhole) {
  Standing<double, 2> body(column<2>(3, 6));
  auto internal = internal_force(body.bonds, elastic(linear), artificial(young));
  const double pull = 2000;  // N/m3
  int calls = 0;
  const auto force = [&](const auto& x, const auto& v, const auto& f) {
    internal(x, v, f);
    ++calls;
    const Vector<double, 2> pair = 20 * pull * Vector<double, 2>(std::cos(calls * calls), std::sin(calls * calls));
    for (std::size_t i = 0; i < x.size(); ++i) f.add(i, Vector<double, 2>(pull, 0));
    f.add(0, Vector<double, 2>(-pair));
    f.add(1, pair);
  };
  const double net = 18 * pull * body.volume;
  const RelaxationSettings settings{.spacing = l0,
                                    .load = 1.1e3 * net,
                                    .max_iterations = 5000,
                                    .step = 2e-4,
                                    .moves_along = [](std::size_t i, int c) { return c == 0 || i != 3; }};
  const std::string words = words_of([&] { (void)relax(force, body.x(), body.v(), body.f(), density, settings); });
  EXPECT_TRUE(has(words, "since iteration 2500 the body has moved as a whole")) << words;
  EXPECT_TRUE(has(words, "hold some particles along that direction")) << words;
  EXPECT_TRUE(has(words, "otherwise allow more max_iterations than 5000")) << words;
}

// Beyond its limit load a held body yields without end.
TEST(Relax, AsksWhetherTheLoadExceedsWhatTheBodyCarries) {
  std::vector<Vector<double, 2>> x{{0, 0}, {0, l0}}, v(2), f(2);
  const auto pull = [](const auto&, const auto&, const auto& out) {
    for (std::size_t i = 0; i < 2; ++i) out.set(i, Vector<double, 2>(0, 100));
  };
  const std::string words = words_of([&] {
    (void)relax(
        pull, vectors(x), vectors(v), vectors(f), density,
        {.spacing = l0, .tolerance = 1e-9, .load = 1, .step = 1e-3, .moves = [](std::size_t i) { return i == 1; }});
  });
  EXPECT_TRUE(has(words, "particles have flown")) << words;
  EXPECT_TRUE(has(words, "the load may exceed what the body can carry")) << words;
}

TEST(Relax, BadInputIsRefused) {
  Standing<double, 2> body(column<2>(2, 3));
  std::vector<Vector<double, 2>> few(2);
  const auto none = [](const auto&, const auto&, const auto&) {};
  const auto call = [&](const RelaxationSettings& settings) {
    (void)relax(none, body.x(), body.v(), body.f(), density, settings);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(call({.spacing = 0, .load = 1}), InputError);
  ForceFunction<double, 2> empty;
  EXPECT_THROW((void)relax(empty, body.x(), body.v(), body.f(), density, {.spacing = l0, .load = 1}), InputError);
  EXPECT_THROW(call({.spacing = l0, .tolerance = 0, .load = 1}), InputError);
  EXPECT_THROW(call({.spacing = l0, .load = -1}), InputError);
  EXPECT_THROW(call({.spacing = l0, .load = nan}), InputError);
  EXPECT_THROW(call({.spacing = l0, .load = 1, .max_iterations = 0}), InputError);
  EXPECT_THROW(call({.spacing = l0, .load = 1, .step = -1}), InputError);
  const std::string words = words_of([&] { call({.spacing = l0}); });
  EXPECT_TRUE(has(words, "every particle moves and `load` is not set")) << words;
  EXPECT_THROW(call({.spacing = l0, .load = 1, .moves = [](std::size_t) { return false; }}), InputError);
  EXPECT_THROW((void)relax(none, body.x(), vectors(few), body.f(), density, {.spacing = l0, .load = 1}), InputError);
  EXPECT_THROW((void)relax(none, body.x(), body.v(), vectors(few), density, {.spacing = l0, .load = 1}), InputError);
  EXPECT_THROW((void)relax(none, body.x(), body.v(), body.f(), 0.0, {.spacing = l0, .load = 1}), InputError);
  body.position[1][1] = nan;
  EXPECT_THROW(call({.spacing = l0, .load = 1}), InputError);
}

// Earlier, a body that drag slows down was taken for one that rounding keeps from rest.
TEST(Relax, ConvergesWithDrag) {
  using P = Vector<double, 2>;
  for (const double drag : {1e5, 1e6, 3e6}) {
    std::vector<P> x{{0, 0}, {1e-3, 0}, {2e-3, 0}, {3e-3, 0}}, v(4, P::Zero()), f(v);
    const std::vector<P> X = x;
    const auto force = [&](const auto& at, const auto& speed, const auto& out) {
      for (std::size_t i = 0; i < 4; ++i) out.add(i, P(-1e6 * (at[i] - X[i] - P(1e-4, 0)) - drag * speed[i]));
    };
    const RelaxationSettings settings{.spacing = 1e-3, .tolerance = 1e-2, .load = 4e-4};
    EXPECT_NO_THROW((void)relax(force, vectors(x), vectors(v), vectors(f), 1000.0, settings)) << drag;
  }
}

}  // namespace relaxation_test
