// SPDX-License-Identifier: MIT
// What contact remembers survives errors, organs that are added later, and a restart.
#include "hmps/contact/detail/contact_checkpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../../../reference/message_of.hpp"
#include "../bodies.hpp"
#include "hmps/contact/contact.hpp"

namespace contact_checkpoint_test {

using bodies::Pile;
using hmps_test::message_of;
using Point = hmps::Vector<double, 3>;

/// A block that is dragged along a plate, a step at a time; friction grows with the elastic slip.
template <class S>
struct Dragged : Pile<double, 3> {
  using Contact = hmps::MetaballContact<S, 3, hmps::SmoothMetaball, hmps::SpringFriction>;
  static constexpr double dt = 1e-5;

  explicit Dragged(double away = 0) : Pile<double, 3>(0.85) {
    for (Point& place : x) place[0] += away;
  }
  [[nodiscard]] Contact contact() const {
    Contact made({.spacing = 1e-3, .density = 1000, .friction = 0.5});
    declare(made);
    return made;
  }
  void drag() {
    for (const hmps::Index i : block.all) x[i][0] += 5e-6;
  }
  /// The friction on the block after a call, as a force density.
  double friction(Contact& of) {
    apply(of, dt);
    double sum = 0;
    for (const hmps::Index i : block.all) sum += f[i][0];
    return sum;
  }
};

TEST(ContactMemory, SurvivesAStateThatIsRefused) {
  Dragged<double> scene, other;
  auto contact = scene.contact(), undisturbed = other.contact();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int step = 0; step < 4; ++step) {
    scene.drag();
    other.drag();
    if (step == 2) {
      for (double& fault : {std::ref(scene.v[scene.block.bottom[2]][1]), std::ref(scene.x[scene.plate.top[5]][0]),
                            std::ref(scene.F[scene.plate.top[7]](1, 1))}) {
        const double good = std::exchange(fault, nan);
        EXPECT_THROW(scene.apply(contact, scene.dt), hmps::StateError);
        fault = good;
      }
    }
    EXPECT_EQ(scene.friction(contact), other.friction(undisturbed)) << step;
  }
  EXPECT_NE(scene.friction(contact), 0);
}

/// Throws in loop number `fatal` of its life.
struct Failing {
  std::size_t* loops;
  std::size_t fatal;
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    if (++*loops == fatal) throw std::runtime_error("no more threads");
    for (std::size_t i = 0; i < n; ++i) body(i);
  }
};

TEST(ContactMemory, SurvivesAnExecutorThatThrows) {
  Dragged<double> other;
  auto undisturbed = other.contact();
  std::vector<double> expected;
  for (int step = 0; step < 4; ++step) {
    other.drag();
    expected.push_back(other.friction(undisturbed));
  }
  std::size_t thrown = 0;
  for (const int broken_step : {0, 2})
    for (std::size_t fatal = 1; fatal < 12; ++fatal) {
      Dragged<double> scene;
      auto contact = scene.contact();
      for (int step = 0; step < 4; ++step) {
        scene.drag();
        std::size_t loops = 0;
        if (step == broken_step) try {
            contact.add(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::matrices(scene.F), hmps::vectors(scene.f),
                        scene.dt, Failing{&loops, fatal});
          } catch (const std::runtime_error&) {
            ++thrown;
          }
        // The failed call may have stored the positions, so that up to the slip of one step is missing.
        const double slip_of_a_step = expected[1] - expected[0], found = scene.friction(contact);
        EXPECT_NEAR(found, expected[static_cast<std::size_t>(step)], 1.01 * std::abs(slip_of_a_step))
            << "loop " << fatal << " of step " << broken_step << ", step " << step;
        if (step < broken_step) {
          EXPECT_EQ(found, expected[static_cast<std::size_t>(step)]);
        }
      }
    }
  EXPECT_GT(thrown, 8U);
}

