// SPDX-License-Identifier: MIT
#include "hmps/motion/hold.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace hold_test {

using Vector = hmps::Vector<float, 3>;
const hmps::ParticleSet last(3, std::vector<hmps::Index>{2});

TEST(Hold, StopsTheParticlesOfTheSetAndNoOthers) {
  std::vector<Vector> v(3, Vector(1, 2, 3));
  hmps::hold(hmps::vectors(v), last);
  EXPECT_EQ(v, (std::vector<Vector>{{1, 2, 3}, {1, 2, 3}, {0, 0, 0}}));
}

TEST(Hold, FixesOneComponent) {
  std::vector<Vector> v(3, Vector(1, 2, 3));
  hmps::hold_component(hmps::vectors(v), last, 1);
  EXPECT_EQ(v, (std::vector<Vector>{{1, 2, 3}, {1, 2, 3}, {1, 0, 3}}));
  hmps::hold_component(hmps::vectors(v), ~last, 2, -0.5);
  EXPECT_EQ(v, (std::vector<Vector>{{1, 2, -0.5}, {1, 2, -0.5}, {1, 0, 3}}));
}

TEST(Hold, TakesTheComponentAlongANormal) {
  std::vector<Vector> v(3, Vector(1, 2, 3));
  hmps::hold_along(hmps::vectors(v), last, Eigen::Vector3d(3, 4, 0));
  // (1, 2, 3) less 11/25 (3, 4, 0)
  EXPECT_LE((v[2] - Vector(-0.32f, 0.24f, 3)).norm(), 1e-6f);
  EXPECT_EQ(v[0], Vector(1, 2, 3));
}

TEST(Hold, RefusesBadInput) {
  std::vector<Vector> v(3), few(2);
  EXPECT_THROW(hmps::hold(hmps::vectors(few), last), hmps::InputError);
  EXPECT_THROW(hmps::hold_component(hmps::vectors(few), last, 0), hmps::InputError);
  EXPECT_THROW(hmps::hold_component(hmps::vectors(v), last, 3), hmps::InputError);
  EXPECT_THROW(hmps::hold_component(hmps::vectors(v), last, -1), hmps::InputError);
  EXPECT_THROW(hmps::hold_component(hmps::vectors(v), last, 0, std::numeric_limits<double>::quiet_NaN()),
               hmps::InputError);
  EXPECT_THROW(hmps::hold_along(hmps::vectors(v), last, Eigen::Vector3d(0, 0, 0)), hmps::InputError);
  EXPECT_THROW(hmps::hold_along(hmps::vectors(few), last, Eigen::Vector3d(0, 0, 1)), hmps::InputError);
}

}  // namespace hold_test
