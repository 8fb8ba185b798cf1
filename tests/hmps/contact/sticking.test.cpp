// SPDX-License-Identifier: MIT
// Friction with a spring in the complete contact: what it remembers, and how the remembered slip rotates.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bodies.hpp"
#include "hmps/contact/contact.hpp"

namespace sticking_test {

using hmps::Index;
using Contact = hmps::MetaballContact<double, 3, hmps::SmoothMetaball, hmps::SpringFriction>;
using Point = hmps::Vector<double, 3>;

constexpr double l0 = 1e-3, density = 1000, dt = 1e-5;

/// A block pressed a tenth of a spacing into a plate and shoved along it, both at rest after that.
struct Shoved {
  bodies::Pile<double, 3> pile{0.9, l0};
  Contact contact{{.spacing = l0, .density = density, .friction = 1}};
  Point before;
  explicit Shoved(double by = 1e-3 * l0) {
    pile.declare(contact);
    pile.apply(contact, dt);
    before = pushed();
    for (int step = 0; step < 10; ++step) {
      for (const Index i : pile.block.all) pile.x[i][0] += by / 10;
      pile.apply(contact, dt);
    }
  }
  /// The sum of the force densities on the block.
  [[nodiscard]] Point pushed() const {
    Point sum = Point::Zero();
    for (const Index i : pile.block.all) sum += pile.f[i];
    return sum;
  }
};

/// Nothing moves, but friction holds: each contact is a spring of stiffness k, unlike with a law that depends only on
/// the velocity. At the rim, normals are inclined by up to 0.3, whose square is the share that is left out.
TEST(Sticking, HoldsWithoutASlip) {
  Shoved scene;
  const std::size_t contacts = scene.pile.apply(scene.contact, dt).contacts;
  const double k = 0.3 * density / (dt * dt), whole = static_cast<double>(contacts) * k * 1e-3 * l0;
  const Point force = scene.pushed() - scene.before;
  EXPECT_NEAR(-force[0], whole, 0.1 * whole);
  const auto once = scene.pile.f;
  scene.pile.apply(scene.contact, dt);
  EXPECT_EQ(once, scene.pile.f) << "evaluating the same state twice changes nothing";
}

/// Both bodies turn as one, with the velocities of that rotation: the force turns with them. The mean of the masters'
/// motion would report sliding, because it belongs to a place more than half a spacing below the slave: by 0.5 spacings
/// here, 500 times the elastic slip. The remaining errors are of third order in the rotation of the spring, 1e-9 / 6 of
/// it in each of 400 steps, and of second order in the velocities, which are those at the end of a step: 2e-4 of the
/// spring's force.
TEST(Sticking, TurnsWithTheWall) {
  Shoved scene;
  const auto before = scene.pile.f;
  const double angle = 1e-3;
  const Point axis(0.6, -0.48, 0.64), centre(5 * l0, 3 * l0, 0);
  const hmps::Matrix<double, 3> R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  hmps::Matrix<double, 3> all = hmps::Matrix<double, 3>::Identity();
  for (int step = 0; step < 400; ++step) {
    for (std::size_t i = 0; i < scene.pile.x.size(); ++i) {
      const Point from = scene.pile.x[i] - centre;
      scene.pile.x[i] = centre + R * from;
      scene.pile.v[i] = angle / dt * axis.cross(scene.pile.x[i] - centre);
    }
    all = R * all;
    scene.pile.apply(scene.contact, dt);
  }
  double largest = 0, off = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    largest = std::max(largest, before[i].norm());
    off = std::max(off, (all * before[i] - scene.pile.f[i]).norm());
  }
  const double friction = 0.3 * density / (dt * dt) * 1e-3 * l0;  // of one contact
  EXPECT_LT(off, 1e-3 * friction);
  EXPECT_GT(largest, friction);
}