TEST(ContactMemory, SurvivesAnOrganThatIsAddedLater) {
  Dragged<double> scene, other;
  const auto box = [](Dragged<double>& to) {  // its particles come after the others, and touch nothing
    return to.add(hmps::Vector<int, 3>(3, 3, 3), Point(0.2, 0, 0), 1e-3);
  };
  const auto late = box(scene), unused = box(other);
  auto contact = scene.contact(), undisturbed = other.contact();
  for (int step = 0; step < 4; ++step) {
    scene.drag();
    other.drag();
    if (step == 2) contact.add_organ({.name = "late", .slaves = late.bottom, .masters = late.lower});
    EXPECT_EQ(scene.friction(contact), other.friction(undisturbed)) << step;
  }
  EXPECT_EQ(unused.all, late.all);
}

// The history is taken before the first call with the new organ, or restored before the organ is added.
TEST(ContactMemory, SurvivesARestartBesideAnOrganThatIsAddedLater) {
  for (const bool before : {true, false}) {
    Dragged<double> scene;
    const auto late = scene.add(hmps::Vector<int, 3>(3, 3, 3), Point(0.2, 0, 0), 1e-3);
    const hmps::Organ organ{.name = "late", .slaves = late.bottom, .masters = late.lower};
    auto contact = scene.contact(), resumed = scene.contact();
    for (int step = 0; step < 3; ++step) {
      scene.drag();
      scene.friction(contact);
    }
    if (before) {
      contact.add_organ(organ);
      resumed.add_organ(organ);
    }
    resumed.restore_history(contact.history());
    if (!before) {
      contact.add_organ(organ);
      resumed.add_organ(organ);
    }
    for (int step = 0; step < 3; ++step) {
      scene.drag();
      const double expected = scene.friction(contact);
      EXPECT_EQ(scene.friction(resumed), expected) << before << step;
      EXPECT_NE(expected, 0);
    }
  }
}

// Such a particle would hide all that come after it, whose slip would be lost without a word.
TEST(ContactMemory, RefusesAHistoryWithAParticleThatIsInNoOrgan) {
  Dragged<double> scene;
  auto contact = scene.contact(), resumed = scene.contact();
  scene.drag();
  scene.friction(contact);
  const std::vector<double> good = contact.history();
  constexpr std::size_t head = 6, width = 4;
  const auto count = static_cast<std::size_t>(good[2]);
  ASSERT_GT(count, 2U);
  std::size_t gaps = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const double particle = good[head + width * n] + 1;
    if (n + 1 < count && particle == good[head + width * (n + 1)]) continue;
    std::vector<double> bad = good;
    bad[head + width * n] = particle;
    ++gaps;
    const std::string error = message_of([&] { resumed.restore_history(bad); });
    EXPECT_NE(error.find(hmps::detail::message("number ", head + width * n, " of the history is particle ", particle,
                                               ", which is in no organ")),
              std::string::npos)
        << error;
  }
  EXPECT_GT(gaps, 1U);
  resumed.restore_history(good);
  scene.drag();
  EXPECT_EQ(scene.friction(resumed), scene.friction(contact));
}

TEST(ContactMemory, GivesTheSameBitsAfterARestartFarFromTheOrigin) {
  Dragged<float> scene(5);
  auto contact = scene.contact();
  for (int step = 0; step < 8; ++step) {
    scene.drag();
    scene.friction(contact);
  }
  auto resumed = scene.contact();
  resumed.restore_history(contact.history());
  for (int step = 0; step < 8; ++step) {
    scene.drag();
    for (Point& place : scene.x) place += Point(1e-4, 2e-5, 0);
    const double expected = scene.friction(contact);
    EXPECT_EQ(scene.friction(resumed), expected) << step;
  }
}

TEST(ContactPrecision, OfFloatRefusesAnOrganThatIsFarAway) {
  for (const bool is_far : {false, true}) {
    Dragged<float> scene;
    const auto parked = scene.add(hmps::Vector<int, 3>(3, 3, 3), Point(is_far ? 1e3 : 50, 0, 0), 1e-3);
    auto contact = scene.contact();
    contact.add_organ({.name = "parked", .slaves = parked.bottom, .masters = parked.lower});
    const std::string error = message_of([&] { scene.apply(contact, scene.dt); });
    EXPECT_EQ(error.find("middle of all organs") != std::string::npos, is_far) << error;
  }
}

}  // namespace contact_checkpoint_test