/// A thread of masters does not determine a rotation about itself. The motion that slave and wall share must not leak
/// into the elastic slip, however far they travel.
TEST(Sticking, TravelsWithAThread) {
  std::vector<Point> x, v, f;
  std::vector<Index> thread;
  for (int k = -8; k <= 8; ++k) {  // so close that they reach as far as a wall
    thread.push_back(static_cast<Index>(x.size()));
    x.push_back(Point(0.1 * k * l0, 0, 0));
  }
  const std::vector<Index> slave{static_cast<Index>(x.size())};
  x.push_back(Point(0.02 * l0, 0.1 * l0, 0.9 * l0));
  v.assign(x.size(), Point::Zero());
  Contact contact({.spacing = l0, .density = density, .friction = 1});
  const auto wall = contact.add_organ({.name = "thread", .slaves = {}, .masters = thread, .prescribed = {}});
  const auto body = contact.add_organ({.name = "slave", .slaves = slave, .masters = {}, .prescribed = {}});
  contact.add_pair(wall, body, {.roles = hmps::Roles::only_second_is_slave});
  const auto pushed = [&] {
    f.assign(x.size(), Point::Zero());
    EXPECT_EQ(contact.add(hmps::vectors(x), hmps::vectors(v), hmps::vectors(f), dt).contacts, 1U);
    return f.back();
  };
  (void)pushed();
  x.back()[0] += 1e-3 * l0;
  const Point before = pushed();
  for (int step = 0; step < 1000; ++step) {
    for (Point& place : x) place += Point(0.3, 0.2, -0.1) * l0;
    (void)pushed();
  }
  EXPECT_GT(std::abs(before[0]), 0);
  EXPECT_LT((pushed() - before).norm(), 1e-6 * before.norm());
}

/// After one call off the wall, or after `refresh`, no elastic slip is left.
TEST(Sticking, ForgetsWhereContactIsLost) {
  Shoved scene;
  scene.contact.refresh();
  scene.pile.apply(scene.contact, dt);
  // The remaining difference is the change of the normals over a thousandth of a spacing.
  EXPECT_LT((scene.pushed() - scene.before).norm(), 1e-2 * scene.before.norm());
  Shoved lifted;
  for (const double up : {0.5 * l0, -0.5 * l0}) {
    for (const Index i : lifted.pile.block.all) lifted.pile.x[i][2] += up;
    lifted.pile.apply(lifted.contact, dt);
  }
  EXPECT_LT((lifted.pushed() - scene.pushed()).norm(), 1e-9 * scene.before.norm());
}

/// Shoved further than the elastic slip at the limit, the block feels mu times the normal force, in both roles, except
/// for what inclined normals push aside.
TEST(Sticking, SlidesAtTheLimit) {
  Shoved scene(0.5 * l0);
  const Point stuck = scene.pushed();
  scene.contact.refresh();
  EXPECT_EQ(scene.pile.apply(scene.contact, dt).sticking, scene.pile.apply(scene.contact, dt).contacts);
  const Point force = stuck - scene.pushed();
  EXPECT_NEAR(-force[0], stuck[2], 0.1 * stuck[2]);
}

/// A block that slides and sticks on a shaken plate, stopped and resumed in a new contact.
TEST(Sticking, ResumesToTheSameBits) {
  const hmps::ContactSettings settings{.spacing = l0, .density = density, .friction = 0.3};
  bodies::Pile<double, 3> pile(1.1, l0);
  pile.shake(0.05, 0.03, 4);
  Contact contact(settings), resumed(settings);
  pile.declare(contact);
  pile.declare(resumed);
  const auto step = [&] {
    for (const Index i : pile.block.all) pile.x[i] += Point(2e-7, 1e-7, -4e-6);
  };
  for (int n = 0; n < 30; ++n) step(), pile.apply(contact, dt);
  const std::vector<double> checkpoint = contact.history();
  resumed.restore_history(checkpoint);
  EXPECT_EQ(resumed.history(), checkpoint);
  Contact fresh(settings);
  pile.declare(fresh);
  for (int n = 0; n < 30; ++n) {
    step();
    const auto report = pile.apply(contact, dt);
    EXPECT_GT(report.sticking, 0U);
    const auto forces = pile.f;
    pile.apply(resumed, dt);
    ASSERT_EQ(forces, pile.f) << "step " << n;
    pile.apply(fresh, dt);
    EXPECT_NE(forces, pile.f) << "without the history the force is different";
  }
}

/// Probes the force at displaced positions in the middle of a run, as `stable_step` does.
TEST(Sticking, ForgetsAProbe) {
  Shoved scene;
  scene.pile.apply(scene.contact, dt);
  const auto before = scene.pile.f;
  const auto x = scene.pile.x;
  const auto probe = [&] {
    for (const Index i : scene.pile.block.all) scene.pile.x[i] += Point(0.2, -0.1, 0) * l0;
    scene.pile.apply(scene.contact, dt);
    scene.pile.x = x;
  };
  const std::vector<double> history = scene.contact.history();
  probe();
  scene.contact.restore_history(history);
  scene.pile.apply(scene.contact, dt);
  EXPECT_EQ(before, scene.pile.f);
  probe();
  scene.pile.apply(scene.contact, dt);
  EXPECT_NE(before, scene.pile.f);
}

TEST(Sticking, RejectsWhatIsNoHistory) {
  Shoved scene;
  const std::vector<double> history = scene.contact.history();
  const auto fails = [&](std::vector<double> numbers, const char* with) {
    try {
      scene.contact.restore_history(numbers);
      ADD_FAILURE() << "no error with " << with;
    } catch (const hmps::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(with), std::string::npos) << error.what();
    }
  };
  fails({}, "give restore_history the numbers that history() returned");
  auto cut = history, other = history, moved = history, unsorted = history;
  cut.pop_back();
  fails(cut, "all of it and unchanged");
  other[1] += 1;
  fails(other, "add the same organs and pairs");
  for (const auto& [number, with] : {std::pair{5, "the origin in number 5 of the history is nan"},
                                     {6, "number 6 of the history is nan, which is not a particle"},
                                     {7, "a position in number 7 of the history is nan"}}) {
    moved = history;
    moved[static_cast<std::size_t>(number)] = std::nan("");
    fails(moved, with);
  }
  moved = history;
  std::swap(moved[6], moved[10]);  // the first two particles
  fails(moved, "not a particle above the one before");
  unsorted[history.size() - 7] = 0;  // the number of the last entry
  fails(unsorted, "all of it and unchanged");
  auto huge = history;
  huge.back() = 1e300;  // infinite in the numbers of the contact
  fails(huge, "all of it and unchanged");
  const hmps::ContactSettings settings{.spacing = l0, .density = density, .friction = 1};
  hmps::MetaballContact<double, 3, hmps::SmoothMetaball, hmps::CorrectedFriction> corrected(settings);
  scene.pile.declare(corrected);
  EXPECT_THROW(corrected.restore_history(history), hmps::InputError);
  EXPECT_EQ(scene.contact.history(), history) << "a failure changes nothing";
}

TEST(Sticking, HasTheSameBitsInAnyOrderAndHoweverOldTheLists) {
  const hmps::ContactSettings with_friction{.spacing = l0, .density = density, .friction = 0.3};
  hmps::ContactSettings often_rebuilt = with_friction;
  often_rebuilt.margin = 0.01;
  bodies::Pile<double, 3> pile(1.1, l0);
  pile.shake(0.05, 0.03, 4);
  Contact serial(with_friction), reversed(with_friction), rebuilt(often_rebuilt);
  for (Contact* contact : {&serial, &reversed, &rebuilt}) pile.declare(*contact);
  std::size_t sticking = 0, contacts = 0, rebuilds = 0;
  for (int step = 0; step < 60; ++step) {
    for (const Index i : pile.block.all) pile.x[i] += Point(2e-7, 1e-7, -4e-6);
    const auto report = pile.apply(serial, dt);
    sticking += report.sticking, contacts += report.contacts;
    const auto bits = pile.f;
    pile.apply(reversed, dt, bodies::Loops{.backwards = true});
    ASSERT_EQ(bits, pile.f) << "step " << step;
    rebuilds = pile.apply(rebuilt, dt).rebuilds - report.rebuilds;
    ASSERT_EQ(bits, pile.f) << "other lists, step " << step;
  }
  EXPECT_GT(contacts, sticking);
  EXPECT_GT(contacts, 100U);
  EXPECT_GT(rebuilds, 10U);
}

// Spring and damping act only where there is friction.
TEST(Sticking, CostsNothingWithoutFriction) {
  using Corrected = hmps::MetaballContact<double, 3, hmps::SmoothMetaball, hmps::CorrectedFriction>;
  const hmps::ContactSettings frictionless{.spacing = l0, .density = density};
  bodies::Pile<double, 3> pile(0.9, l0);
  pile.shake(0.05, 0.03, 4);
  Contact contact(frictionless);
  Corrected corrected(frictionless);
  pile.declare(contact);
  pile.declare(corrected);
  for (int step = 0; step < 10; ++step) {
    for (const Index i : pile.block.all) {
      pile.x[i] += Point(2e-6, 1e-6, 0);
      pile.v[i] = Point(0.2, 0.1, -0.3);
    }
    const auto report = pile.apply(contact, dt);
    ASSERT_GT(report.contacts, 0U);
    const auto bits = pile.f;
    pile.apply(corrected, dt);
    ASSERT_EQ(bits, pile.f) << "step " << step;
  }
  EXPECT_EQ(contact.history()[2], 0) << "positions stored";
}

TEST(Sticking, BeginsWhereFrictionIsSwitchedOn) {
  const auto force_after = [](bool moves_before) {
    bodies::Pile<double, 3> pile(0.9, l0);
    Contact contact({.spacing = l0, .density = density, .friction = 0.5});
    pile.declare(contact);
    const auto slide = [&](double by) {
      for (const Index i : pile.block.all) pile.x[i][0] += by;
      pile.apply(contact, dt);
    };
    const double way = 0.001 * l0;
    slide(moves_before ? -3 * way : 0);
    if (moves_before) slide(way);  // stretches the springs
    contact.set_friction(0);
    slide(moves_before ? way : 0);
    if (moves_before) slide(way);
    contact.set_friction(0.5);
    slide(0);
    return pile.f;
  };
  const auto moved = force_after(true), kept = force_after(false);
  double largest = 0, off = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    largest = std::max(largest, kept[i].norm());
    off = std::max(off, (moved[i] - kept[i]).norm());
  }
  EXPECT_LT(off, 1e-6 * largest);
}

// Two blocks on a plate, of which one slides without friction until friction is switched on after a restart.
TEST(Sticking, ResumesBesideAPairWithoutFriction) {
  bodies::Scene<double, 3> scene;
  const auto plate = scene.add({14, 4, 3}, {0, 0, 0}, l0), left = scene.add({4, 4, 3}, {1.3 * l0, 0, 2.9 * l0}, l0),
             right = scene.add({4, 4, 3}, {7.4 * l0, 0, 2.9 * l0}, l0);
  Contact contact({.spacing = l0, .density = density}), resumed({.spacing = l0, .density = density});
  for (Contact* one : {&contact, &resumed}) {
    const auto below = one->add_organ({.name = "plate", .slaves = plate.top, .masters = plate.upper});
    one->add_pair(below, one->add_organ({.name = "left", .slaves = left.bottom, .masters = left.lower}),
                  {.friction = 0.5});
    one->add_pair(below, one->add_organ({.name = "right", .slaves = right.bottom, .masters = right.lower}));
  }
  const auto slide = [&] {
    for (const Index i : left.all) scene.x[i][0] += 2e-7;
    for (const Index i : right.all) scene.x[i][0] += 2e-7;
  };
  for (int step = 0; step < 3; ++step) slide(), scene.apply(contact, dt);
  resumed.restore_history(contact.history());
  EXPECT_EQ(resumed.history(), contact.history());
  for (Contact* one : {&contact, &resumed}) one->set_friction(0.5);
  for (int step = 0; step < 3; ++step) {
    slide();
    scene.apply(contact, dt);
    const auto forces = scene.f;
    scene.apply(resumed, dt);
    ASSERT_EQ(forces, scene.f) << "step " << step;
  }
}

}  // namespace sticking_test
